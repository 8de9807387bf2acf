// SPDX-License-Identifier: BSD-3-Clause
// Particular cases of the stock primitives; laws/laws_test.cpp tests their laws.
#include <gtest/gtest.h>

#include <Eigen/Geometry>

#include <cmath>
#include <utility>

#include "engine/random_mechanism.hpp"
#include "hinge/detail/exact/error_free.hpp"
#include "hinge/primitive/capsule.hpp"
#include "hinge/primitive/point.hpp"
#include "hinge/primitive/sphere.hpp"
#include "hinge/primitive/triangle.hpp"

namespace hinge {
namespace primitive_test {

using test::Random;

TEST(Point, DecidesStrictlyAtAnyScale) {
  for (const double scale : {1e-300, 1e-160, 1e-30, 1.0, 1e30, 1e155, 1e300}) {
    const Point p{Vec3::Zero()}, q{Vec3(3 * scale, 4 * scale, 0)};
    EXPECT_TRUE(closer_than(p, q, 5.1 * scale)) << scale;
    EXPECT_FALSE(closer_than(p, q, 4.9 * scale)) << scale;
  }
  const Point p{Vec3(1, 2, 3)};
  EXPECT_FALSE(closer_than(p, p, 0.0));
  EXPECT_TRUE(closer_than(p, p, 1e-300));
  EXPECT_FALSE(closer_than(Point{Vec3::Zero()}, Point{Vec3(1e300, 0, 0)}, 2.0));
}

TEST(Point, KnowsWhenItLiesOnAnAxis) {
  Random random(3);
  for (int k = 0; k < 1000; ++k) {
    const Vec3 a = random.vector(50.0), b = a + random.vector(1.0);
    const Vec3 axis = Vec3(b - a) / std::sqrt(squared_norm(Vec3(b - a)));
    EXPECT_TRUE(Point{b}.fixed_on_axis(a, axis));
    EXPECT_TRUE(Point{a}.fixed_on_axis(a, axis));
    EXPECT_FALSE(Point{Vec3(b + axis.unitOrthogonal() * 1e-9)}.fixed_on_axis(a, axis));
  }
  // At any size: squares of these lengths underflow to 0 or overflow to infinity.
  for (const double size : {0x1p-1060, 1e-300, 1e-170, 1e170, 1e300}) {
    EXPECT_TRUE(Point{Vec3(0, 0, size)}.fixed_on_axis(Vec3(0, 0, -size), Vec3::UnitZ())) << size;
    EXPECT_FALSE(Point{Vec3(size / 4, 0, size)}.fixed_on_axis(Vec3(0, 0, -size), Vec3::UnitZ())) << size;
  }
}

TEST(Sphere, TouchesWhenClosed) {
  const Sphere p{Vec3::Zero(), 1.0}, q{Vec3(3, 0, 0), 2.0};
  EXPECT_EQ(squared_distance(p, q), 0.0);
  EXPECT_TRUE(closer_than(p, q, 0.0));
  EXPECT_FALSE(closer_than(p, Sphere{Vec3(3.0000001, 0, 0), 2.0}, 0.0));
}

TEST(Sphere, HasBoundsThatHoldItAndNoMore) {
  Random random(4);
  for (int k = 0; k < 1000; ++k) {
    const double size = std::pow(10.0, random.uniform(-8.0, 8.0));
    const Sphere sphere{random.vector(1.0), random.uniform(0.0, size)};
    const Aabb box = sphere.bounds();
    for (int axis = 0; axis < 3; ++axis) {
      // The error of a bound is less than the spacing of doubles there.
      const detail::exact::ValueAndError low = detail::exact::two_difference(sphere.center[axis], sphere.radius);
      const detail::exact::ValueAndError high = detail::exact::two_sum(sphere.center[axis], sphere.radius);
      EXPECT_TRUE(box.lower[axis] < low.value || (box.lower[axis] == low.value && low.rest >= 0.0));
      EXPECT_TRUE(box.upper[axis] > high.value || (box.upper[axis] == high.value && high.rest <= 0.0));
      EXPECT_GE(box.lower[axis], std::nextafter(low.value, -1e300));
      EXPECT_LE(box.upper[axis], std::nextafter(high.value, 1e300));
    }
  }
  const Aabb whole = Sphere{Vec3(1, 2, 3), 0.5}.bounds();
  EXPECT_EQ(whole.lower, Vec3(0.5, 1.5, 2.5));
  EXPECT_EQ(whole.upper, Vec3(1.5, 2.5, 3.5));
}

TEST(Sphere, TouchesOneAnotherOrNotByTheRealSumOfRadii) {
  // As real numbers, these doubles have a sum below the rounded sum 0.1 + 0.2 and above the double 0.3.
  EXPECT_FALSE(closer_than(Sphere{Vec3::Zero(), 0.1}, Sphere{Vec3(0.1 + 0.2, 0, 0), 0.2}, 0.0));
  EXPECT_GT(squared_distance(Sphere{Vec3::Zero(), 0.1}, Sphere{Vec3(0.1 + 0.2, 0, 0), 0.2}), 0.0);
  EXPECT_TRUE(closer_than(Sphere{Vec3::Zero(), 0.1}, Sphere{Vec3(0.3, 0, 0), 0.2}, 0.0));
  EXPECT_EQ(squared_distance(Sphere{Vec3::Zero(), 0.1}, Sphere{Vec3(0.3, 0, 0), 0.2}), 0.0);
}

TEST(Sphere, RefusesToBeWhatHasNoSize) {
  EXPECT_TRUE((Sphere{Vec3::Zero(), 0.0}.is_valid()));
  EXPECT_FALSE((Sphere{Vec3::Zero(), -1.0}.is_valid()));
  EXPECT_FALSE((Sphere{Vec3::Zero(), std::nan("")}.is_valid()));
  EXPECT_FALSE((Capsule{Vec3::Zero(), Vec3(0, std::nan(""), 0), 1.0}.is_valid()));
  EXPECT_FALSE((Capsule{Vec3::Zero(), Vec3::Zero(), -0.5}.is_valid()));
  EXPECT_TRUE((Capsule{Vec3::Zero(), Vec3::Zero(), 0.5}.is_valid()));
}

TEST(Solids, HaveClosestPointsAtAnyScale) {
  for (const double scale : {1e-300, 1e-160, 1.0, 1e160, 1e300}) {
    const Sphere p{Vec3::Zero(), scale}, q{Vec3(3 * scale, 4 * scale, 0), 2 * scale};
    const auto [x, y] = closest_points(p, q);
    EXPECT_NEAR(x[1] / scale, 0.8, 1e-15);
    EXPECT_NEAR(y[1] / scale, 2.4, 1e-15);
    const Capsule r{Vec3(-scale, 0, 0), Vec3(scale, 0, 0), scale},
        s{Vec3(0, 5 * scale, -scale), Vec3(0, 5 * scale, scale), scale};
    const auto [u, v] = closest_points(r, s);
    EXPECT_NEAR(u[1] / scale, 1.0, 1e-15);
    EXPECT_NEAR(v[1] / scale, 4.0, 1e-15);
    EXPECT_NEAR(v[0] / scale, 0.0, 1e-15);
  }
}

TEST(Capsule, HandlesParallelCrossingAndDegenerateSegments) {
  const Capsule x{Vec3(0, 0, 0), Vec3(10, 0, 0), 0.0};
  EXPECT_DOUBLE_EQ(squared_distance(x, Capsule{Vec3(2, 3, 0), Vec3(8, 3, 0), 0.0}), 9.0);
  EXPECT_DOUBLE_EQ(squared_distance(x, Capsule{Vec3(12, 0, 0), Vec3(20, 0, 0), 0.5}), 1.5 * 1.5);
  EXPECT_DOUBLE_EQ(squared_distance(x, Capsule{Vec3(5, -1, 2), Vec3(5, 1, 2), 0.0}), 4.0);
  EXPECT_DOUBLE_EQ(squared_distance(x, Capsule{Vec3(5, 4, 0), Vec3(5, 4, 0), 1.0}), 9.0);
}

TEST(Triangle, TouchesAtVertexEdgeAndFace) {
  const Triangle t{Vec3(0, 0, 0), Vec3(4, 0, 0), Vec3(0, 4, 0)};
  EXPECT_TRUE(closer_than(t, Triangle{Vec3(1, 1, 0), Vec3(1, 1, 2), Vec3(2, 1, 2)}, 0.0)) << "vertex on face";
  EXPECT_TRUE(closer_than(t, Triangle{Vec3(0, 0, 0), Vec3(-1, 0, 1), Vec3(-1, -1, 1)}, 0.0)) << "shared vertex";
  EXPECT_TRUE(closer_than(t, Triangle{Vec3(0, 0, 0), Vec3(4, 0, 0), Vec3(0, -4, 1)}, 0.0)) << "shared edge";
  EXPECT_TRUE(closer_than(t, Triangle{Vec3(1, 1, -1), Vec3(1, 1, 1), Vec3(9, 9, 0)}, 0.0)) << "edge through face";
  EXPECT_TRUE(closer_than(t, Triangle{Vec3(0.5, 0.5, 0), Vec3(1, 0.5, 0), Vec3(0.5, 1, 0)}, 0.0)) << "coplanar, inside";
  EXPECT_FALSE(closer_than(t, Triangle{Vec3(0, 0, 1e-9), Vec3(4, 0, 1e-9), Vec3(0, 4, 1e-9)}, 0.0));
}

TEST(Triangle, TakesDegenerateOnesForWhatTheySpan) {
  const Triangle point{Vec3(1, 1, 5), Vec3(1, 1, 5), Vec3(1, 1, 5)},
      segment{Vec3(1, 1, 2), Vec3(1, 1, 9), Vec3(1, 1, 4)};
  const Triangle t{Vec3(0, 0, 0), Vec3(4, 0, 0), Vec3(0, 4, 0)};
  EXPECT_DOUBLE_EQ(squared_distance(t, point), 25.0);
  EXPECT_DOUBLE_EQ(squared_distance(t, segment), 4.0);
  EXPECT_DOUBLE_EQ(squared_distance(point, segment), 0.0);
}

/// Distance by alternating projection onto both triangles from sampled starts: a slow upper bound that converges.
double projected_distance(const Triangle& p, const Triangle& q) {
  const auto nearest_in = [](const Triangle& t, const Vec3& x) {
    // Dense barycentric search with refinement, independent of the formula under test.
    double u0 = 0.0, v0 = 0.0, step = 0.5;
    Vec3 best = t.a;
    double least = (x - best).squaredNorm();
    for (int level = 0; level < 60; ++level, step *= 0.7)
      for (int i = -2; i <= 2; ++i)
        for (int j = -2; j <= 2; ++j) {
          const double u = u0 + i * step / 2, v = v0 + j * step / 2;
          if (u < 0 || v < 0 || u + v > 1) continue;
          const Vec3 y = t.a + u * (t.b - t.a) + v * (t.c - t.a);
          if ((x - y).squaredNorm() < least) {
            least = (x - y).squaredNorm();
            best = y;
            u0 = u;
            v0 = v;
          }
        }
    return best;
  };
  Vec3 x = (p.a + p.b + p.c) / 3, y;
  for (int k = 0; k < 40; ++k) {
    y = nearest_in(q, x);
    x = nearest_in(p, y);
  }
  return (x - y).norm();
}

TEST(Triangle, DistanceIsNeverAboveAnIndependentSearch) {
  Random random(12);
  int close = 0;
  for (int k = 0; k < 60; ++k) {
    const auto triangle = [&] { return Triangle{random.vector(2.0), random.vector(2.0), random.vector(2.0)}; };
    const Triangle p = triangle(), q = triangle();
    const double d = std::sqrt(squared_distance(p, q)), searched = projected_distance(p, q);
    EXPECT_LE(d, searched + 1e-9);
    close += std::abs(d - searched) < 0.05 ? 1 : 0;
  }
  EXPECT_GE(close, 50) << "the search converges for most";
}

}  // namespace primitive_test
}  // namespace hinge
