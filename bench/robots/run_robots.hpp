// SPDX-License-Identifier: BSD-3-Clause
// run_robots: times, ratios and differences for the five robots, as a table and as rows of results.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdio>
#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "results.hpp"
#include "robots/make_subject.hpp"
#include "robots/referee.hpp"
#include "robots/robot_contestant.hpp"
#include "robots/robot_timing.hpp"
#include "robots/scenery.hpp"
#include "robots/subject.hpp"

namespace hinge::bench {

/// Extent of a benchmark run.
struct RobotRun {
  std::size_t postures = 200;
  double seconds = 3.0;  ///< for each query of each robot
  bool native = true;    ///< includes FCL compiled for this machine
  std::size_t cold = 0;  ///< number of postures timed with a cold cache
};

/// Ratios of FCL's time to Hinge's, with the better of FCL's loop and manager for each robot and query.
class RobotRatios {
 public:
  void add(const std::string& query, const std::string& robot, const std::string& peer, double ratio) {
    rows_.push_back({query, robot, peer, ratio});
  }
  /// Prints lines "ratio QUERY ROBOT PEER X" of one peer; the last line of a query is the geometric mean over robots.
  void print(const std::string& peer, Results& results) const {
    std::vector<std::string> queries;
    for (const Row& row : rows_)
      if (std::find(queries.begin(), queries.end(), row.query) == queries.end()) queries.push_back(row.query);
    for (const std::string& query : queries) {
      GeometricMean mean;
      const auto put = [&](const std::string& robot, double ratio) {
        results.print("ratio " + query + ' ' + robot + ' ' + peer, ratio, ratio < 1.0 ? 3 : 1);
        results.add({{"kind", "robot-ratio"}, {"query", query}, {"robot", robot}, {"peer", peer}, {"ratio", ratio}});
      };
      for (const Row& row : rows_) {
        if (row.query != query || row.peer != peer) continue;
        put(row.robot, row.ratio);
        mean.add(row.ratio);
      }
      if (mean.count() > 0) put("mean", mean.value());
    }
  }

 private:
  struct Row {
    std::string query, robot, peer;
    double ratio;
  };
  std::vector<Row> rows_;
};

/// The scene in the form of each contestant, made once for all robots.
class SceneSet {
 public:
  explicit SceneSet(bool with_native) {
    const double start = thread_seconds();
    const robotics::LinkPairs none(scenery_.body.link_count());
    hinge = std::make_shared<TimedHierarchy>(scenery_.body.model(), robotics::LinkPairFilter(scenery_.body, none),
                                             UniformClearance{0.0});
    const double built = thread_seconds();
    debian = std::make_shared<oracle::FclScene<oracle::FclBuild::debian>>(scenery_.objects);
    const double debian_built = thread_seconds();
    if (with_native) native = std::make_shared<oracle::FclScene<oracle::FclBuild::native>>(scenery_.objects);
    std::printf("scene: %zu triangles, built in %.2f s; FCL scene, one mesh and %zu objects, built in %.1f s\n",
                scenery_.body.model().size(), built - start, scenery_.objects.size(), debian_built - built);
  }
  void place(const Pose& at) {
    const std::vector<Pose> poses = {Pose{}, at};
    hinge->update_poses(poses);
    if (native) native->place(placement(at));
  }

 private:
  Scenery scenery_ = Scenery::make();

