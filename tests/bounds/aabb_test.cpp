// SPDX-License-Identifier: BSD-3-Clause
// Aabb: outward rounding, extension, inflation, separation and overlap.
#include "hinge/bounds/aabb.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "engine/random_mechanism.hpp"
#include "hinge/primitive/point.hpp"

namespace hinge {
namespace aabb_test {

using test::Random;

TEST(Round, GivesTheNeighbouringDoubles) {
  for (const double x : {0.0, -0.0, 1.0, -1.0, 0x1p-1074, -0x1p-1074, 0x1p-1022, 1e300, -1e300, 3.7}) {
    EXPECT_EQ(detail::next_up(x), std::nextafter(x, std::numeric_limits<double>::infinity()));
    EXPECT_EQ(detail::next_down(x), std::nextafter(x, -std::numeric_limits<double>::infinity()));
  }
}

TEST(Aabb, StartsEmptyAndHoldsWhatItIsExtendedBy) {
  Aabb box;
  EXPECT_TRUE(box.is_empty());
  box.extend(Vec3(1, 2, 3)).extend(Vec3(-1, 5, 3));
  EXPECT_FALSE(box.is_empty());
  EXPECT_TRUE(box.contains(Aabb(Vec3(0, 3, 3))));
  EXPECT_FALSE(box.contains(Aabb(Vec3(0, 3, 3.1))));
  EXPECT_EQ(box.middle(1), 3.5);
}

TEST(Aabb, MiddleDoesNotOverflow) {
  const Aabb box(Vec3(1e308, 0, 0), Vec3(1.5e308, 1, 1));
  EXPECT_EQ(box.middle(0), 1.25e308);
}

TEST(Aabb, InflationOnlyGrows) {
  Random random(2);
  for (int k = 0; k < 10000; ++k) {
    const double size = std::ldexp(1.0, static_cast<int>(random.below(200)) - 100);
    const Aabb box(Vec3(random.vector(size)));
    const double r = random.uniform(0.0, size);
    const Aabb grown = box.inflated(r);
    for (int axis = 0; axis < 3; ++axis) {
      EXPECT_LT(grown.lower[axis], box.lower[axis] - r);
      EXPECT_GT(grown.upper[axis], box.upper[axis] + r);
    }
  }
}

TEST(Separation, IsALowerBoundOfDistanceMinusReaches) {
  Random random(4);
  int negative = 0;
  for (int k = 0; k < 20000; ++k) {
    const Vec3 p = random.vector(3.0), q = random.vector(3.0);
    const double r = random.uniform(0.0, 2.0), s = random.uniform(0.0, 2.0);
    const double bound = separation(Aabb(p).inflated(r), Aabb(q).inflated(s));
    EXPECT_LE(bound, std::sqrt(squared_norm(Vec3(p - q))) - r - s);
    negative += bound < 0.0 ? 1 : 0;
  }
  EXPECT_GT(negative, 1000);
}

// Boxes of points are not inflated. The distance of points is accurate to a few ulps at any size.
TEST(Separation, IsALowerBoundAtAnySize) {
  Random random(5);
  for (int exponent = -1070; exponent <= 960; ++exponent)
    for (int k = 0; k < 10; ++k) {
      const double size = std::ldexp(1.0, exponent);
      const Vec3 p = random.vector(size), q = random.vector(size);
      EXPECT_LE(separation(Aabb(p), Aabb(q)), distance(Point{p}, Point{q})) << "size 2^" << exponent;
    }
}

TEST(Separation, IsAtMostZeroExactlyWhenBoxesOverlap) {
  Random random(6);
  for (int k = 0; k < 20000; ++k) {
    const Aabb a = Aabb(random.vector(3.0)).extend(random.vector(3.0)),
               b = Aabb(random.vector(3.0)).extend(random.vector(3.0));
    EXPECT_EQ(separation(a, b) <= 0.0, overlap(a, b));
    EXPECT_EQ(separation(a, b), separation(b, a));
  }
  EXPECT_TRUE(overlap(Aabb(Vec3(0, 0, 0), Vec3(1, 1, 1)), Aabb(Vec3(1, 1, 1), Vec3(2, 2, 2)))) << "boxes are closed";
}

}  // namespace aabb_test
}  // namespace hinge
