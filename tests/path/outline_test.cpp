// SPDX-License-Identifier: BSD-3-Clause
// Outline: bounds of the speeds of many points, against the speed of each point.
#include "hinge/detail/path/outline.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "engine/random_mechanism.hpp"

namespace hinge {
namespace outline_test {

using test::Random;

TEST(Outline, BoundsTheSpeedOfEveryPoint) {
  constexpr std::uint64_t seed = 3;
  int tight = 0;
  for (std::uint64_t c = 0; c < 2000; ++c) {
    SCOPED_TRACE("seed 3, case " + std::to_string(c));
    Random random(seed + c);
    const std::size_t count = c % 4 == 3 ? 300 : 12 + c % 40;  // above 256 points the outline is the corners of a box
    const double unit = std::pow(10.0, random.uniform(-12.0, 0.0)), size = c % 3 == 0 ? 0.2 * unit : 0.0;
    const Vec3 shape(unit, unit * random.uniform(0.01, 1.0), unit * random.uniform(0.01, 1.0));
    std::vector<Vec3> points;
    for (std::size_t k = 0; k < count; ++k) points.emplace_back(random.vector(1.0).cwiseProduct(shape));
    const Vec3 centre = random.vector(0.1 * unit);
    double extent = 0.0;
    for (const Vec3& x : points) extent = std::max(extent, norm(Vec3(x - centre)) + size);
    const detail::Outline outline(points, centre, size, extent);
    ASSERT_FALSE(outline.is_empty());
    const double fast = std::pow(10.0, random.uniform(-100.0, 100.0));
    const Vec3 turn = random.vector(1.0) * fast, velocity = random.vector(unit * random.uniform(0.0, 2.0)) * fast;
    const double loose = norm(velocity) + norm(turn) * extent;
    const double bound = outline.largest_speed(velocity, turn, loose);
    double largest = 0.0;
    for (const Vec3& x : points)
      largest = std::max(largest, norm(Vec3(velocity / fast + cross(Vec3(turn / fast), Vec3(x - centre)))) * fast);
    EXPECT_GE(bound, largest);
    // The ball of radius `size` around a point can be faster than the point by norm(turn) * size.
    EXPECT_GE(bound * (1.0 + 1e-12), std::min(loose, largest + norm(turn) * size));
    EXPECT_LE(bound, loose);
    if (size == 0.0 && count <= 256) {
      EXPECT_LE(bound, largest * (1.0 + 1e-5) + 1e-5 * loose);  // the points themselves, up to float rounding
      tight += bound < 0.8 * loose;
    }
  }
  EXPECT_GT(tight, 100);  // the outline is often much tighter than the loose bound
}

TEST(Outline, IsLeftOutForFewPoints) {
  EXPECT_TRUE(detail::Outline().is_empty());
  const std::vector<Vec3> three{Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(0, 1, 0)};
  EXPECT_TRUE(detail::Outline(three, Vec3::Zero(), 0.0, 1.0).is_empty());
}

}  // namespace outline_test
}  // namespace hinge
