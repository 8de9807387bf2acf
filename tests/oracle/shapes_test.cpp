// SPDX-License-Identifier: BSD-3-Clause
// Compares distances of well separated spheres, capsules and boxes with FCL's shapes (libccd).
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <utility>

#include "engine/random_mechanism.hpp"
#include "hinge/primitive/capsule.hpp"
#include "hinge/primitive/sphere.hpp"
#include "hinge/primitive/triangle.hpp"
#include "hinge/robotics/shape.hpp"
#include "hinge/robotics/tessellate.hpp"
#include "oracle/fcl_robots.hpp"
#include "oracle/placement.hpp"

namespace hinge {
namespace shapes_test {

constexpr std::uint64_t seed = 2005;

/// Returns two poses; the second is `apart` (m) from the first in a random direction.
std::pair<Pose, Pose> poses_apart(test::Random& random, double apart) {
  std::pair<Pose, Pose> poses(random.pose(1.0), random.pose(1.0));
  poses.second.translation = poses.first.translation + Vec3(random.vector(1.0).normalized() * apart);
  return poses;
}

constexpr int shape_pairs = 1000;

TEST(FclShapes, SpheresAreAsFarApart) {
  test::Random random(seed);
  for (int k = 0; k < shape_pairs; ++k) {
    SCOPED_TRACE(k);
    const double r = random.uniform(0.01, 1.0), s = random.uniform(0.01, 1.0);
    const auto [x, y] = poses_apart(random, r + s + random.uniform(0.01, 3.0));
    const Sphere a{Vec3::Zero(), r}, b{Vec3::Zero(), s};
    EXPECT_NEAR(
        std::sqrt(squared_distance(a.placed(x), b.placed(y))),
        oracle::distance(oracle::FclSphere{r}, oracle::placement(x), oracle::FclSphere{s}, oracle::placement(y)),
        1e-12);
  }
}

TEST(FclShapes, CapsulesAreAsFarApart) {
  test::Random random(seed);
  for (int k = 0; k < shape_pairs; ++k) {
    SCOPED_TRACE(k);
    const double r = random.uniform(0.01, 0.5), s = random.uniform(0.01, 0.5);
    const double l = random.uniform(0.1, 2.0), m = random.uniform(0.1, 2.0);
    const auto [x, y] = poses_apart(random, r + s + (l + m) / 2 + random.uniform(0.01, 3.0));
    const Capsule a{Vec3(0, 0, -l / 2), Vec3(0, 0, l / 2), r}, b{Vec3(0, 0, -m / 2), Vec3(0, 0, m / 2), s};
    EXPECT_NEAR(std::sqrt(squared_distance(a.placed(x), b.placed(y))),
                oracle::distance(oracle::FclCapsule{r, l}, oracle::placement(x), oracle::FclCapsule{s, m},
                                 oracle::placement(y)),
                1e-12);
  }
}

/// libccd stops its iteration at a tolerance, here a millionth of a metre.
TEST(FclShapes, BoxesAreAsFarApart) {
  test::Random random(seed);
  for (int k = 0; k < shape_pairs; ++k) {
    SCOPED_TRACE(k);
    const auto edge = [&] { return random.uniform(0.1, 1.0); };
    const Vec3 a(edge(), edge(), edge()), b(edge(), edge(), edge());
    const auto [x, y] = poses_apart(random, (a.norm() + b.norm()) / 2 + random.uniform(0.01, 3.0));
    double least = std::numeric_limits<double>::infinity();
    for (const Triangle& s : robotics::tessellate(robotics::BoxShape{a}).triangles)
      for (const Triangle& t : robotics::tessellate(robotics::BoxShape{b}).triangles)
        least = std::min(least, std::sqrt(squared_distance(s.placed(x), t.placed(y))));
    EXPECT_NEAR(least,
                oracle::distance(oracle::FclBox{{a[0], a[1], a[2]}}, oracle::placement(x),
                                 oracle::FclBox{{b[0], b[1], b[2]}}, oracle::placement(y)),
                1e-6);
  }
}

}  // namespace shapes_test
}  // namespace hinge
