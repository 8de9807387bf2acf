// SPDX-License-Identifier: BSD-3-Clause
// Tests which meshes are closed, their components, and whether a point is inside, outside or on a surface.
#include "hinge/robotics/containment.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <utility>
#include <vector>

#include "robotics/random_robot.hpp"

namespace hinge::robotics {
namespace containment_test {

constexpr std::uint64_t seed = 4096;
using Mesh = std::vector<Triangle>;

/// A box with faces of n x n cells of two triangles, normals outward. Corners are multiples of size / n.
Mesh box(const Vec3& low, double size, int n) {
  Mesh mesh;
  const double step = size / n;
  for (int axis = 0; axis < 3; ++axis)
    for (const int side : {0, n})
      for (int u = 0; u < n; ++u)
        for (int v = 0; v < n; ++v) {
          const auto corner = [&](int du, int dv) {
            Vec3 x;
            x[axis] = side;
            x[(axis + 1) % 3] = u + du;
            x[(axis + 2) % 3] = v + dv;
            return Vec3(low + step * x);
          };
          Triangle s{corner(0, 0), corner(1, 0), corner(1, 1)}, t{corner(0, 0), corner(1, 1), corner(0, 1)};
          if (side == 0) {
            std::swap(s.b, s.c);
            std::swap(t.b, t.c);
          }
          mesh.insert(mesh.end(), {s, t});
        }
  return mesh;
}

Mesh turned(Mesh mesh) {
  for (Triangle& t : mesh) std::swap(t.b, t.c);
  return mesh;
}

Mesh operator+(Mesh a, const Mesh& b) {
  a.insert(a.end(), b.begin(), b.end());
  return a;
}

TEST(OpenEdge, IsNoneForABoxHoweverItIsTurned) {
  EXPECT_TRUE(closed(box({0, 0, 0}, 1.0, 3)));
  EXPECT_TRUE(closed(turned(box({0, 0, 0}, 1.0, 3))));
  EXPECT_TRUE(closed(box({0, 0, 0}, 1.0, 1) + box({5, 0, 0}, 1.0, 2)));
  EXPECT_TRUE(closed(Mesh{}));
  // A triangle of zero area has each of its edges in both directions.
  EXPECT_TRUE(closed(box({0, 0, 0}, 1.0, 1) + Mesh{{{9, 9, 9}, {8, 8, 8}, {9, 9, 9}}}));
}

TEST(OpenEdge, NamesWhatAMissingTriangleLeaves) {
  const Mesh whole = box({0, 0, 0}, 1.0, 2);
  for (std::size_t gone = 0; gone < whole.size(); ++gone) {
    Mesh mesh = whole;
    mesh.erase(mesh.begin() + static_cast<std::ptrdiff_t>(gone));
    const auto open = open_edge(mesh);
    ASSERT_TRUE(open.has_value());
    const Triangle& t = mesh[open->triangle];
    const std::array<Vec3, 3> corners{t.a, t.b, t.c};
    const auto from = std::find(corners.begin(), corners.end(), open->from);
    ASSERT_NE(from, corners.end());
    EXPECT_EQ(corners[static_cast<std::size_t>(from - corners.begin() + 1) % 3], open->to);
    // The missing triangle has this edge in the opposite direction.
    const std::array<Vec3, 4> lost{whole[gone].a, whole[gone].b, whole[gone].c, whole[gone].a};
    const std::array<Vec3, 2> back{open->to, open->from};
    EXPECT_NE(std::search(lost.begin(), lost.end(), back.begin(), back.end()), lost.end());
  }
}

TEST(OpenEdge, IsThereWhenOneTriangleIsTurnedRound) {
  Mesh mesh = box({0, 0, 0}, 1.0, 1);
  std::swap(mesh[5].b, mesh[5].c);
  EXPECT_FALSE(closed(mesh));
  EXPECT_EQ(open_edge(Mesh{{{0, 0, 0}, {1, 0, 0}, {0, 0.5, 0}}})->text(), "edge (0, 0, 0) - (1, 0, 0) of triangle 0");
}

TEST(OpenEdge, TakesZeroesOfEitherSignForOnePoint) {
  Mesh mesh = box({0, 0, 0}, 1.0, 1);
  for (Triangle& t : mesh)
    if (t.b[0] == 0.0) t.b[0] = -0.0;
  EXPECT_TRUE(closed(mesh));
}

TEST(Parts, HangTogetherByVertices) {
  const Mesh mesh =
      box({0, 0, 0}, 1.0, 2) + box({4, 0, 0}, 1.0, 1) + box({1, 1, 1}, 1.0, 1);  // the last box shares a corner
  EXPECT_EQ(parts(mesh), (std::vector<std::size_t>{0, 48}));
  EXPECT_TRUE(parts(Mesh{}).empty());
}

/// Rays from grid points pass through vertices and edges of the box.
TEST(PlaceOf, IsRightWhereRaysMeetVerticesAndEdges) {
  constexpr int n = 4;
  for (const Mesh& mesh : {box({0, 0, 0}, n, n), turned(box({0, 0, 0}, n, n))})
    for (int x = -2; x <= 2 * n + 2; ++x)
      for (int y = -2; y <= 2 * n + 2; ++y)
        for (int z = -2; z <= 2 * n + 2; ++z) {
          const auto [low, high] = std::minmax({x, y, z});
          const Place expected = low < 0 || high > 2 * n     ? Place::outside
                                 : low == 0 || high == 2 * n ? Place::on_surface
                                                             : Place::inside;
          EXPECT_EQ(place_of(Vec3(x / 2.0, y / 2.0, z / 2.0), mesh), expected) << x << " " << y << " " << z;
        }
}

/// The octahedron |x| + |y| + |z| <= 4; rays hit its apex and its equator.
TEST(PlaceOf, IsRightUnderTheApexOfAnOctahedron) {
  Mesh mesh;
  for (const double x : {-4.0, 4.0})
    for (const double y : {-4.0, 4.0})
      for (const double z : {-4.0, 4.0}) {
        Triangle t{{x, 0, 0}, {0, y, 0}, {0, 0, z}};
        if (x * y * z < 0) std::swap(t.b, t.c);
        mesh.push_back(t);
      }
  ASSERT_TRUE(closed(mesh));
  for (int x = -5; x <= 5; ++x)
    for (int y = -5; y <= 5; ++y)
      for (int z = -5; z <= 5; ++z) {
        const int sum = std::abs(x) + std::abs(y) + std::abs(z);
        EXPECT_EQ(place_of(Vec3(x, y, z), mesh), sum < 4    ? Place::inside
                                                 : sum == 4 ? Place::on_surface
                                                            : Place::outside)
            << x << " " << y << " " << z;
      }
}

TEST(PlaceOf, AgreesWithHalfSpacesForRandomTetrahedra) {
  SCOPED_TRACE(seed);
  std::size_t inside = 0;
  for (std::uint64_t number = 0; number < 400; ++number) {
    SampleStream stream(seed, number);
    // Coordinates are integers: long double decides the half-spaces exactly, and points on faces are frequent.
    const auto whole = [&] {
      const Vec3 x = test::random_point(stream, 6.0);
      return Vec3(std::floor(x[0]), std::floor(x[1]), std::floor(x[2]));
    };
    const std::array<Vec3, 4> v{whole(), whole(), whole(), whole()};
    const auto volume = [](const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d) {
      return dot(Vec3(b - a), cross(Vec3(c - a), Vec3(d - a)));
    };
    const double all = volume(v[0], v[1], v[2], v[3]);
    if (all == 0.0) continue;
    const Mesh mesh = {{v[0], v[2], v[1]}, {v[0], v[1], v[3]}, {v[1], v[2], v[3]}, {v[0], v[3], v[2]}};
    ASSERT_TRUE(closed(mesh));
    for (int k = 0; k < 100; ++k) {
      const Vec3 p = whole();
      double least = volume(p, v[1], v[2], v[3]) * all;
      least = std::min(least, volume(v[0], p, v[2], v[3]) * all);
      least = std::min(least, volume(v[0], v[1], p, v[3]) * all);
      least = std::min(least, volume(v[0], v[1], v[2], p) * all);
      EXPECT_EQ(place_of(p, mesh), least > 0 ? Place::inside : least == 0 ? Place::on_surface : Place::outside);
      inside += least > 0 ? 1U : 0U;
    }
  }
  EXPECT_GT(inside, 100U);
}

TEST(PlaceOf, HasNoTolerance) {
  const Mesh mesh = box({0, 0, 0}, 1.0, 1);
  for (int axis = 0; axis < 3; ++axis) {
    Vec3 p(0.5, 0.5, 0.5);
    p[axis] = 1.0;
    EXPECT_EQ(place_of(p, mesh), Place::on_surface);
    p[axis] = std::nextafter(1.0, 0.0);
    EXPECT_EQ(place_of(p, mesh), Place::inside);
    p[axis] = std::nextafter(1.0, 2.0);
    EXPECT_EQ(place_of(p, mesh), Place::outside);
  }
}

TEST(PlaceOf, CountsOverlapsAsUnionAndCavitiesAsOutside) {
  const Mesh overlapping = box({0, 0, 0}, 2.0, 1) + box({1, 0.5, 0.5}, 2.0, 1);
  EXPECT_EQ(place_of({1.5, 1, 1}, overlapping), Place::inside);
  EXPECT_EQ(place_of({0.5, 1, 1}, overlapping), Place::inside);
  EXPECT_EQ(place_of({-0.5, 1, 1}, overlapping), Place::outside);
  const Mesh hollow = box({0, 0, 0}, 3.0, 1) + turned(box({1, 1, 1}, 1.0, 1));
  EXPECT_EQ(place_of({1.5, 1.5, 1.5}, hollow), Place::outside);
  EXPECT_EQ(place_of({0.5, 1.5, 1.5}, hollow), Place::inside);
}

TEST(Contains, TellsWholeFromParts) {
  const Mesh outer = box({0, 0, 0}, 10.0, 2), small = box({4, 4, 4}, 1.0, 1), away = box({20, 0, 0}, 1.0, 1);
  EXPECT_EQ(contains(outer, small), Containment::whole);
  EXPECT_EQ(contains(outer, away), Containment::none);
  EXPECT_EQ(contains(outer, small + away), Containment::some_parts);
  EXPECT_EQ(contains(small, outer), Containment::none);
  EXPECT_EQ(contains(outer, Mesh{}), Containment::none);
}

}  // namespace containment_test
}  // namespace hinge::robotics
