// SPDX-License-Identifier: BSD-3-Clause
// Time ratios of every peer to engine/simd: geometric means over the paper's set-ups, in ten minutes on two slow
// cores. Then threads, growth, batches, moves, paths and robots, in three more minutes. Answers are checked before and
// during timing.
#include <algorithm>
#include <array>
#include <cstdint>
#include <cstdio>
#include <limits>
#include <map>
#include <numbers>
#include <string>
#include <vector>

#include "batch.hpp"
#include "contestant.hpp"
#include "growth.hpp"
#include "hinge/engine/brute.hpp"
#include "moves.hpp"
#include "path_rows.hpp"
#include "reference.hpp"
#include "results.hpp"
#include "robots/robot_batches.hpp"
#include "robots/run_robots.hpp"
#include "scene.hpp"
#include "threads.hpp"
#include "timing.hpp"

namespace {

using namespace hinge;
using namespace hinge::bench;

constexpr int checked_conformations = 20;
constexpr double robot_seconds = 3.0;  // for each query of each robot
constexpr int paths_of_set = 60;       // takes half a minute for all sets
constexpr std::size_t small = 1500;    // atoms; engine/brute is checked up to this size, where an answer takes 3 ms

struct Checked {
  int conformations = 0;
  int differences = 0;
};

/// Compares engine/simd, the SIMD brute force and, for small scenes, engine/brute with the reference. Samplings
/// alternate.
Checked check(Scene& scene, std::vector<Contestant>& all) {
  Reference reference(scene.input());
  std::vector<Contestant> asked{
      all.front(), *std::find_if(all.begin(), all.end(), [](const Contestant& c) { return c.name == "brute"; })};
  if (scene.size() <= small) asked.push_back(engine<Brute>(scene, "engine-brute", false));
  Checked checked;
  for (; checked.conformations < checked_conformations; ++checked.conformations) {
    const auto k = static_cast<std::uint64_t>(checked.conformations);
    const Conformation c = scene.conformation(all_samplings[k % 3], k);
    const std::vector<Answer> expected = reference.ask(c.xyz);
    for (Contestant& contestant : asked) checked.differences += count_differences(contestant, c, expected, k);
  }
  return checked;
}

/// Microseconds of each of N tasks: the mean over conformations of the best time. Tasks take turns on every
/// conformation.
template <std::size_t N, class Work>
std::array<double, N> take_turns(Scene& scene, Sampling sampling, int conformations, const Work& work) {
  std::vector<std::vector<double>> q;
  for (int k = 0; k < conformations; ++k) q.push_back(scene.configuration(sampling, static_cast<std::uint64_t>(k)));
  std::array<double, N> sums{};
  std::vector<std::array<double, N>> best(q.size());
  for (auto& b : best) b.fill(std::numeric_limits<double>::infinity());
  for (int repetition = 0; repetition < repetitions; ++repetition)
    for (std::size_t k = 0; k < q.size(); ++k)
      for (std::size_t w = 0; w < N; ++w) best[k][w] = std::min(best[k][w], work(w, q[k]));
  for (const auto& b : best)
    for (std::size_t w = 0; w < N; ++w) sums[w] += b[w] / conformations;
  return sums;
}

/// Time of a yes/no query from torsion angles over the time of forward kinematics and coordinates alone.
double floor_ratio(Scene& scene, Results& results, const Json& setup) {
  Molecular<Simd> asked = scene.make<Simd>(), placed = scene.make<Simd>();
  bool collides = false;
  double kept = 0.0;
  const auto us = take_turns<2>(scene, Sampling::near_free, 100, [&](std::size_t w, const std::vector<double>& q) {
    if (w == 0)
      return microseconds([&] {
        asked.update(q);
        collides = asked.self_collides();
      });
    return microseconds([&] {
      placed.update(q);
      kept += placed.placed().back().position[0];
    });
  });
  Json row = {{"kind", "floor"}};
  row.update(setup);
  row.update({{"us", us[0]}, {"coordinates_us", us[1]}, {"ratio", us[0] / us[1]}, {"kept", kept + (collides ? 1 : 0)}});
  results.add(std::move(row));
  return us[0] / us[1];
}

/// Time of FCL over the time of engine/simd, yes/no from random torsions. Both include the same, faster kinematics.
double torsions_ratio(Scene& scene, Results& results, const Json& setup, double fcl_us) {
  Molecular<Simd> asked = scene.make<Simd>(), placed = scene.make<Simd>();
  Contestant manager = fcl(scene);
  const int conformations = std::clamp(static_cast<int>(0.5e6 / repetitions / fcl_us), 4, 100);  // half a second
  int differences = 0;
  const auto us =
      take_turns<2>(scene, Sampling::random, conformations, [&](std::size_t w, const std::vector<double>& q) {
        static bool collides = false;
        if (w == 0)
          return microseconds([&] {
            asked.update(q);
            collides = asked.self_collides();
          });
        Conformation c;
        const double fk = microseconds([&] {
          placed.update(q);
          placed.placed();
        });
        for (const Point& p : placed.placed()) c.xyz.insert(c.xyz.end(), {p.position[0], p.position[1], p.position[2]});
        manager.prepare(c);
        Answer answer;
        const double own = microseconds([&] { manager.ask(Query::any, answer); });
        differences += answer.collides == collides ? 0 : 1;
        return fk + own;
      });
  Json row = {{"kind", "torsions"}};
  row.update(setup);
  row.update({{"us", us[0]}, {"fcl_us", us[1]}, {"ratio", us[1] / us[0]}, {"differences", differences}});
  results.add(std::move(row));
  return us[1] / us[0];
}

}  // namespace