 public:
  std::shared_ptr<TimedHierarchy> hinge;
  std::shared_ptr<oracle::FclScene<oracle::FclBuild::debian>> debian;
  std::shared_ptr<oracle::FclScene<oracle::FclBuild::native>> native;
};

/// Milliseconds, best of the rounds; `prepare` is not timed.
template <class Prepare, class Build>
double best_build(const Prepare& prepare, const Build& build) {
  double best = std::numeric_limits<double>::infinity();
  for (int round = 0; round < robot_rounds; ++round) {
    auto prepared = prepare();
    const double start = thread_seconds();
    build(prepared);
    best = std::min(best, 1e3 * (thread_seconds() - start));
  }
  return best;
}

template <oracle::FclBuild b>
double fcl_build(const Subject& subject) {
  return best_build([&] { return oracle::FclTrees<b>(subject.meshes()); }, [](auto& trees) { trees.build(); });
}

inline void time_building(const Subject& subject, const RobotRun& run, RobotRatios& ratios, Results& results) {
  std::optional<TimedHierarchy> made;
  const double hinge = best_build(
      [&] {
        made.reset();
        return subject.filter();
      },
      [&](auto& filter) { made.emplace(subject.robot().model(), filter, UniformClearance{0.0}); });
  Json row = {{"kind", "robot-build"}, {"robot", subject.name()}, {"hinge_ms", hinge}};
  std::printf("%-12s %-18s %9.1f", subject.name().c_str(), "build, ms", hinge);
  const auto against = [&](const char* peer, double ms) {
    ratios.add("robot-build", subject.name(), peer, ms / hinge);
    row[peer] = ms;
    std::printf("  %s %.1f (%.1f)", peer, ms, ms / hinge);
  };
  against("fcl-best", fcl_build<oracle::FclBuild::debian>(subject));
  if (run.native) against("fcl-native-best", fcl_build<oracle::FclBuild::native>(subject));
  std::printf("\n");
  results.add(std::move(row));
}

/// Returns the number of answers that differ, without pairs within the touching tolerance.
inline int run_robot(const Subject& subject, int distances, SceneSet& scenes, const RobotRun& run, RobotRatios& ratios,
                     Results& results) {
  HingeRobot hinge(subject, scenes.hinge);
  const FclPeer<oracle::FclBuild::debian> debian(subject, scenes.debian);
  scenes.place(find_place(*scenes.debian, *debian.robot, subject));
  hinge.learn_scene(subject);
  std::vector<RobotContestant> all = {
      {"hinge", [&](std::size_t posture, RobotQuery q, RobotAnswer& answer) { hinge.ask(posture, q, answer); }},
      debian.contestant("fcl-loop", oracle::FclManner::loop),
      debian.contestant("fcl-manager", oracle::FclManner::manager)};
  const std::size_t cold_contestants = all.size();
  if (run.native) {
    const FclPeer<oracle::FclBuild::native> native(subject, scenes.native);
    all.push_back(native.contestant("fcl-native-loop", oracle::FclManner::loop));
    all.push_back(native.contestant("fcl-native-manager", oracle::FclManner::manager));
  }
  Referee referee(subject, hinge, debian);
  for (const RobotQuery query : robot_queries) {
    const std::size_t postures =
        query == RobotQuery::distance ? std::min(run.postures, static_cast<std::size_t>(distances)) : run.postures;
    std::vector<RobotContestant> asked = all;
    if (query == RobotQuery::distance) asked.push_back(debian.contestant("fcl-unshared", oracle::FclManner::unshared));
    const std::vector<RobotSeries> series = time_robot(asked, query, postures, run.seconds);
    std::size_t hits = 0;
    for (std::size_t p = 0; p < series[0].postures; ++p)
      hits += series[0].answers[p].hit || !series[0].answers[p].pairs.empty() || series[0].answers[p].distance <= 0.0;
    std::printf("%-12s %-18s %9.2f", subject.name().c_str(), name(query), series[0].us);
    double best = std::numeric_limits<double>::infinity(), best_native = best, unshared = 0.0;
    for (const RobotSeries& s : series) {
      results.add({{"kind", "robot-time"},
                   {"robot", subject.name()},
                   {"query", name(query)},
                   {"peer", s.name},
                   {"us", s.us},
                   {"hinge_us", s.hinge_us},
                   {"postures", s.postures},
                   {"hits", static_cast<double>(hits) / static_cast<double>(series[0].postures)}});
      if (&s == &series[0]) continue;
      if (s.name == "fcl-unshared") {
        unshared = s.us;
        ratios.add(name(query), subject.name(), s.name, s.ratio());
      } else {
        double& least = s.name.starts_with("fcl-native") ? best_native : best;
        least = std::min(least, s.ratio());
        std::printf(" %10.1f", s.us);
      }
      for (std::size_t p = 0; p < s.postures; ++p)
        referee.compare(query, p, series[0].answers[p], s.answers[p], s.name);
    }
    std::printf("  %6.*f", best < 1.0 ? 3 : 1, best);
    ratios.add(name(query), subject.name(), "fcl-best", best);
    if (run.native) {
      std::printf(" %6.*f", best_native < 1.0 ? 3 : 1, best_native);
      ratios.add(name(query), subject.name(), "fcl-native-best", best_native);
    }
    std::printf("  %3.0f %% of %zu", 100.0 * static_cast<double>(hits) / static_cast<double>(series[0].postures),
                series[0].postures);
    if (unshared > 0.0) std::printf("; manager without a shared bound %.0f us", unshared);
    std::printf("\n");
    std::fflush(stdout);
    if (run.cold == 0 || query == RobotQuery::distance) continue;
    const auto cold = time_cold({all.data(), cold_contestants}, query, std::min(run.cold, series[0].postures));
    std::printf("%-12s %-18s %9.2f %10.1f %10.1f  %6.1f  cold cache\n", "", "", cold[0], cold[1], cold[2],
                std::min(cold[1], cold[2]) / cold[0]);
    results.add({{"kind", "robot-cold"},
                 {"robot", subject.name()},
                 {"query", name(query)},
                 {"us", cold[0]},
                 {"fcl_loop_us", cold[1]},
                 {"fcl_manager_us", cold[2]}});
  }
  time_building(subject, run, ratios, results);
  results.add({{"kind", "robot-checked"},
               {"robot", subject.name()},
               {"differences", referee.differences()},
               {"touching", referee.touching_count()}});
  return referee.differences();
}

/// Adds the ratios to `ratios`, for the caller to print. Returns the number of differences.
inline int run_robots(const RobotRun& run, RobotRatios& ratios, Results& results) {
  SceneSet scenes(run.native);
  std::printf("robots, us: %-18s %9s %10s %10s%s  fcl/hinge%s  in collision\n", "query", "hinge", "fcl loop", "manager",
              run.native ? "  native: loop    manager" : "", run.native ? " native/hinge" : "");
  int differences = 0;
  for (const SubjectKind& kind : subject_kinds)
    differences += run_robot(make_subject(kind, run.postures), kind.distances, scenes, run, ratios, results);
  std::printf("robots: %d differences between Hinge and FCL in timed answers\n", differences);
  return differences;
}

}  // namespace hinge::bench
