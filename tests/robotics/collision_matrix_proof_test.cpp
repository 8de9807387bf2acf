// SPDX-License-Identifier: BSD-3-Clause
// Tests the proofs of the collision matrix: random samples and descents try to refute them.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <limits>
#include <string>
#include <vector>

#include "hinge/core/philox.hpp"
#include "hinge/hierarchy.hpp"
#include "hinge/robotics/collision_matrix.hpp"
#include "hinge/robotics/link_margins.hpp"
#include "hinge/robotics/tested_pairs.hpp"
#include "robotics/built_robots.hpp"
#include "robotics/robots.hpp"

namespace hinge::robotics {
namespace collision_matrix_proof_test {

using test::Builder;
using test::few_samples;

constexpr std::uint64_t seed = 20'250'612;

LinkPairs pairs_of_kind(const Robot& robot, const CollisionMatrix& matrix, PairKind kind) {
  LinkPairs pairs(robot.link_count());
  for (const MatrixEntry& entry : matrix.entries)
    if (entry.kind == kind) pairs.insert(entry.link1, entry.link2);
  return pairs;
}

/// Searches for a configuration in which one of the pairs collides. Searches return a description of it, or "".
class Refuter {
 public:
  Refuter(const Robot& robot, const LinkPairs& pairs)
      : robot_(robot), links_(robot.model(), LinkPairFilter(robot, pairs), LinkMargins(robot)) {}

  std::string random(std::size_t count) {
    for (std::size_t k = 0; k < count; ++k) {
      SampleStream stream(seed, k);
      links_.update(robot_.expand(test::random_configuration(robot_, stream)));
      if (links_.self_collides()) return "sample " + std::to_string(k) + " of seed " + std::to_string(seed);
    }
    return "";
  }

  /// Minimizes the distance of the closest pair, one joint at a time, with shrinking steps. Starts inside the limits
  /// and at their corners.
  std::string downhill(std::size_t starts, std::size_t rounds) {
    for (std::size_t s = 0; s < starts; ++s) {
      SampleStream stream(seed + 1, s);
      std::vector<double> q = test::random_configuration(robot_, stream);
      for (std::size_t k = 0; k < q.size(); ++k)
        if (stream.uniform() < 0.3) q[k] = stream.uniform() < 0.5 ? robot_.lower()[k] : robot_.upper()[k];
      double best = distance(q), step = 0.25;
      for (std::size_t r = 0; r < rounds && best > 0.0; ++r, step *= 0.7)
        for (std::size_t k = 0; k < q.size(); ++k)
          for (const double sign : {-1.0, 1.0}) {
            std::vector<double> there = q;
            const double width = robot_.upper()[k] - robot_.lower()[k];
            there[k] = std::clamp(q[k] + sign * step * width, robot_.lower()[k], robot_.upper()[k]);
            const double d = distance(there);
            if (d < best) {
              best = d;
              q = there;
            }
          }
      if (best <= 0.0) return "start " + std::to_string(s) + " of seed " + std::to_string(seed + 1);
    }
    return "";
  }