int main(int argc, char** argv) {
  const Arguments arguments = Arguments::parse(argc, argv, 420, "SECONDS for timing");
  const auto start = Clock::now();
  Results results("summary");
  const std::vector<Setup> setups = paper_setups();
  Ratios ratios;
  GeometricMean torsions;
  struct Lists {
    double us = 0.0, pairs = 0.0;
    double ns_per_pair() const { return 1e3 * us / pairs; }
  };
  std::map<Sampling, Lists> lists;  // what lists cost more than counts
  double floor = 0.0;
  std::size_t floor_dof = 0;
  Checked checked;
  int timed_differences = 0;
  std::size_t cells_left = setups.size() * std::size(all_queries) * std::size(all_samplings);
  Protein protein = read_protein(setups.front().file, setups.front().hydrogens);
  for (std::size_t k = 0; k < setups.size(); ++k) {
    const Setup& setup = setups[k];
    if (k > 0 && setup.name != setups[k - 1].name) protein = read_protein(setup.file, setup.hydrogens);
    Scene scene(protein, setup.residues);
    const Json described = describe(setup, scene);
    std::vector<Contestant> all = contestants(scene);
    const Checked here = check(scene, all);
    checked.conformations += here.conformations;
    checked.differences += here.differences;
    double fcl_us = 0.0;
    std::map<Sampling, double> counted_us;
    for (const Query query : all_queries)
      for (const Sampling sampling : all_samplings) {
        const double left = std::max(0.0, arguments.number - seconds_since(start));
        const Cell cell = Measurement(scene, all, query, sampling).run({left / static_cast<double>(cells_left--), 60});
        ratios.add(query, sampling, cell);
        if (query == Query::counted) counted_us[sampling] = cell.series.front().us;
        if (query == Query::all) {
          lists[sampling].us += cell.series.front().us - counted_us[sampling];
          lists[sampling].pairs += cell.pairs;
        }
        timed_differences += cell.differences;
        add_cell(results, described, query, sampling, cell);
        for (const Series& s : cell.series)
          if (s.name == "fcl" && query == Query::any && sampling == Sampling::random) fcl_us = s.us;
      }
    torsions.add(torsions_ratio(scene, results, described, fcl_us));
    const double ratio = floor_ratio(scene, results, described);
    // The largest set-up of the paper's myoglobin, or of 1UBQ, which replaces it without the shared data.
    if ((setup.name == "1mbn" || setup.name == "1ubq") && scene.dof_count() > floor_dof) {
      floor = ratio;
      floor_dof = scene.dof_count();
    }
    std::printf("%-7s %4d free %5zu dof %5zu atoms, near-free sigma %.2g deg, %d differences, %.0f s\n",
                setup.name.c_str(), setup.residues, scene.dof_count(), scene.size(),
                scene.near_free_sigma() * 180 / std::numbers::pi, here.differences + timed_differences,
                seconds_since(start));
    std::fflush(stdout);
  }
  ratios.print(results);
  for (const Sampling sampling : {Sampling::random, Sampling::five_degrees}) {
    const double ns = lists[sampling].ns_per_pair();
    results.print(std::string("list all ") + name(sampling) + " ns-per-pair", ns);
    results.add({{"kind", "list"}, {"sampling", name(sampling)}, {"ns_per_pair", ns}});
  }
  results.print("floor any near-free " + std::to_string(floor_dof) + "dof", floor);
  std::printf("torsions any random fcl %.1f\n", torsions.value());
  std::printf("checked %d, differences %d\n", checked.conformations, checked.differences + timed_differences);
  results.add({{"kind", "checked"},
               {"conformations", checked.conformations},
               {"differences", checked.differences},
               {"timed_differences", timed_differences}});
  results.add({{"kind", "mean"}, {"torsions_fcl", torsions.value()}, {"floor", floor}, {"floor_dof", floor_dof}});
  for (const Setup& setup : all_free_setups(setups)) {
    Scene scene(read_protein(setup.file, setup.hydrogens), setup.residues);
    run_threads(results, describe(setup, scene), scene);
  }
  run_growth(results);
  const std::size_t wrong_blocks = print_batches(), wrong_moves = print_walks(results);
  int wrong_paths = 0;
  const auto [moving, path_sets] = protein_paths();
  for (const ProteinPaths& set : path_sets) {
    const Scene scene(moving, set.free);
    const PathRow row = measure_paths(scene, set, paths_of_set);
    wrong_paths += row.wrong;
    print_path_ratios(results, set.name, row);
    add_paths(results, set.name, scene.dof_count(), row);
  }
  RobotRatios robots;
  const int robot_differences = run_robots({200, robot_seconds, true, 0}, robots, results);
  for (const char* peer : {"fcl-best", "fcl-native-best", "fcl-unshared"}) robots.print(peer, results);
  const std::size_t wrong_robot_batches = print_robot_batches(results);
  results.print_missed();
  results.write(arguments.json);
  return wrong_blocks == 0 && wrong_robot_batches == 0 && wrong_moves == 0 && wrong_paths == 0 &&
                 checked.differences + timed_differences + robot_differences == 0
             ? 0
             : 1;
}
