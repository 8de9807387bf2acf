// SPDX-License-Identifier: BSD-3-Clause
// Tests extremes of triangles and meshes on all three engines, one test per row of the table of extremes.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <iostream>
#include <string>
#include <vector>

#include "extremes/stack_used.hpp"
#include "extremes/three_engines.hpp"
#include "hinge/primitive/triangle.hpp"

namespace hinge {
namespace meshes_test {

using test::AnyEngine;

/// Two meshes, each on its own prismatic joint.
std::vector<AnyEngine<Triangle>> engines(const std::vector<Triangle>& a, const std::vector<Triangle>& b) {
  ModelBuilder<Triangle> builder;
  for (const std::vector<Triangle>* mesh : {&a, &b}) builder.add_link(world, Prismatic{Vec3::UnitX(), {}, {}}, *mesh);
  return test::on_three_engines(builder.finish(), AdmitAll{}, UniformClearance(0.0));
}

/// expected: the exact distance of the stored triangles; 0 if they share a point.
void expect_distance(const Triangle& p, const Triangle& q, double expected, const std::string& what) {
  double span = 0.0;  // largest coordinate difference
  const Aabb box = Aabb(p.bounds()).extend(q.bounds());
  for (int k = 0; k < 3; ++k) span = std::max(span, box.length(k));
  for (AnyEngine<Triangle>& engine : engines({p}, {q})) {
    SCOPED_TRACE(engine.name + ", " + what);
    EXPECT_EQ(engine.collides({}), expected == 0.0);
    EXPECT_EQ(engine.within(0.0, {}).size(), expected == 0.0 ? 1U : 0U);
    const double distance = engine.closest({}).value().distance;
    EXPECT_EQ(distance == 0.0, expected == 0.0) << distance;
    // The bound: 16 ulp of the distance and 8 ulp of the largest coordinate difference.
    EXPECT_LE(std::abs(distance - expected), 16 * 0x1p-52 * expected + 8 * 0x1p-52 * span);
  }
}

/// A vertex of `above` is over the inside of a horizontal face: the distance is the difference of two stored heights.
void expect_vertex_over_face(const std::vector<Vec3>& face, const Vec3& foot, double size, double offset, double gap,
                             const std::string& what) {
  const auto corner = [&](const Vec3& x) { return Vec3(x * size + Vec3::Constant(offset)); };
  const Triangle level{corner(face[0]), corner(face[1]), corner(face[2])};
  const Vec3 tip = foot + Vec3(0, 0, gap);
  const Triangle above{corner(tip), corner(Vec3(tip + Vec3(0, 1, 3))), corner(Vec3(tip + Vec3(1, 0, 3)))};
  expect_distance(level, above, std::max(0.0, above.a[2] - level.a[2]),
                  what + ", gap " + std::to_string(gap) + ", size " + std::to_string(size));
}

TEST(Triangles, TouchingCrossingTinyFarAndMixedEqualTheExactAnswer) {
  const std::vector<Vec3> face = {{0, 0, 0}, {4, 0, 0}, {0, 4, 0}};
  const std::vector<Vec3> huge = {{-1e9, -1e9, 0}, {1e9, -1e9, 0}, {0, 1e9, 0}};
  const std::vector<Vec3> sliver = {{0, 0, 0}, {1e7, 0, 0}, {0, 1e-7, 0}};
  const std::vector<Vec3> segment = {{0, 0, 0}, {4, 0, 0}, {2, 0, 0}}, point(3, Vec3(1, 1, 0));
  for (const double gap : {0.0, 0x1p-20, 1.0, -1.0, -0x1p-20}) {
    for (const double size : {1.0, 1e-4, 1e-9, 0x1p300, 0x1p-300})
      expect_vertex_over_face(face, Vec3(1, 1, 0), size, 0.0, gap, "face");
    expect_vertex_over_face(face, Vec3(1, 1, 0), 1.0, 1e9, gap, "1e9 away");
    expect_vertex_over_face(huge, Vec3(1, 1, 0), 1.0, 0.0, gap, "mixed scale");
    expect_vertex_over_face(sliver, Vec3(1, 1e-8, 0), 1.0, 0.0, gap, "sliver");
    if (gap < 0.0) continue;  // a segment or a point is not crossed from below
    expect_vertex_over_face(segment, Vec3(1, 0, 0), 1.0, 0.0, gap, "zero area");
    expect_vertex_over_face(point, Vec3(1, 1, 0), 1.0, 0.0, gap, "a point");
  }
}

TEST(Triangles, InOnePlaneEqualTheExactAnswer) {
  const Triangle fixed{{0, 0, 0}, {4, 0, 0}, {0, 4, 0}};
  const auto shifted = [&](double x, double y) {
    return Triangle{fixed.a + Vec3(x, y, 0), fixed.b + Vec3(x, y, 0), fixed.c + Vec3(x, y, 0)};
  };
  expect_distance(fixed, fixed, 0.0, "equal");
  expect_distance(fixed, shifted(1, 1), 0.0, "overlapping");
  expect_distance(fixed, shifted(4, 0), 0.0, "at a corner");
  expect_distance(fixed, shifted(2, 2), 0.0, "a corner on an edge");
  expect_distance(fixed, shifted(4 + 0x1p-50, 0), 0x1p-50, "an ulp apart");
  expect_distance(fixed, shifted(0, -7), 3.0, "apart");
}

/// A closed, centred box with axis-parallel edges.
std::vector<Triangle> box(double half) {
  std::vector<Triangle> triangles;
  for (int axis = 0; axis < 3; ++axis)
    for (const double side : {-half, half}) {
      const auto corner = [&](double u, double v) {
        Vec3 x;
        x[axis] = side;
        x[(axis + 1) % 3] = u * half;
        x[(axis + 2) % 3] = v * half;
        return x;
      };
      triangles.push_back({corner(-1, -1), corner(1, -1), corner(1, 1)});
      triangles.push_back({corner(-1, -1), corner(1, 1), corner(-1, 1)});
    }
  return triangles;
}

TEST(Meshes, WithoutTrianglesHaveNoGeometry) {
  for (AnyEngine<Triangle>& engine : engines({}, box(1.0))) {
    SCOPED_TRACE(engine.name);
    EXPECT_FALSE(engine.collides({}));
    EXPECT_TRUE(engine.within(1e9, {}).empty());
    EXPECT_FALSE(engine.closest({}).has_value());
  }
}

TEST(Meshes, WithDuplicatedTrianglesReportEveryPair) {
  const Triangle a{{0, 0, 0}, {4, 0, 0}, {0, 4, 0}}, b{{1, 1, -1}, {1, 1, 1}, {2, 1, 1}};
  for (AnyEngine<Triangle>& engine : engines(std::vector<Triangle>(40, a), std::vector<Triangle>(3, b))) {
    const std::vector<Hit> hits = engine.within(0.0, {});
    ASSERT_EQ(hits.size(), 120U) << engine.name;
    for (std::size_t k = 0; k < hits.size(); ++k) {
      EXPECT_EQ(hits[k].first, id<PrimitiveId>(k / 3));
      EXPECT_EQ(hits[k].second, id<PrimitiveId>(40 + k % 3));
      EXPECT_EQ(hits[k].distance, 0.0);
    }
  }
}

TEST(Meshes, OfOneTriangleMeetNothingOfTheirOwn) {
  for (AnyEngine<Triangle>& engine : engines({box(1.0).front()}, {})) {
    EXPECT_FALSE(engine.collides({})) << engine.name;
    EXPECT_FALSE(engine.closest({}).has_value()) << engine.name;
  }
}

TEST(Meshes, NestedInOneAnotherAreApartAsSurfaces) {
  for (AnyEngine<Triangle>& engine : engines(box(10.0), box(1.0))) {
    EXPECT_FALSE(engine.collides({})) << engine.name;
    EXPECT_EQ(engine.closest({}).value().distance, 9.0) << engine.name;
  }
}

TEST(Meshes, OfCoincidentTrianglesHitOnABoundedStack) {
  const std::size_t n = test::exhaustive() ? 500000 : 50000;
  const Triangle triangle{{0, 0, 0}, {4, 0, 0}, {0, 4, 0}};
  for (std::size_t e = 1; e < 3; ++e) {
    QueryCounts counts;
    const std::size_t used = test::stack_used([&] {
      const std::vector<Triangle> mesh(n, triangle);
      AnyEngine<Triangle> engine = engines(mesh, mesh)[e];
      QueryOptions options;
      options.counts = &counts;
      EXPECT_TRUE(engine.collides(options)) << engine.name;
    });
    std::cout << 2 * n << " coincident triangles: " << used << " bytes of stack, " << counts.boxes_tested
              << " box tests, " << counts.pairs_tested << " pair tests\n";
    EXPECT_LT(counts.boxes_tested, 10000U);
    EXPECT_LT(counts.pairs_tested, 10000U);
    if (!test::stack_is_padded) {
      EXPECT_LT(used, test::stack_limit);
    }
  }
}

}  // namespace meshes_test
}  // namespace hinge
