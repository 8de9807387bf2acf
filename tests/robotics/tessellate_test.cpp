// SPDX-License-Identifier: BSD-3-Clause
// Tests tessellation of shapes: closed, circumscribed within the tolerance, flat shapes.
#include "hinge/robotics/tessellate.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <map>
#include <memory>
#include <tuple>
#include <utility>
#include <vector>

#include "hinge/core/error.hpp"
#include "hinge/primitive/triangle.hpp"

namespace hinge::robotics {
namespace tessellate_test {

constexpr Tessellation inscribed{Tessellation::Manner::inscribed, 1e-3};

/// Returns the triangles of a shape; expects a radius of 0.
std::vector<Triangle> triangles_of(const Shape& shape, const Tessellation& tessellation) {
  const Surface surface = tessellate(shape, tessellation);
  EXPECT_EQ(surface.radius, 0.0);
  return surface.triangles;
}

Tessellation within(double tolerance) { return {Tessellation::Manner::circumscribed, tolerance}; }

using Point = std::tuple<double, double, double>;
Point point(const Vec3& v) { return {v[0] + 0.0, v[1] + 0.0, v[2] + 0.0}; }

/// Expects every edge in exactly two triangles, in opposite directions: the surface is closed and consistently
/// oriented.
void expect_closed(const std::vector<Triangle>& triangles) {
  std::map<std::pair<Point, Point>, int> runs;
  for (const Triangle& t : triangles) {
    const std::array<Vec3, 4> corner = {t.a, t.b, t.c, t.a};
    for (std::size_t k = 0; k < 3; ++k) ++runs[{point(corner[k]), point(corner[k + 1])}];
  }
  for (const auto& [edge, count] : runs) {
    ASSERT_EQ(count, 1);
    ASSERT_TRUE(runs.contains({edge.second, edge.first}));
  }
}

/// Returns the signed volume: positive if normals point outward.
double volume(const std::vector<Triangle>& triangles) {
  double six = 0.0;
  for (const Triangle& t : triangles) six += dot(t.a, cross(t.b, t.c));
  return six / 6;
}

double distance_to_centre(const Triangle& triangle) {
  return std::sqrt(squared_distance(triangle, Triangle{Vec3::Zero(), Vec3::Zero(), Vec3::Zero()}));
}

double nearest_to_centre(const std::vector<Triangle>& triangles) {
  double distance = 1e300;
  for (const Triangle& t : triangles) distance = std::min(distance, distance_to_centre(t));
  return distance;
}

template <class Size>
double largest(const std::vector<Triangle>& triangles, const Size& size) {
  double most = 0.0;
  for (const Triangle& t : triangles) most = std::max({most, size(t.a), size(t.b), size(t.c)});
  return most;
}

TEST(Tessellate, MakesABoxOfTwelveTriangles) {
  for (const Tessellation& manner : {inscribed, Tessellation{}}) {
    const auto triangles = triangles_of(BoxShape{{1, 2, 4}}, manner);
    EXPECT_EQ(triangles.size(), 12U);
    expect_closed(triangles);
    EXPECT_DOUBLE_EQ(volume(triangles), 8.0);
    EXPECT_EQ(largest(triangles, [](const Vec3& v) { return std::abs(v[2]); }), 2.0);
  }
}

TEST(Tessellate, HoldsTheSphereAndStaysWithinTheTolerance) {
  for (const double radius : {0.02, 0.3, 5.0})
    for (const double tolerance : {1.0, 1e-2, 1e-3}) {
      const auto triangles = triangles_of(SphereShape{radius}, within(tolerance));
      expect_closed(triangles);
      EXPECT_GE(nearest_to_centre(triangles), radius * (1 - 1e-14));
      EXPECT_LE(largest(triangles, [](const Vec3& v) { return v.norm(); }), radius + tolerance + radius * 1e-14);
      EXPECT_GT(volume(triangles), 0.0);
    }
}

TEST(Tessellate, HoldsTheCylinderAndStaysWithinTheTolerance) {
  for (const double radius : {0.02, 0.3, 5.0})
    for (const double tolerance : {1.0, 1e-2, 1e-3}) {
      const auto triangles = triangles_of(CylinderShape{radius, 3.0}, within(tolerance));
      const auto from_axis = [](const Vec3& v) { return std::hypot(v[0], v[1]); };
      expect_closed(triangles);
      EXPECT_LE(largest(triangles, from_axis), radius + tolerance + radius * 1e-14);
      EXPECT_EQ(largest(triangles, [](const Vec3& v) { return std::abs(v[2]); }), 1.5);
      // Side faces only: an upright rectangle is nearest to the axis where its projection onto the x-y plane is.
      for (const Triangle& t : triangles) {
        if (t.a[2] == t.b[2] && t.b[2] == t.c[2]) continue;
        Triangle flat = t;
        for (Vec3* v : {&flat.a, &flat.b, &flat.c}) (*v)[2] = 0.0;
        EXPECT_GE(distance_to_centre(flat), radius * (1 - 1e-14));
      }
      EXPECT_GT(volume(triangles), 0.0);
    }
}

TEST(Tessellate, TakesMoreTrianglesForLessErrorAndNoMoreThanNeeded) {
  EXPECT_EQ(triangles_of(SphereShape{0.1}, within(10.0)).size(), 20U);
  EXPECT_EQ(triangles_of(CylinderShape{0.1, 1.0}, within(10.0)).size(), 12U);
  const auto coarse = triangles_of(SphereShape{0.1}, within(1e-3)), fine = triangles_of(SphereShape{0.1}, within(1e-4));
  EXPECT_GT(fine.size(), coarse.size());
  EXPECT_LT(coarse.size(), 1000U);
}

/// The reference data was tessellated in this manner.
TEST(Tessellate, InscribesAsTheReferenceDoes) {
  const auto sphere = triangles_of(SphereShape{2.0}, inscribed);
  EXPECT_EQ(sphere.size(), 320U);
  expect_closed(sphere);
  for (const Triangle& t : sphere) EXPECT_NEAR(t.a.norm(), 2.0, 1e-15);
  EXPECT_GT(volume(sphere), 0.0);
  const auto cylinder = triangles_of(CylinderShape{2.0, 1.0}, inscribed);
  EXPECT_EQ(cylinder.size(), 128U);
  expect_closed(cylinder);
  EXPECT_EQ(cylinder[0].a, Vec3(2, 0, -0.5));
  EXPECT_EQ(cylinder[1].c, Vec3(2, 0, 0.5));
  EXPECT_NEAR(cylinder[0].b[0], 2 * std::cos(std::acos(-1.0) / 16), 1e-15);
}

TEST(Tessellate, ScalesMeshesMirroringThemWhereTold) {
  auto mesh = std::make_shared<TriangleMesh>();
  mesh->triangles = {{Vec3(1, 2, 3), Vec3(0, 1, 0), Vec3(0, 0, 1)}};
  EXPECT_EQ(triangles_of(MeshShape{mesh, {1, -2, 0.5}}, {}).at(0).a, Vec3(1, -4, 1.5));
}

TEST(Tessellate, KeepsSpheresAndCapsulesExact) {
  const Surface sphere = tessellate(SphereShape{0.25});
  ASSERT_EQ(sphere.triangles.size(), 1U);
  EXPECT_EQ(sphere.radius, 0.25);
  EXPECT_EQ(sphere.triangles[0].a, Vec3::Zero());
  EXPECT_EQ(sphere.triangles[0].b, Vec3::Zero());
  EXPECT_EQ(sphere.triangles[0].c, Vec3::Zero());
  const Surface capsule = tessellate(CapsuleShape{0.25, 3.0});
  ASSERT_EQ(capsule.triangles.size(), 1U);
  EXPECT_EQ(capsule.radius, 0.25);
  EXPECT_EQ(capsule.triangles[0].a, Vec3(0, 0, -1.5));
  EXPECT_EQ(capsule.triangles[0].b, Vec3(0, 0, 1.5));
  EXPECT_EQ(capsule.triangles[0].c, Vec3(0, 0, 1.5));
  EXPECT_EQ(tessellate(CylinderShape{0.25, 3.0}).radius, 0.0);
}

TEST(Tessellate, HoldsTheCapsuleAndStaysWithinTheTolerance) {
  const auto from_axis = [](const Vec3& v) { return (v - Vec3(0, 0, std::clamp(v[2], -1.5, 1.5))).norm(); };
  const Triangle axis{Vec3(0, 0, -1.5), Vec3(0, 0, 1.5), Vec3(0, 0, 1.5)};
  for (const double radius : {0.02, 0.3, 5.0})
    for (const double tolerance : {1.0, 1e-2, 1e-3}) {
      const auto triangles = triangles_of(CapsuleShape{radius, 3.0}, within(tolerance));
      expect_closed(triangles);
      EXPECT_LE(largest(triangles, from_axis), radius + tolerance + radius * 1e-14);
      for (const Triangle& t : triangles)
        ASSERT_GE(std::sqrt(squared_distance(t, axis)), radius * (1 - 1e-13)) << radius << " " << tolerance;
      EXPECT_GT(volume(triangles), 3.14 * radius * radius * (3.0 + radius * 4 / 3));
    }
  const auto rough = triangles_of(CapsuleShape{0.3, 3.0}, inscribed);
  expect_closed(rough);
  EXPECT_LE(largest(rough, from_axis), 0.3 * (1 + 1e-14));
}

// No duplicate triangles; only points and segments have triangles without area.
TEST(Tessellate, MakesFlatShapesOfTheFewestTriangles) {
  const auto count = [](const Shape& shape) { return triangles_of(shape, {}).size(); };
  const auto area = [](const Shape& shape) {
    double twice = 0.0;
    for (const Triangle& t : triangles_of(shape, inscribed)) twice += cross(Vec3(t.b - t.a), Vec3(t.c - t.a)).norm();
    return twice / 2;
  };
  for (const Shape& line : {Shape(SphereShape{0}), Shape(BoxShape{{0, 0, 0}}), Shape(BoxShape{{0, 2, 0}}),
                            Shape(CylinderShape{0, 2}), Shape(CylinderShape{0, 0}), Shape(CapsuleShape{0, 2})}) {
    EXPECT_EQ(count(line), 1U);
    EXPECT_EQ(area(line), 0.0);
  }
  const Aabb line = triangles_of(CylinderShape{0, 2}, {})[0].bounds();
  EXPECT_EQ(line.lower, Vec3(0, 0, -1));
  EXPECT_EQ(line.upper, Vec3(0, 0, 1));
  for (const Vec3& size : {Vec3(0, 2, 3), Vec3(2, 0, 3), Vec3(3, 2, 0)}) {
    EXPECT_EQ(count(BoxShape{size}), 2U);
    EXPECT_DOUBLE_EQ(area(BoxShape{size}), 6.0);
  }
  EXPECT_EQ(triangles_of(CylinderShape{1, 0}, inscribed).size(), 32U);
  EXPECT_NEAR(area(CylinderShape{1, 0}), 3.14159, 0.03);
  EXPECT_EQ(triangles_of(CapsuleShape{1, 0}, inscribed).size(), 320U);
}

TEST(Tessellate, RefusesShapesAndTolerancesThatAreNone) {
  EXPECT_THROW(tessellate(BoxShape{{1, -1, 1}}), ModelError);
  EXPECT_THROW(tessellate(SphereShape{-1.0}), ModelError);
  EXPECT_THROW(tessellate(CylinderShape{1.0, std::nan("")}), ModelError);
  EXPECT_THROW(tessellate(CapsuleShape{1.0, -1.0}), ModelError);
  EXPECT_THROW(tessellate(CapsuleShape{-1.0, 1.0}), ModelError);
  EXPECT_THROW(tessellate(MeshShape{}), ModelError);
  for (const double tolerance : {0.0, -1.0, std::nan(""), 1e-300})
    EXPECT_THROW(tessellate(SphereShape{1.0}, within(tolerance)), ModelError) << tolerance;
}

}  // namespace tessellate_test
}  // namespace hinge::robotics
