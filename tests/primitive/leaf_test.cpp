// SPDX-License-Identifier: BSD-3-Clause
// Pairs that tree leaves prove apart in float must be apart as placed primitives, however close they are.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>

#include "engine/random_mechanism.hpp"
#include "hinge/detail/engine/simd/tree/relative_transform.hpp"
#include "hinge/detail/primitive/triangle_leaf.hpp"
#include "hinge/detail/primitive/triangle_pairs.hpp"
#include "hinge/primitive/triangle.hpp"

namespace hinge {
namespace leaf_test {

using test::Random;

/// Two frames with sixteen triangles each. Triangles of equal lane nearly touch.
struct Scene {
  Pose a, b;
  std::array<Triangle, detail::simd::width> mine, theirs;
};

Vec3 point_of(const Triangle& t, Random& random) {
  const double u = random.uniform(0.0, 1.0), v = random.uniform(0.0, 1.0 - u);
  return t.a + (t.b - t.a) * u + (t.c - t.a) * v;
}

/// A gap between nearly touching primitives: 0, a few ulps, or more; negative for an overlap.
double gap(Random& random, double size) {
  return random.one_in(4) ? 0.0 : random.uniform(-1.0, 1.0) * size * std::pow(10.0, random.uniform(-17.0, -1.0));
}

Scene touching_triangles(Random& random, double size) {
  Scene scene{random.pose(size), random.pose(size), {}, {}};
  const Pose back = scene.b.inverse();
  for (std::size_t k = 0; k < detail::simd::width; ++k) {
    const double edge = size * std::pow(10.0, random.uniform(-3.0, 0.0));
    const Vec3 at = random.vector(size);
    Triangle p{at, at + random.vector(edge), at + random.vector(edge)};
    if (random.one_in(8)) p.c = random.one_in(2) ? p.b : Vec3((p.a + p.b) * 0.5);
    const Vec3 normal = cross(Vec3(p.b - p.a), Vec3(p.c - p.a)), side = random.vector(1.0).normalized();
    const Vec3 away = squared_norm(normal) > 0.0 ? Vec3(normal.normalized()) : side;
    Vec3 contact = random.one_in(3) ? p.b : random.one_in(2) ? Vec3((p.a + p.b) * 0.5) : point_of(p, random);
    contact = scene.a * Vec3(contact + away * gap(random, size));
    // A corner at the contact point, or an inner point of an edge.
    const Vec3 along = random.vector(edge);
    Triangle q{contact, contact + away * edge + random.vector(edge), contact + away * edge + random.vector(edge)};
    if (random.one_in(2)) q = {contact + along, contact - along, contact + away * edge + random.vector(edge)};
    scene.mine[k] = p;
    scene.theirs[k] = q.placed(back);
  }
  return scene;
}

struct Packed {
  Packed(const std::array<Triangle, detail::simd::width>& primitives) {
    for (std::size_t k = 0; k < detail::simd::width; ++k) {
      detail::TriangleLeaf::set(floats.data(), k, primitives[k], Vec3::Zero(), 1.0);
      const Aabb box = primitives[k].bounds();
      for (int axis = 0; axis < 3; ++axis)
        extent = std::max(
            {extent, detail::float_above(std::abs(box.lower[axis])), detail::float_above(std::abs(box.upper[axis]))});
    }
  }
  alignas(64) std::array<float, detail::TriangleLeaf::floats> floats{};
  float extent = 0.0F;
};

detail::RelativeTransform relative(const Scene& scene, const Packed& mine, const Packed& theirs) {
  return {detail::TreeFrame(Frame(scene.a), Vec3::Zero()), 1.0, mine.extent,
          detail::TreeFrame(Frame(scene.b), Vec3::Zero()), 1.0, theirs.extent};
}

detail::TriangleLeaf::Turned turned(const Packed& theirs, const detail::RelativeTransform& turn) {
  return {theirs.floats.data(), {turn.b_to_a.rotation, turn.b_to_a.size, turn.b_to_a.translation}};
}

/// Expects that every pair within the margin is kept. Returns the share of the other pairs that is also kept.
double check(const Scene& scene, double margin) {
  const Packed mine(scene.mine), theirs(scene.theirs);
  const detail::RelativeTransform turn = relative(scene, mine, theirs);
  const auto there = turned(theirs, turn);
  const detail::Nearness near{detail::float_above(margin), turn.b_to_a.point_error, nullptr, nullptr};
  std::size_t left = 0, apart = 0;
  for (std::size_t k = 0; k < detail::simd::width; ++k) {
    const detail::simd::Bits lanes = there.near(k, mine.floats.data(), detail::simd::all_bits, near);
    for (std::size_t i = 0; i < detail::simd::width; ++i) {
      const bool close = closer_than(scene.mine[i].placed(scene.a), scene.theirs[k].placed(scene.b), margin);
      const bool kept = (lanes >> i & 1U) != 0;
      EXPECT_TRUE(kept || !close) << "lanes " << i << ", " << k;
      apart += close ? 0U : 1U;
      left += kept && !close ? 1U : 0U;
    }
  }
  return static_cast<double>(left) / static_cast<double>(apart + 1);
}

TEST(TriangleLeaf, KeepsEveryPairWithinTheMargin) {
  double left = 0.0;
  constexpr int scenes = 2000;
  for (std::uint64_t seed = 0; seed < scenes; ++seed) {
    SCOPED_TRACE(seed);
    Random random(seed);
    const double size = std::pow(10.0, random.uniform(-2.0, 2.0));
    left += check(touching_triangles(random, size), random.one_in(2) ? 0.0 : gap(random, size) + size / 10) / scenes;
    if (HasFailure()) return;
  }
  // The leaf must prove most pairs apart to be useful. The touching pairs are one in sixteen.
  EXPECT_LT(left, 0.1);
}

TEST(TriangleLeaf, BoundsDistancesFromBothSides) {
  for (std::uint64_t seed = 0; seed < 2000; ++seed) {
    SCOPED_TRACE(seed);
    Random random(seed);
    const double size = std::pow(10.0, random.uniform(-2.0, 2.0));
    const Scene scene = touching_triangles(random, size);
    const Packed mine(scene.mine), theirs(scene.theirs);
    const detail::RelativeTransform turn = relative(scene, mine, theirs);
    const auto there = turned(theirs, turn);
    detail::TrianglePairs queue;
    const std::size_t shift = random.below(detail::simd::width);
    const auto other = [&](std::size_t k) { return (k + shift) % detail::simd::width; };
    for (std::size_t k = 0; k < detail::simd::width; ++k)
      queue.set(k, mine.floats.data(), k, there, other(k), turn.b_to_a.point_error);
    detail::Bounds16 bounds;
    queue.bound(bounds);
    for (std::size_t k = 0; k < detail::simd::width; ++k) {
      const double d =
          std::sqrt(squared_distance(scene.mine[k].placed(scene.a), scene.theirs[other(k)].placed(scene.b)));
      EXPECT_LE(static_cast<double>(bounds.lower[k]), d);
      EXPECT_GE(static_cast<double>(bounds.upper[k]), d);
    }
    if (HasFailure()) return;
  }
}

}  // namespace leaf_test
}  // namespace hinge
