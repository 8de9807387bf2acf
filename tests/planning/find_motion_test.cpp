// SPDX-License-Identifier: BSD-3-Clause
// Tests the search for motions with a point in a square, whose obstacles are walls without thickness.
#include "hinge_planning/find_motion.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "hinge/core/philox.hpp"
#include "hinge_planning/motion_problem.hpp"

namespace hinge::planning {
namespace find_motion_test {

using Values = std::span<const double>;

/// A wall from (x, low) to (x, high).
struct Wall {
  double x, low, high;

  /// True if the segment touches the wall.
  bool meets(Values a, Values b) const {
    if ((a[0] < x && b[0] < x) || (a[0] > x && b[0] > x)) return false;
    const double share = a[0] == b[0] ? 0.0 : (x - a[0]) / (b[0] - a[0]);
    const double y = a[1] + share * (b[1] - a[1]);
    return y >= low && y <= high;
  }
};

/// A point that moves in the square from (0, 0) to (1, 1).
struct Room {
  std::vector<Wall> walls;
  double sampled = 0.0;  ///< the distance between states that seems_free tests; 0: there is no such test
  std::uint64_t proofs = 0, sampled_motions = 0;

  bool is_motion_free(Values a, Values b) {
    ++proofs;
    for (const Wall& wall : walls)
      if (wall.meets(a, b)) return false;
    return true;
  }
  /// A wall has no thickness, so hardly any state is on it: this test misses every wall.
  bool seems_free(Values a, Values b) {
    ++sampled_motions;
    const auto count = static_cast<std::size_t>(std::ceil(std::hypot(a[0] - b[0], a[1] - b[1]) / sampled));
    return test_along(a, b, count, [&](Values q) {
      for (const Wall& wall : walls)
        if (wall.meets(q, q)) return false;
      return true;
    });
  }
  MotionProblem problem() {
    MotionProblem made;
    made.dof_count = 2;
    made.largest_distance = std::sqrt(2.0);
    made.distance = [](Values a, Values b) { return std::hypot(a[0] - b[0], a[1] - b[1]); };
    made.draw = [](SampleStream& stream, std::span<double> q) {
      for (double& value : q) value = stream.uniform();
    };
    made.is_free = [](Values) { return true; };
    made.is_motion_free = [this](Values a, Values b) { return is_motion_free(a, b); };
    if (sampled > 0.0) made.seems_free = [this](Values a, Values b) { return seems_free(a, b); };
    return made;
  }
};

void expect_free(const FoundMotion& found, Room& room) {
  for (std::size_t k = 1; k < found.waypoints.size(); ++k)
    EXPECT_TRUE(room.is_motion_free(found.waypoints[k - 1], found.waypoints[k])) << "waypoint " << k;
}

const std::vector<double> from{0.1, 0.1}, to{0.9, 0.1};

TEST(FindMotion, ProvesWhatSeemsFree) {
  for (const double sampled : {0.0, 0.01})
    for (std::uint64_t seed = 1; seed <= 50; ++seed) {
      SCOPED_TRACE("sampled " + std::to_string(sampled) + ", seed " + std::to_string(seed));
      Room room{{{0.3, 0.0, 0.6}, {0.5, 0.2, 1.0}, {0.7, 0.0, 0.8}}, sampled};
      const MotionProblem problem = room.problem();
      const MotionSearch search{0.3, 20'000, seed, {}};
      FoundMotion found = connect(problem, from, to, search);
      ASSERT_TRUE(found.reached);
      EXPECT_EQ(found.waypoints.front(), from);
      EXPECT_EQ(found.waypoints.back(), to);
      expect_free(found, room);
      EXPECT_LT(found.motions, 20'000U);
      shorten(problem, found, search);
      EXPECT_EQ(found.waypoints.front(), from);
      EXPECT_EQ(found.waypoints.back(), to);
      expect_free(found, room);
    }
}

TEST(FindMotion, SparesProofsWhereTheSampleSuffices) {
  // Walls of some thickness, which the sample sees.
  Room room{{}, 0.01};
  for (double x = 0.4; x <= 0.6; x += 0.005) room.walls.push_back({x, 0.0, 0.9});
  Room proved = room;
  proved.sampled = 0.0;
  MotionProblem problem = room.problem();
  problem.seems_free = [&](Values a, Values b) {
    ++room.sampled_motions;
    return test_along(a, b, 200, [&](Values q) { return q[0] < 0.4 || q[0] > 0.6 || q[1] > 0.9; });
  };
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    EXPECT_TRUE(connect(problem, from, to, {0.3, 20'000, seed, {}}).reached);
    EXPECT_TRUE(connect(proved.problem(), from, to, {0.3, 20'000, seed, {}}).reached);
  }
  EXPECT_GT(room.sampled_motions, 5 * room.proofs);
  EXPECT_GT(proved.proofs, 5 * room.proofs);
}

TEST(FindMotion, ReturnsThePartThatIsProved) {
  // Every motion seems free, and none through the middle is.
  Room room{{{0.5, 0.0, 1.0}}, 0.01};
  const FoundMotion found = connect(room.problem(), from, to, {0.3, 1000, 1, {}});
  EXPECT_FALSE(found.reached);
  EXPECT_EQ(found.waypoints.front(), from);
  EXPECT_LT(found.waypoints.back()[0], 0.5);
  expect_free(found, room);
  EXPECT_GE(found.motions, 1000U);
  EXPECT_LT(found.motions, 1400U);
}

TEST(FindMotion, KeepsWhatWasFoundWhenItIsStopped) {
  Room room{{{0.5, 0.0, 1.0}}, 0.0};
  MotionProblem problem = room.problem();
  // The sample sees the wall, so the search goes on until it is stopped.
  problem.seems_free = [&](Values a, Values b) { return !room.walls.front().meets(a, b); };
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    SCOPED_TRACE(seed);
    std::uint64_t asked = 0;
    const MotionSearch search{0.1, 1'000'000, seed, [&] { return ++asked > 500; }};
    const FoundMotion found = find_motion(problem, from, to, search);
    EXPECT_FALSE(found.reached);
    EXPECT_LT(asked, 700U);
    EXPECT_LT(found.remaining, 0.6);  // from 0.8; the wall is 0.4 from the end
    expect_free(found, room);
  }
}

TEST(FindMotion, TestsStatesOnTheWay) {
  std::vector<double> seen;
  const auto note = [&](Values q) {
    seen.push_back(q[0]);
    return true;
  };
  const std::vector<double> a{0.0}, b{1.0};
  EXPECT_TRUE(test_along(a, b, 5, note));
  EXPECT_EQ(seen.front(), 1.0);  // the end comes first
  std::ranges::sort(seen);
  ASSERT_EQ(seen.size(), 5U);  // and each other state once
  for (std::size_t k = 0; k < 5; ++k) EXPECT_NEAR(seen[k], 0.2 * static_cast<double>(k + 1), 1e-15);
  EXPECT_TRUE(test_along(a, a, 0, note));
  EXPECT_FALSE(test_along(a, b, 100, [](Values q) { return q[0] < 0.37 || q[0] > 0.38; }));
}

}  // namespace find_motion_test
}  // namespace hinge::planning
