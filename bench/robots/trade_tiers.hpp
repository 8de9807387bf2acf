// SPDX-License-Identifier: BSD-3-Clause
// trade_tiers: times and errors of coarser link shapes. Compares every tier of every robot with its exact meshes, on
// the same configurations and pairs of links.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <limits>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "hinge/hierarchy.hpp"
#include "hinge/query/link_pair_hits.hpp"
#include "hinge/robotics/link_margins.hpp"
#include "hinge/robotics/tiers.hpp"
#include "results.hpp"
#include "robots/make_subject.hpp"
#include "timing.hpp"

namespace hinge::bench {

using robotics::LinkMargins;
using robotics::LinkPairFilter;
using robotics::LinkPairs;
using robotics::Robot;
using robotics::RobotDescription;
using robotics::Tier;

inline constexpr Tier tiers[] = {Tier::mesh, Tier::hull, Tier::capsule, Tier::spheres};

struct TierCase {
  std::string name;
  RobotDescription description;
  LinkPairs disabled;
};

/// The shared robots, or generated ones if the shared data is absent.
inline std::vector<TierCase> tier_cases() {
  std::vector<TierCase> cases;
  for (const test::SharedRobot& shared : test::shared_robots()) {
    if (!std::filesystem::exists(test::shared_folder(shared.name))) continue;
    const test::LoadedRobot loaded = test::load_shared(shared.name);
    cases.push_back({shared.name, loaded.robot.description(), loaded.disabled});
  }
  if (!cases.empty()) return cases;
  std::printf("the shared data is missing: robots made in code are used instead\n");
  for (const SubjectKind& kind : subject_kinds) {
    const Robot robot = generated_robot(kind);
    cases.push_back({robot.name(), robot.description(), LinkPairs(robot.link_count())});
  }
  return cases;
}

/// Answers of one tier, by configuration.
struct TierAnswers {
  std::size_t primitives = 0;
  double fit_ms = 0.0, build_ms = 0.0;  // time from the exact shapes to the tier's shapes; from these to the engine
  std::vector<bool> collides;
  std::vector<double> distance;                          // m; 0 for a collision; fewer values if a distance takes long
  double any_us = 0.0, all_us = 0.0, distance_us = 0.0;  // means, from joint values
};

/// Mean over the configurations of the best time of ask(k). Each repetition runs all k in turn, so that each call
/// includes its update.
template <class Ask>
double mean_of_best(std::size_t count, const Ask& ask) {
  std::vector<double> best(count, std::numeric_limits<double>::infinity());
  for (int repetition = 0; repetition < repetitions; ++repetition)
    for (std::size_t k = 0; k < count; ++k) best[k] = std::min(best[k], microseconds([&] { ask(k); }));
  double sum = 0.0;
  for (const double us : best) sum += us;
  return sum / static_cast<double>(count);
}

/// Computes as many distances as two seconds allow, or `most` of them, the number of the first tier.
inline TierAnswers ask_tier(const RobotDescription& exact, Tier tier, const LinkPairs& tested,
                            const std::vector<std::vector<double>>& configurations, std::optional<std::size_t> most) {
  constexpr double distance_seconds = 2.0;
  TierAnswers answers;
  robotics::Tiers chosen;
  chosen.all = tier;
  RobotDescription description;
  answers.fit_ms = microseconds([&] { description = robotics::with_tiers(exact, chosen); }) / 1e3;
  const Robot robot(std::move(description));
  answers.primitives = robot.model().size();
  const LinkPairFilter filter(robot, tested);
  const LinkMargins margins(robot);
  using Checked = Hierarchy<Triangle, LinkPairFilter, LinkMargins>;
  std::optional<Checked> hierarchy;
  answers.build_ms = microseconds([&] { hierarchy.emplace(robot.model(), filter, margins); }) / 1e3;

  const std::size_t count = configurations.size();
  answers.collides.resize(count);
  answers.any_us = mean_of_best(count, [&](std::size_t k) {
    hierarchy->update(configurations[k]);
    answers.collides[k] = hierarchy->self_collides();
  });
  LinkPairHits hits(robot.model().links());
  answers.all_us = mean_of_best(count, [&](std::size_t k) {
    hierarchy->update(configurations[k]);
    hits.clear();
    hierarchy->self_query(hits);
  });
  const auto distance = [&](std::size_t k) {
    hierarchy->update(configurations[k]);
    const auto hit = hierarchy->self_closest();
    return hit ? std::max(0.0, hit->gap()) : std::numeric_limits<double>::infinity();
  };
  const auto start = Clock::now();
  while (answers.distance.size() < most.value_or(count) && (most || seconds_since(start) < distance_seconds))
    answers.distance.push_back(distance(answers.distance.size()));
  answers.distance_us = mean_of_best(answers.distance.size(), distance);
  return answers;
}

/// Errors of one tier relative to the exact meshes.
struct TierErrors {
  int colliding = 0, false_accepts = 0, false_rejects = 0;
  double mean = 0.0, largest = 0.0;  // errors of the distances, m
};

inline TierErrors compare(const TierAnswers& exact, const TierAnswers& given) {
  TierErrors e;
  for (std::size_t k = 0; k < exact.collides.size(); ++k) {
    e.colliding += exact.collides[k] ? 1 : 0;
    e.false_accepts += exact.collides[k] && !given.collides[k] ? 1 : 0;
    e.false_rejects += !exact.collides[k] && given.collides[k] ? 1 : 0;
  }
  for (std::size_t k = 0; k < exact.distance.size(); ++k) {
    const bool same = exact.distance[k] == given.distance[k];  // both are infinite if no pair is tested
    const double off = same ? 0.0 : std::abs(exact.distance[k] - given.distance[k]);
    e.mean += off / static_cast<double>(exact.distance.size());
    e.largest = std::max(e.largest, off);
  }
  return e;
}

/// Compares all tiers of one robot at `count` configurations.
inline void trade_tiers(const TierCase& scene, std::size_t count, Results& results) {
  const Robot exact(scene.description);
  const LinkPairs tested = tested_pairs(exact, scene.disabled);
  std::vector<std::vector<double>> configurations;
  for (std::size_t k = 0; k < count; ++k) {
    SampleStream stream(robot_seed, k);
    configurations.push_back(exact.expand(test::random_configuration(exact, stream)));
  }
  std::optional<TierAnswers> by_mesh;
  for (const Tier tier : tiers) {
    const TierAnswers answers = ask_tier(scene.description, tier, tested, configurations,
                                         by_mesh ? std::optional(by_mesh->distance.size()) : std::nullopt);
    if (!by_mesh) by_mesh = answers;
    const TierErrors e = compare(*by_mesh, answers);
    const auto percent = [](int part, double of) { return 100.0 * part / std::max(1.0, of); };
    const double colliding = e.colliding, n = static_cast<double>(count);
    if (tier == Tier::mesh)
      std::printf("\n%s: %zu configurations, %.1f %% collide, %zu pairs of links, %zu distances\n", scene.name.c_str(),
                  count, 100 * colliding / n, tested.size(), answers.distance.size());
    if (tier == Tier::mesh)
      std::printf("  %-8s %10s %9s %9s %9s %9s %11s %9s %9s %9s %9s\n", "", "primitives", "fit ms", "build ms",
                  "any us", "all us", "distance us", "accept %", "reject %", "mean mm", "max mm");
    std::printf("  %-8s %10zu %9.1f %9.2f %9.2f %9.2f %11.1f %9.2f %9.2f %9.3g %9.3g\n", name(tier), answers.primitives,
                answers.fit_ms, answers.build_ms, answers.any_us, answers.all_us, answers.distance_us,
                percent(e.false_accepts, colliding), percent(e.false_rejects, n - colliding), 1e3 * e.mean,
                1e3 * e.largest);
    std::fflush(stdout);
    results.add({{"kind", "robot-trade"},
                 {"robot", scene.name},
                 {"tier", name(tier)},
                 {"configurations", count},
                 {"colliding", e.colliding},
                 {"pairs", tested.size()},
                 {"primitives", answers.primitives},
                 {"fit_ms", answers.fit_ms},
                 {"build_ms", answers.build_ms},
                 {"any_us", answers.any_us},
                 {"all_us", answers.all_us},
                 {"distance_us", answers.distance_us},
                 {"distances", answers.distance.size()},
                 {"false_accepts", e.false_accepts},
                 {"false_rejects", e.false_rejects},
                 {"mean_distance_error", e.mean},
                 {"largest_distance_error", e.largest}});
  }
}

/// Compares all tiers of all robots.
inline void trade_tiers(std::size_t count, Results& results) {
  std::printf(
      "\nrobots, tiers against exact meshes; configurations uniform in the joint limits, seed %llu\n"
      "accept: reported free, but the meshes collide; reject: reported colliding, but the meshes are free\n",
      static_cast<unsigned long long>(robot_seed));
  for (const TierCase& scene : tier_cases()) trade_tiers(scene, count, results);
}

}  // namespace hinge::bench
