// SPDX-License-Identifier: BSD-3-Clause
// Sizes outside the range of float: engine/simd must return the answers of brute force.
#include <gtest/gtest.h>

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "engine/random_mechanism.hpp"
#include "hinge/engine/brute.hpp"
#include "hinge/hierarchy.hpp"
#include "hinge/policy/pair_filter.hpp"

namespace hinge {
namespace extremes_test {

template <template <class, class, class> class EngineOf>
using PointsOn = Hierarchy<Point, AdmitAll, UniformClearance, EngineOf>;

/// Each point on its own slider along x.
Model<Point> sliders(const std::vector<Vec3>& points) {
  ModelBuilder<Point> builder;
  for (const Vec3& x : points) builder.add_link(world, Prismatic{{1, 0, 0}, {}, {}}, {Point{x}});
  return builder.finish();
}

/// Two interleaved rigid groups of twenty points each.
Model<Point> two_groups(double size) {
  ModelBuilder<Point> builder;
  for (int h = 0; h < 2; ++h) {
    std::vector<Point> points;
    for (int k = 0; k < 20; ++k)
      points.push_back({Vec3(k * size / 20, (k * 7 % 5) * size / 20 + h * size * 0.1, (k * 3 % 7) * size / 20)});
    builder.add_link(world, Prismatic{{1, 0, 0}, {}, {}}, points);
  }
  return builder.finish();
}

void expect_equal(PointsOn<Simd>& simd, PointsOn<Brute>& brute, double margin) {
  const std::vector<Hit> all = brute.self_collisions();
  EXPECT_EQ(simd.self_collides(), !all.empty());
  EXPECT_EQ(simd.self_collisions(), all);
  EXPECT_EQ(simd.self_within(margin), brute.self_within(margin));
  EXPECT_EQ(simd.self_closest().value().gap(), brute.self_closest().value().gap());
}

void expect_equal_on(const Model<Point>& model, double clearance, const std::vector<double>& q = {}) {
  PointsOn<Simd> simd(model, AdmitAll{}, UniformClearance(clearance));
  PointsOn<Brute> brute(model, AdmitAll{}, UniformClearance(clearance));
  if (!q.empty()) {
    simd.update(q);
    brute.update(q);
  }
  expect_equal(simd, brute, clearance);
}

TEST(SimdExtremes, HoldAtAnySizeOfTheModel) {
  for (const double size : {4e-322, 1e-310, 1e-300, 1e-160, 1e-30, 1.0, 1e30, 1e150}) {
    SCOPED_TRACE(size);
    expect_equal_on(sliders({{0, 0, 0}, {size, 0, 0}, {0, size * 3, 0}}), size * 2);
    expect_equal_on(two_groups(size), size * 0.1);
  }
}

TEST(SimdExtremes, HoldForAnyClearanceAndTravel) {
  const Model<Point> model = sliders({{0, 0, 0}, {1, 0, 0}, {0, 0.25, 0}});
  for (const double clearance : {0.0, 1e-200, 0.5, 1e20, 1e45}) expect_equal_on(model, clearance);
  for (const double travel : {1e-200, 1e20, 1e100})
    for (const auto& q : {std::vector<double>{travel, travel, travel}, {travel, 0, 0}, {travel, -travel, 0}})
      expect_equal_on(model, 0.5, q);
}

TEST(SimdExtremes, HoldForTwoModelsOfVeryDifferentSize) {
  const Model<Point> model = sliders({{0, 0, 0}, {1, 0, 0}, {0, 0.25, 0}});
  for (const double size : {1e-300, 1e-60, 1e-42, 1e-38, 1e-30, 1e-10, 1e10, 1e30, 1e60, 1e150}) {
    SCOPED_TRACE(size);
    const Model<Point> other = sliders({{0, 0, 0}, {size, 0, 0}});
    PointsOn<Simd> a(model, AdmitAll{}, UniformClearance(0.5)), b(other, AdmitAll{}, UniformClearance(0.5));
    PointsOn<Brute> c(model, AdmitAll{}, UniformClearance(0.5)), d(other, AdmitAll{}, UniformClearance(0.5));
    EXPECT_EQ(a.collisions(b), c.collisions(d));
    EXPECT_EQ(b.collisions(a), d.collisions(c));
    EXPECT_EQ(a.within(b, 0.5), c.within(d, 0.5));
    EXPECT_EQ(b.within(a, 0.5), d.within(c, 0.5));
    EXPECT_EQ(a.closest(b).value().gap(), c.closest(d).value().gap());
    EXPECT_EQ(b.closest(a).value().gap(), d.closest(c).value().gap());
  }
}

TEST(SimdExtremes, HoldForCoordinatesFarBeyondTheSizeOfTheModel) {
  test::Random random(11);
  const std::vector<double> places = {0.0, 1.0, 1e15, 1e16, 0x1p127, 0x1p128, 0x1p129, 0x1p200, 0x1p881, 0x1p990};
  const auto draw = [&] { return places[random.below(places.size())] * (random.below(2) == 0 ? 1.0 : -1.0); };
  const Model<Point> groups = two_groups(1.0), own = sliders(std::vector<Vec3>(40, Vec3::Zero()));
  const Model<Point> small = sliders({{0, 0, 0}, {0.25, 0, 0}, {0, 0.5, 0}});
  for (int round = 0; round < 300; ++round) {
    SCOPED_TRACE(round);
    const std::vector<Vec3> far = {Vec3(draw(), 0, 0), Vec3(draw(), draw(), 0), Vec3(0, draw(), draw())};
    const double clearance = random.below(2) == 0 ? 0.0 : std::abs(draw());
    const Model<Point>& model = round % 2 == 0 ? groups : own;
    PointsOn<Simd> simd(model, AdmitAll{}, UniformClearance(clearance)),
        other(small, AdmitAll{}, UniformClearance(clearance));
    PointsOn<Brute> brute(model, AdmitAll{}, UniformClearance(clearance)),
        other_brute(small, AdmitAll{}, UniformClearance(clearance));
    std::vector<Point> others(small.size());
    for (Point& point : others) point.position = far[random.below(far.size())];
    other.update_placed(others);
    other_brute.update_placed(others);
    std::vector<Pose> poses(simd.model().groups()->size());
    for (Pose& pose : poses) pose.translation = far[random.below(far.size())];
    poses.front() = Pose{};
    std::vector<Point> points(model.size());
    for (Point& point : points) point.position = far[random.below(far.size())];
    for (int state = 0; state < 2; ++state) {
      for (const double margin : {0x1p-1074, 1.0, 0x1p130, 0x1p995}) {
        if (state == 0)
          simd.update_poses(poses), brute.update_poses(poses);
        else
          simd.update_placed(points), brute.update_placed(points);
        expect_equal(simd, brute, margin);
        EXPECT_EQ(simd.within(other, margin), brute.within(other_brute, margin));
        EXPECT_EQ(other.within(simd, margin), other_brute.within(brute, margin));
        EXPECT_EQ(simd.closest(other).value().gap(), brute.closest(other_brute).value().gap());
      }
    }
  }
}

TEST(SimdExtremes, HoldWhereSquaresUnderflow) {
  const double w = std::ldexp(1.0, -75);
  const Model<Point> model = sliders(std::vector<Vec3>(4, Vec3::Zero()));
  for (const double clearance : {0.0, 1.5 * w}) {
    PointsOn<Simd> simd(model, AdmitAll{}, UniformClearance(clearance));
    PointsOn<Brute> brute(model, AdmitAll{}, UniformClearance(clearance));
    for (const auto& points :
         {std::vector<Point>{
              {Vec3(0, 0, 0)}, {Vec3(1.516 * w, 0, 0)}, {Vec3(4e-20, 0, 0)}, {Vec3(4e-20, 1.0353 * w, 1.0353 * w)}},
          {{Vec3(0, 0, 0)}, {Vec3(1.035 * w, 1.035 * w, 0)}, {Vec3(4e-20, 0, 0)}, {Vec3(4e-20, 0, 1.2 * w)}}}) {
      simd.update_placed(points);
      brute.update_placed(points);
      expect_equal(simd, brute, w);
    }
  }
}

TEST(SimdExtremes, HoldForAModelInsideAFarLargerOne) {
  // Both models have the same centre, so floats hold each of them in the other's length unit.
  const double size = 0x1p-59;
  const Model<Point> large = sliders({{-1, 0, 0}, {1, 0, 0}, {0, -0.5, 0}, {0, 0.5, 0}});
  const Model<Point> small = sliders({{-size, 0, 0}, {size, 0, 0}});
  // Twice the distance of the two models, and a threshold far above the size of both models.
  for (const double clearance : {2.0, 1e15}) {
    SCOPED_TRACE(clearance);
    PointsOn<Simd> a(large, AdmitAll{}, UniformClearance(clearance)), b(small, AdmitAll{}, UniformClearance(clearance));
    PointsOn<Brute> c(large, AdmitAll{}, UniformClearance(clearance)),
        d(small, AdmitAll{}, UniformClearance(clearance));
    for (const double travel : {0.0, 1e100}) {
      const std::vector<double> q = {travel, travel};
      b.update(q);
      d.update(q);
      EXPECT_EQ(a.collisions(b), c.collisions(d));
      EXPECT_EQ(b.collisions(a), d.collisions(c));
      EXPECT_EQ(b.self_collisions(), d.self_collisions());
    }
  }
}

}  // namespace extremes_test
}  // namespace hinge
