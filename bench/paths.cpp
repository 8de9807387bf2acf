// SPDX-License-Identifier: BSD-3-Clause
// Straight paths of proteins and robots: certified, against sampling at steps of 1 and 0.1 degrees. Prints times of
// free paths, segments, and collisions that sampling misses; every answer is checked.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <limits>
#include <string>
#include <utility>
#include <vector>

#include "hinge/core/philox.hpp"
#include "hinge/robotics/any_hierarchy.hpp"
#include "oracle/fcl_robots.hpp"
#include "path_rows.hpp"
#include "results.hpp"
#include "robots/make_subject.hpp"
#include "scene.hpp"

namespace {

using namespace hinge;
using namespace hinge::bench;

void print(Results& results, const std::string& set, std::size_t dof, const PathRow& row) {
  const auto mean = [](double sum, int count) { return count > 0 ? sum / count : std::nan(""); };
  std::printf("%-14s %4zu %5d %5d %5d %5d |", set.c_str(), dof, row.free, row.colliding, row.undecided, row.wrong);
  for (std::size_t m = 0; m < path_methods; ++m) std::printf(" %9.1f", mean(row.free_us[m], row.free));
  std::printf(" | %7.1f %7.0f | %9.1f | %4d %4d %4d\n", mean(row.segments, row.free), mean(row.listed, row.free),
              mean(row.colliding_us[certified], row.colliding), row.missed[sampled_five], row.missed[sampled_one],
              row.missed[sampled_tenth]);
  print_path_ratios(results, set, row);
  std::fflush(stdout);
  add_paths(results, set, dof, row);
}

int run_proteins(Results& results, int count) {
  const auto [protein, sets] = protein_paths();
  int wrong = 0;
  for (const ProteinPaths& set : sets) {
    const Scene scene(protein, set.free);
    const PathRow row = measure_paths(scene, set, count);
    print(results, set.name, scene.dof_count(), row);
    wrong += row.wrong;
  }
  return wrong;
}

/// FCL's time for states 0.1 degrees apart, poses given, over the time of certification, on free paths. Uses the
/// better of FCL's loop over pairs and its manager, in Debian's build. NaN without a free path.
double fcl_ratio(const Subject& subject, const robotics::RobotHierarchy<Simd>& h, const std::vector<Path>& paths) {
  constexpr int most = 10;  // FCL takes long
  oracle::FclRobot<oracle::FclBuild::debian> fcl(subject.meshes(), subject.pairs());
  CertifiedPath certify(h);
  double certified_us = 0.0;
  std::array<double, 2> fcl_us{};
  int asked = 0;
  for (const Path& path : paths) {
    if (asked == most) break;
    if (!certify.check(path.from, path.to).is_free()) continue;
    ++asked;
    double largest = 0.0;
    for (std::size_t k = 0; k < path.from.size(); ++k) largest = std::max(largest, std::abs(path.to[k] - path.from[k]));
    const auto steps = static_cast<std::size_t>(std::ceil(largest / (path_steps[sampled_tenth] * degree)));
    std::vector<std::vector<double>> states;
    for (std::size_t s = 0; s <= steps; ++s) {
      std::vector<double>& q = states.emplace_back(path.from);
      for (std::size_t k = 0; k < q.size(); ++k)
        q[k] += static_cast<double>(s) / static_cast<double>(steps) * (path.to[k] - path.from[k]);
    }
    std::vector<std::vector<oracle::Placement>> postures;
    for (Posture& posture : subject.postures_at(states)) postures.push_back(std::move(posture.links));
    fcl.set_postures(postures);
    std::array<double, 3> best;
    best.fill(std::numeric_limits<double>::infinity());
    for (int repetition = 0; repetition < repetitions; ++repetition) {
      const auto time = [&](std::size_t which, const auto& work) {
        const double start = thread_microseconds();
        work();
        best[which] = std::min(best[which], thread_microseconds() - start);
      };
      time(2, [&] { certify.check(path.from, path.to); });
      for (const auto manner : {oracle::FclManner::loop, oracle::FclManner::manager})
        time(static_cast<std::size_t>(manner), [&] {
          for (std::size_t s = 0; s < postures.size(); ++s) {
            fcl.take(s);
            if (fcl.any(manner)) std::printf("FCL finds a collision on a path that was proved free\n");
          }
        });
    }
    certified_us += best[2];
    for (std::size_t m = 0; m < 2; ++m) fcl_us[m] += best[m];
  }
  return std::min(fcl_us[0], fcl_us[1]) / certified_us;
}

int run_robots(Results& results, int count) {
  int wrong = 0;
  for (const SubjectKind& kind : subject_kinds) {
    const Subject subject = make_subject(kind, 0);
    const robotics::Robot& robot = subject.robot();
    const robotics::RobotHierarchy<Simd> h(robot.model(), subject.filter(), robotics::LinkMargins(robot));
    robotics::RobotHierarchy<Simd> ends = h;
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
      const PathRow row = measure_paths(h, paths);
      print(results, subject.name() + "-" + std::to_string(static_cast<int>(amplitude)) + "deg", h.dof_count(), row);
      wrong += row.wrong;
      const double ratio = fcl_ratio(subject, h, paths);
      std::printf("path any %s-%gdeg fcl-0.1deg %.1f\n", subject.name().c_str(), amplitude, ratio);
      results.add({{"kind", "path-fcl"}, {"robot", subject.name()}, {"amplitude", amplitude}, {"ratio", ratio}});
    }
  }
  return wrong;
}

}  // namespace

int main(int argc, char** argv) {
  const Arguments arguments = Arguments::parse(argc, argv, 60, "PATHS of each set");
  Results results("paths");
  std::printf(
      "microseconds per free path; sampling includes both end states; wrong: answers that contradict the query\n"
      "%-14s %4s %5s %5s %5s %5s | %9s %9s %9s %9s | %7s %7s | %9s | missed at 5, 1, 0.1 degrees\n",
      "set", "dof", "free", "coll.", "open", "wrong", "certified", "0.1 deg", "1 deg", "5 deg", "segm.", "pairs",
      "colliding");
  const int count = static_cast<int>(arguments.number);
  const int wrong = run_proteins(results, count) + run_robots(results, count);
  results.write(arguments.json);
  return wrong == 0 ? 0 : 1;
}