 private:
  double distance(const std::vector<double>& q) {
    links_.update(robot_.expand(q));
    const auto closest = links_.self_closest();
    return closest ? std::max(closest->gap(), 0.0) : std::numeric_limits<double>::infinity();
  }
  const Robot& robot_;
  Hierarchy<Triangle, LinkPairFilter, LinkMargins> links_;
};

/// Returns a random tree of boxes with joints of all types and with mimic joints.
Robot random_robot(std::uint64_t number) {
  SampleStream stream(seed, number);
  const auto in = [&](double low, double high) { return low + stream.uniform() * (high - low); };
  const auto vector = [&](double scale) { return Vec3(in(-scale, scale), in(-scale, scale), in(-scale, scale)); };
  Builder build;
  std::vector<std::string> driver;
  for (std::size_t k = 0; k < 6; ++k) {
    const std::string name = "link" + std::to_string(k);
    build.link(name).box(Vec3(in(0.05, 0.4), in(0.05, 0.2), in(0.05, 0.2)), vector(0.1));
    if (k == 0) continue;
    const double type = stream.uniform();
    const auto parent = static_cast<std::size_t>(in(0.4, 1.0) * static_cast<double>(k));
    const double low = in(-1.5, 0.2);
    build.joint(type < 0.2   ? JointType::prismatic
                : type < 0.3 ? JointType::continuous
                             : JointType::revolute,
                "link" + std::to_string(parent), name, vector(0.4), vector(1.0) + Vec3(0, 0, 0.01), low,
                low + in(0.0, 1.5));
    if (!driver.empty() && stream.uniform() < 0.3)
      build.mimic(driver.back(), in(-1.5, 1.5), in(-0.2, 0.2));
    else
      driver.push_back("to_" + name);
  }
  return build.robot();
}

TEST(CollisionMatrix, NothingRefutesWhatItProved) {
  std::size_t proved = 0;
  MatrixOptions options = few_samples();
  options.cells = 2'000;
  for (std::uint64_t number = 0; number < 60; ++number) {
    SCOPED_TRACE("robot " + std::to_string(number) + " of seed " + std::to_string(seed));
    const Robot robot = random_robot(number);
    const CollisionMatrix matrix = find_collision_matrix(robot, options);
    const LinkPairs never = pairs_of_kind(robot, matrix, PairKind::never);
    proved += never.size();
    if (never.size() == 0) continue;
    EXPECT_EQ(Refuter(robot, never).random(20'000), "");
    for (const auto& [a, b] : never.list()) {
      LinkPairs one(robot.link_count());
      one.insert(a, b);
      EXPECT_EQ(Refuter(robot, one).downhill(4, 12), "") << robot.link_name(a) << " and " << robot.link_name(b);
    }
  }
  EXPECT_GT(proved, 150U);
}

/// The converse: pairs that a finer search sees colliding are not proved, and most other pairs are.
TEST(CollisionMatrix, LeavesLittleUndecidedOnSmallRobots) {
  std::size_t undecided = 0, all = 0;
  for (std::uint64_t number = 0; number < 20; ++number)
    for (const MatrixEntry& entry : find_collision_matrix(random_robot(number), few_samples()).entries) {
      undecided += entry.kind == PairKind::unseen ? 1U : 0U;
      ++all;
    }
  EXPECT_EQ(all, 20U * 15U);
  EXPECT_LE(undecided, all / 20);
}

class SharedMatrix : public testing::TestWithParam<const char*> {};

TEST_P(SharedMatrix, NothingRefutesWhatItProved) {
  if (!std::filesystem::exists(test::shared_folder(GetParam())))
    GTEST_SKIP() << "no shared data at " << test::shared_folder(GetParam());
  const Robot robot = test::load_shared(GetParam()).robot;
  const CollisionMatrix matrix = find_collision_matrix(robot, few_samples());
  const LinkPairs never = pairs_of_kind(robot, matrix, PairKind::never);
  EXPECT_GE(never.size(), 12U);
  EXPECT_NE(Refuter(robot, pairs_of_kind(robot, matrix, PairKind::sometimes)).random(1'000), "");
  EXPECT_NE(Refuter(robot, pairs_of_kind(robot, matrix, PairKind::sometimes)).downhill(20, 8), "");
  const bool small = robot.model().size() < 10'000;  // the distance of large meshes is slow
  EXPECT_EQ(Refuter(robot, never).random(small ? 100'000 : 10'000), "");
  EXPECT_EQ(Refuter(robot, never).downhill(small ? 20 : 1, 8), "");
}

INSTANTIATE_TEST_SUITE_P(Robots, SharedMatrix, testing::Values("panda", "ur5_robotiq"),
                         [](const auto& robot) { return std::string(robot.param); });

}  // namespace collision_matrix_proof_test
}  // namespace hinge::robotics
