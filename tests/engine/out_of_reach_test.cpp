// SPDX-License-Identifier: BSD-3-Clause
// Primitives at rest that nothing can approach are found, and leaving them out changes no answer.
#include "hinge/detail/model/out_of_reach.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

#include "engine/random_mechanism.hpp"
#include "engine/side_by_side.hpp"
#include "hinge/engine/simd.hpp"
#include "hinge/model/model.hpp"
#include "hinge/model/selected_model.hpp"
#include "hinge/primitive/point.hpp"
#include "hinge/primitive/sphere.hpp"

namespace hinge {
namespace out_of_reach_test {

using test::ExcludedPairs;
using test::Random;

/// Two links of length 1 with joints at (0, 0, 0) and (1, 0, 0), the second with a primitive at its end, and primitives
/// at rest at `at_rest`.
template <class P>
ModelBuilder<P> two_links(const std::vector<P>& at_rest, const P& end) {
  ModelBuilder<P> builder;
  for (const P& p : at_rest) builder.add_primitive(world, p);
  const LinkId upper = builder.add_link(world, Revolute{Vec3::UnitZ(), Vec3::Zero(), {}, {}});
  Pose elbow;
  elbow.translation = Vec3(1, 0, 0);
  builder.add_primitive(builder.add_link(upper, Revolute{Vec3::UnitY(), Vec3::Zero(), elbow, {}}), end);
  return builder;
}

template <class P, class D>
std::vector<std::uint8_t> found(const Model<P>& model, const D& matrix) {
  return detail::out_of_reach(SelectedModel<P>(model, DofSelection::all(model.tree())), matrix);
}

TEST(OutOfReach, BeginsWhereTheStretchedArmEnds) {
  const double clearance = 0.5;
  const auto model = two_links<Point>({{Vec3(2.499, 0, 0)}, {Vec3(2.501, 0, 0)}, {Vec3(0, 0, -2.501)}, {Vec3(1, 1, 1)}},
                                      {Vec3(1, 0, 0)})
                         .finish();
  EXPECT_EQ(found(model, UniformClearance(clearance)), (std::vector<std::uint8_t>{0, 1, 1, 0, 0}));
}

TEST(OutOfReach, CountsTheRadiiOfBothSpheres) {
  // The box of a sphere of radius r has a diagonal of 2 sqrt(3) r.
  const auto model = two_links<Sphere>({{Vec3(2.6, 0, 0), 0.2}, {Vec3(3.1, 0, 0), 0.2}}, {Vec3(1, 0, 0), 0.4}).finish();
  EXPECT_EQ(found(model, UniformClearance(0.0)), (std::vector<std::uint8_t>{0, 1, 0}));
}

TEST(OutOfReach, NothingIsBehindAPrismaticJoint) {
  ModelBuilder<Point> builder = two_links<Point>({{Vec3(9, 0, 0)}}, {Vec3(1, 0, 0)});
  EXPECT_EQ(found(ModelBuilder<Point>(builder).finish(), UniformClearance(0.5))[0], 1);
  builder.add_primitive(builder.add_link(LinkId{2}, Prismatic{Vec3::UnitX(), {}, {}}), Point{Vec3(0, 0, 0)});
  EXPECT_EQ(found(builder.finish(), UniformClearance(0.5))[0], 0);
}

TEST(OutOfReach, SaysNothingOfManyChains) {
  ModelBuilder<Point> builder = two_links<Point>({{Vec3(9, 0, 0)}}, {Vec3(1, 0, 0)});
  for (int k = 0; k < 300; ++k)
    builder.add_primitive(builder.add_link(world, Revolute{Vec3::UnitZ(), Vec3::Zero(), {}, {}}), {Vec3(1, 0, 0)});
  EXPECT_EQ(found(builder.finish(), UniformClearance(0.5))[0], 0);
}

/// A rod of points at rest along x, and one to three short chains near its start.
Model<Point> rod(Random& random) {
  ModelBuilder<Point> builder;
  const std::size_t at_rest = 20 + random.below(random.one_in(8) ? 2000 : 200);
  const double offset = random.one_in(3) ? 1e6 : 0.0;
  for (std::size_t k = 0; k < at_rest; ++k)
    builder.add_primitive(world, {Vec3(offset + random.uniform(0.0, 30.0), random.uniform(-2.0, 2.0), 0.0)});
  for (std::size_t chain = 1 + random.below(3); chain-- > 0;) {
    LinkId link = world;
    Pose origin;
    origin.translation = Vec3(offset + random.uniform(0.0, 3.0), 0.0, 0.0);
    for (std::size_t k = 1 + random.below(6); k-- > 0;) {
      link = builder.add_link(link, Revolute{random.vector(1.0).normalized(), random.vector(0.3), origin, {}});
      if (random.one_in(20)) link = builder.add_link(link, Prismatic{random.vector(1.0).normalized(), {}, {}});
      for (std::size_t n = random.below(4); n-- > 0;) builder.add_primitive(link, {random.vector(1.0)});
      origin = random.pose(0.8);
    }
  }
  return builder.finish();
}

TEST(OutOfReach, IsNeverMetByWhatMoves) {
  Random random(20261127);
  std::size_t out = 0;
  double closest = 1e9;
  for (int model_number = 0; model_number < 40; ++model_number) {
    const Model<Point> model = rod(random);
    const auto matrix = test::random_thresholds(model.size(), random);
    const auto selected = std::make_shared<const SelectedModel<Point>>(model, DofSelection::all(model.tree()));
    const std::vector<std::uint8_t> flags = detail::out_of_reach(*selected, matrix);
    State<Point> state(selected);
    std::vector<double> q(selected->selection().size());
    for (int k = 0; k < 20; ++k) {
      for (double& value : q) value = random.one_in(4) ? 0.0 : random.uniform(-4.0, 4.0);
      state.update(q);
      const auto placed = state.place_all();
      for (std::size_t i = 0; i < model.size(); ++i)
        for (std::size_t j = 0; j < model.size() && flags[i] != 0; ++j) {
          if (selected->group_of(id<PrimitiveId>(j)) == GroupId{0}) continue;
          const double m = matrix.threshold(id<PrimitiveId>(i), id<PrimitiveId>(j));
          closest = std::min(closest, norm(Vec3(placed[i].position - placed[j].position)) - m);
          ++out;
        }
    }
  }
  EXPECT_GT(out, 10000U);
  EXPECT_GT(closest, 0.0);
  EXPECT_LT(closest, 1.0);  // the bound is not far too wide
}

TEST(OutOfReach, EveryQueryEqualsBruteForce) {
  Random random(7);
  std::size_t left_out = 0;
  for (int model_number = 0; model_number < 60; ++model_number) {
    SCOPED_TRACE(model_number);
    const Model<Point> model = rod(random);
    const ExcludedPairs filter(model.size(), random, std::max<std::size_t>(5, model.size() / 4));
    const auto matrix = test::random_thresholds(model.size(), random);
    const DofSelection all = DofSelection::all(model.tree());
    left_out += static_cast<std::size_t>(
        std::ranges::count(detail::out_of_reach(SelectedModel<Point>(model, all), matrix), std::uint8_t{1}));
    test::Pair<Point, ExcludedPairs, Simd> pair(model, all, filter, matrix), other = pair;
    std::vector<double> q(all.size());
    for (int step = 0; step < 8; ++step) {
      const auto both = [&](const auto& update) {
        update(pair.tested);
        update(pair.reference);
      };
      for (double& value : q) value = random.uniform(-4.0, 4.0);
      if (step % 4 == 1) {  // poses that no configuration gives: the chains are anywhere along the rod
        std::vector<Pose> poses(pair.tested.model().groups()->size());
        for (std::size_t g = 1; g < poses.size(); ++g) {
          poses[g] = random.pose(1.0);
          poses[g].translation += model.primitives()[random.below(model.size())].position;
        }
        both([&](auto& hierarchy) { hierarchy.update_poses(poses); });
      } else if (step % 4 == 2) {
        std::vector<Point> placed;
        for (std::size_t i = 0; i < model.size(); ++i)
          placed.push_back({Vec3(model.primitives()[random.below(20)].position + random.vector(15.0))});
        both([&](auto& hierarchy) { hierarchy.update_placed(placed); });
      } else {
        both([&](auto& hierarchy) { hierarchy.update(q); });
      }
      pair.compare(random);
      if (model.size() < 300) pair.compare_with(other, random);
      if (testing::Test::HasFailure()) return;
    }
  }
  EXPECT_GT(left_out, 1000U);
}

}  // namespace out_of_reach_test
}  // namespace hinge
