// SPDX-License-Identifier: BSD-3-Clause
// Straight paths: proved free, against looking at states a degree or a tenth of one apart; proteins and robots. Times
// of free paths, segments, collisions that sampling misses; every answer is checked.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <ctime>
#include <limits>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

#include "hinge/core/philox.hpp"
#include "hinge/motion/certified_path.hpp"
#include "hinge/motion/check_sampled.hpp"
#include "hinge/robotics/any_hierarchy.hpp"
#include "results.hpp"
#include "robots/make_subject.hpp"
#include "scene.hpp"

namespace {

using namespace hinge;
using namespace hinge::bench;

constexpr double degree = std::numbers::pi / 180.0;
constexpr int looked_at = 1000;  // states of every path that was called free

struct Path {
  std::vector<double> from, to;
};

/// Time of this thread alone, microseconds: the machine is shared.
double thread_microseconds() {
  timespec now{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return 1e6 * static_cast<double>(now.tv_sec) + 1e-3 * static_cast<double>(now.tv_nsec);
}

enum Method : std::size_t { certified, tenth, one, five, methods };
constexpr std::array<const char*, methods> method_names = {"certified", "sampled-0.1deg", "sampled-1deg",
                                                           "sampled-5deg"};
constexpr std::array<double, methods> steps = {0.0, 0.1, 1.0, 5.0};

struct Row {
  int free = 0, colliding = 0, undecided = 0, wrong = 0;
  std::array<double, methods> free_us{}, colliding_us{};  // sums
  std::array<int, methods> missed{};                      // colliding paths that were called free
  double segments = 0.0, listed = 0.0;                    // of free paths
};

template <class H>
bool collides_at(H& h, const Path& path, double t) {
  std::vector<double> q(path.from.size());
  for (std::size_t k = 0; k < q.size(); ++k) q[k] = path.from[k] + t * (path.to[k] - path.from[k]);
  h.update(q);
  return h.self_collides();
}

/// All methods take turns on every path; the best of three counts.
template <class H>
Row measure(const H& hierarchy, const std::vector<Path>& paths) {
  H h = hierarchy;
  CertifiedPath certify(hierarchy);
  Row row;
  for (const Path& path : paths) {
    std::array<double, methods> best;
    best.fill(std::numeric_limits<double>::infinity());
    std::array<PathAnswer, methods> answers;
    for (int repetition = 0; repetition < repetitions; ++repetition)
      for (std::size_t m = 0; m < methods; ++m) {
        const double start = thread_microseconds();
        answers[m] = m == certified ? certify.check(path.from, path.to)
                                    : check_sampled(h, path.from, path.to, steps[m] * degree);
        best[m] = std::min(best[m], thread_microseconds() - start);
      }
    const PathAnswer& answer = answers[certified];
    const bool is_free = answer.verdict == PathVerdict::free;
    row.free += is_free;
    row.colliding += answer.verdict == PathVerdict::colliding;
    row.undecided += answer.verdict == PathVerdict::undecided;
    if (is_free) {
      row.segments += static_cast<double>(answer.counts.segments);
      row.listed += static_cast<double>(answer.counts.pairs_listed);
      bool wrong = false;
      for (int k = 0; k <= looked_at && !wrong; ++k) wrong = collides_at(h, path, static_cast<double>(k) / looked_at);
      row.wrong += wrong;
    }
    if (answer.verdict == PathVerdict::colliding) {
      h.update(answer.configuration);
      row.wrong += !h.self_collides();
    }
    for (std::size_t m = 0; m < methods; ++m) {
      if (is_free) row.free_us[m] += best[m];
      if (answer.verdict != PathVerdict::colliding) continue;
      row.colliding_us[m] += best[m];
      row.missed[m] += answers[m].verdict == PathVerdict::free;
    }
  }
  return row;
}

void print(Results& results, const std::string& set, std::size_t dof, const Row& row) {
  const auto mean = [](double sum, int count) { return count > 0 ? sum / count : std::nan(""); };
  std::printf("%-14s %4zu %5d %5d %5d %5d |", set.c_str(), dof, row.free, row.colliding, row.undecided, row.wrong);
  for (std::size_t m = 0; m < methods; ++m) std::printf(" %9.1f", mean(row.free_us[m], row.free));
  std::printf(" | %7.1f %7.0f | %9.1f | %4d %4d %4d\n", mean(row.segments, row.free), mean(row.listed, row.free),
              mean(row.colliding_us[certified], row.colliding), row.missed[five], row.missed[one], row.missed[tenth]);
  for (const Method m : {tenth, one})
    if (row.free > 0)
      std::printf("path any %s %s %.2f\n", set.c_str(), method_names[m], row.free_us[m] / row.free_us[certified]);
  std::fflush(stdout);
  Json json = {{"kind", "path"},
               {"set", set},
               {"dof", dof},
               {"free", row.free},
               {"colliding", row.colliding},
               {"undecided", row.undecided},
               {"wrong", row.wrong}};
  for (std::size_t m = 0; m < methods; ++m) {
    const std::string name = method_names[m];
    json[name + "_free_us"] = row.free > 0 ? Json(row.free_us[m] / row.free) : Json();
    json[name + "_missed"] = row.missed[m];
  }
  json["segments"] = row.free > 0 ? Json(row.segments / row.free) : Json();
  results.add(std::move(json));
}

/// States of a walk from the native structure by free moves of one torsion each within +-amplitude, ten moves a torsion
/// from one to the next; two states make a path.
template <class H>
std::vector<Path> walk(H& h, double amplitude, int count) {
  SampleStream random(seed, 1);
  std::vector<double> q(h.dof_count(), 0.0);
  const auto next_state = [&] {
    for (std::size_t move = 0; move < 10 * q.size(); ++move) {
      const auto k = static_cast<std::size_t>(random.uniform() * static_cast<double>(q.size()));
      const double before = q[k];
      q[k] = amplitude * (2.0 * random.uniform() - 1.0);
      h.update(q);
      if (h.self_collides()) q[k] = before;
    }
    return q;
  };
  std::vector<Path> paths;
  for (int k = 0; k < count; ++k) {
    Path path{next_state(), {}};
    path.to = next_state();
    paths.push_back(std::move(path));
  }
  return paths;
}

int run_proteins(Results& results, int count) {
  std::string file = shared_molecule("paper/1mbn.pdb"), tail = "A:142-153";
  if (file.empty()) {
    std::printf("paper/1mbn.pdb is not beside the repository: 1UBQ takes its place\n");
    file = ubiquitin();
    tail = "A:65-76";
  }
  const Protein protein = read_protein(file, false);
  struct Set {
    const char* name;
    std::string free;
    double amplitude;
  };
  int wrong = 0;
  for (const Set& set : {Set{"tail-5deg", tail, 5.0}, Set{"tail-20deg", tail, 20.0}, Set{"k10-5deg", "count:10", 5.0},
                         Set{"k10-20deg", "count:10", 20.0}, Set{"k35-5deg", "count:35", 5.0},
                         Set{"k35-20deg", "count:35", 20.0}, Set{"k153-1deg", "count:153", 1.0}}) {
    const Scene scene(protein, set.free);
    auto h = scene.make<Wide>();
    const Row row = measure(h, walk(h, set.amplitude * degree, count));
    print(results, set.name, scene.dof_count(), row);
    wrong += row.wrong;
  }
  return wrong;
}

int run_robots(Results& results, int count) {
  int wrong = 0;
  for (const SubjectKind& kind : subject_kinds) {
    const Subject subject = make_subject(kind, 0);
    const robotics::Robot& robot = subject.robot();
    const robotics::RobotHierarchy<Wide> h(robot.model(), subject.filter(), robotics::LinkMargins(robot));
    robotics::RobotHierarchy<Wide> ends = h;
    for (const double amplitude : {5.0, 20.0}) {
      std::vector<Path> paths;
      for (std::uint64_t k = 0;
           paths.size() < static_cast<std::size_t>(count) && k < 20U * static_cast<unsigned>(count); ++k) {
        SampleStream random(robot_seed, k);
        std::vector<double> q = test::random_configuration(robot, random);
        Path path{robot.expand(q), {}};
        for (double& value : q) value += amplitude * degree * (2.0 * random.uniform() - 1.0);
        path.to = robot.expand(q);
        if (!collides_at(ends, path, 0.0) && !collides_at(ends, path, 1.0)) paths.push_back(std::move(path));
      }
      const Row row = measure(h, paths);
      print(results, subject.name() + "-" + std::to_string(static_cast<int>(amplitude)) + "deg", h.dof_count(), row);
      wrong += row.wrong;
    }
  }
  return wrong;
}

}  // namespace

int main(int argc, char** argv) {
  const Arguments arguments = Arguments::parse(argc, argv, 60, "PATHS of each set");
  Results results("paths");
  std::printf(
      "microseconds of a free path; states at both ends are sampled, too; wrong: answers that the query contradicts\n"
      "%-14s %4s %5s %5s %5s %5s | %9s %9s %9s %9s | %7s %7s | %9s | missed at 5, 1, 0.1 degrees\n",
      "set", "dof", "free", "coll.", "open", "wrong", "certified", "0.1 deg", "1 deg", "5 deg", "segm.", "pairs",
      "colliding");
  const int count = static_cast<int>(arguments.number);
  const int wrong = run_proteins(results, count) + run_robots(results, count);
  results.write(arguments.json);
  return wrong == 0 ? 0 : 1;
}
