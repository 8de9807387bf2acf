// SPDX-License-Identifier: BSD-3-Clause
// Edge cases of a hierarchy: model sizes, rejected input, ties, coincident input, counts.
#include "hinge/hierarchy.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <string>
#include <utility>
#include <vector>

#include "engine/random_mechanism.hpp"
#include "hinge/engine/brute.hpp"
#include "hinge/engine/lazy.hpp"
#include "hinge/engine/simd.hpp"
#include "hinge/primitive/point.hpp"
#include "hinge/primitive/sphere.hpp"

namespace hinge {
namespace hierarchy_test {

using test::Random;

constexpr double nan = std::numeric_limits<double>::quiet_NaN();

/// Points in two rigid groups that rotate relative to each other about a distant axis.
Model<Point> two_groups(const std::vector<Vec3>& fixed, const std::vector<Vec3>& moving) {
  ModelBuilder<Point> build;
  for (const Vec3& x : fixed) build.add_primitive(world, Point{x});
  const LinkId link = build.add_link(world, Revolute{Vec3::UnitZ(), Vec3(1e3, 1e3, 0), {}, {}});
  for (const Vec3& x : moving) build.add_primitive(link, Point{x});
  return build.finish();
}

template <template <class, class, class> class EngineOf>
using PointsOn = Hierarchy<Point, AdmitAll, UniformClearance, EngineOf>;

template <template <class, class, class> class EngineOf>
struct On {
  using Points = PointsOn<EngineOf>;
};
template <class Engine>
class EveryHierarchy : public testing::Test {};
using Engines = testing::Types<On<Brute>, On<Lazy>, On<Simd>>;
TYPED_TEST_SUITE(EveryHierarchy, Engines);

TYPED_TEST(EveryHierarchy, AnswersForNoAndOnePrimitive) {
  using Points = typename TypeParam::Points;
  for (const std::size_t n : {0U, 1U}) {
    Points points(two_groups(std::vector<Vec3>(n, Vec3::Zero()), {}), AdmitAll{}, UniformClearance{1.0});
    EXPECT_FALSE(points.self_collides());
    EXPECT_TRUE(points.self_collisions().empty());
    EXPECT_FALSE(points.self_closest().has_value());
    const Points other = points;  // NOLINT(performance-unnecessary-copy-initialization): a query needs two objects
    EXPECT_EQ(points.collides(other), n == 1);
    EXPECT_EQ(points.closest(other).has_value(), n == 1);
  }
}

TYPED_TEST(EveryHierarchy, HasStrictThresholdsForPoints) {
  using Points = typename TypeParam::Points;
  const double m = 2.5;
  for (const auto& [x, hit] :
       {std::pair(m, false), std::pair(std::nextafter(m, 0.0), true), std::pair(std::nextafter(m, 3.0), false)}) {
    Points points(two_groups({Vec3::Zero()}, {Vec3(x, 0, 0)}), AdmitAll{}, UniformClearance{m});
    EXPECT_EQ(points.self_collides(), hit);
  }
}

TYPED_TEST(EveryHierarchy, NeverHitsAtThresholdZeroUnlessSolid) {
  using Points = typename TypeParam::Points;
  Points points(two_groups({Vec3::Zero()}, {Vec3::Zero()}), AdmitAll{}, UniformClearance{0.0});
  EXPECT_FALSE(points.self_collides());
  EXPECT_EQ(points.self_closest()->gap(), 0.0);
  ModelBuilder<Sphere> build;
  build.add_primitive(world, Sphere{Vec3::Zero(), 1.0});
  build.add_link(world, Revolute{Vec3::UnitZ(), Vec3(50, 0, 0), {}, {}}, {Sphere{Vec3(2, 0, 0), 1.0}});
  Hierarchy spheres(build.finish(), AdmitAll{}, UniformClearance{0.0});
  EXPECT_TRUE(spheres.self_collides()) << "closed balls touch";
}

TYPED_TEST(EveryHierarchy, CountsEveryCoincidentPair) {
  using Points = typename TypeParam::Points;
  const std::size_t n = 200;
  Points points(two_groups(std::vector<Vec3>(n, Vec3(1, 2, 3)), std::vector<Vec3>(n, Vec3(1, 2, 3))), AdmitAll{},
                UniformClearance{0.1});
  EXPECT_EQ(points.self_collisions().size(), n * n);
  std::vector<Point> placed(2 * n, Point{Vec3(5, 5, 5)});
  points.update_placed(placed);
  EXPECT_EQ(points.self_collisions().size(), n * (2 * n - 1)) << "given coordinates: pairs inside groups count too";
}

TYPED_TEST(EveryHierarchy, HitsEveryNeighbourOfALatticeJustAboveItsSpacing) {
  using Points = typename TypeParam::Points;
  const int n = 6;
  std::vector<Vec3> even, odd;
  for (int x = 0; x < n; ++x)
    for (int y = 0; y < n; ++y)
      for (int z = 0; z < n; ++z) ((x + y + z) % 2 == 0 ? even : odd).emplace_back(x, y, z);
  Points at(two_groups(even, odd), AdmitAll{}, UniformClearance{1.0});
  EXPECT_TRUE(at.self_collisions().empty());
  Points above(two_groups(even, odd), AdmitAll{}, UniformClearance{std::nextafter(1.0, 2.0)});
  EXPECT_EQ(above.self_collisions().size(), static_cast<std::size_t>(3 * n * n * (n - 1)));
}

TYPED_TEST(EveryHierarchy, GivesClosestTiesToTheSmallestPair) {
  using Points = typename TypeParam::Points;
  Points points(two_groups({Vec3(0, 0, 0), Vec3(10, 0, 0)}, {Vec3(0, 3, 0), Vec3(10, 3, 0)}), AdmitAll{},
                UniformClearance{1.0});
  EXPECT_EQ(points.self_closest()->first, PrimitiveId{0});
  EXPECT_EQ(points.self_closest()->second, PrimitiveId{2});
}

TYPED_TEST(EveryHierarchy, ReportsConstantContactsApart) {
  using Points = typename TypeParam::Points;
  ModelBuilder<Point> build;
  build.add_primitive(world, Point{Vec3(0, 0, 0)});
  build.add_primitive(world, Point{Vec3(0.5, 0, 0)});
  // This point is on the joint axis, so its distance to the first two points never changes.
  build.add_link(world, Revolute{Vec3::UnitZ(), Vec3(0.25, 0, 0), {}, {}},
                 {Point{Vec3(0.25, 0, 0.1)}, Point{Vec3(4, 0, 0)}});
  Points points(build.finish(), AdmitAll{}, UniformClearance{1.0});
  EXPECT_FALSE(points.self_collides());
  const auto contacts = points.constant_contacts();
  ASSERT_EQ(contacts.size(), 3U);
  EXPECT_EQ(contacts[0].second, PrimitiveId{1});
  EXPECT_EQ(contacts[1].second, PrimitiveId{2});
}

TYPED_TEST(EveryHierarchy, RefusesBadInputNamingItAndKeepsItsState) {
  using Points = typename TypeParam::Points;
  Points points(two_groups({Vec3::Zero()}, {Vec3(0.5, 0, 0)}), AdmitAll{}, UniformClearance{1.0});
  const std::vector<Hit> before = points.self_collisions();
  const auto message = [&](const auto& act) -> std::string {
    try {
      act();
    } catch (const ConfigurationError& error) {
      return error.what();
    }
    return "";
  };
  EXPECT_EQ(message([&] { points.update({}); }), "configuration has 0 values, expected 1");
  EXPECT_NE(message([&] { points.update(std::vector<double>{nan}); }).find("value 0"), std::string::npos);
  EXPECT_NE(message([&] {
              points.update_placed(std::vector<Point>{{Vec3::Zero()}, {Vec3(0, nan, 0)}});
            }).find("primitive 1"),
            std::string::npos);
  EXPECT_NE(
      message([&] { points.update_poses(std::vector<Pose>(3)); }).find("3 poses, expected 2, one per rigid group"),
      std::string::npos);
  EXPECT_NE(message([&] { points.self_within(-1.0); }).find("margin"), std::string::npos);
  EXPECT_NE(message([&] { points.self_within(nan); }).find("margin"), std::string::npos);
  const double clearance[] = {0.0, -1.0};
  QueryOptions options;
  options.clearance = clearance;
  EXPECT_NE(message([&] { points.self_collides(options); }).find("rigid group 1"), std::string::npos);
  const double of_another[] = {0.0, 1.0};
  options = {};
  options.other_clearance = of_another;
  EXPECT_NE(message([&] { points.self_collides(options); }).find("other_clearance"), std::string::npos);
  EXPECT_NE(message([&] { points.self_within(1.0, options); }).find("other_clearance"), std::string::npos);
  EXPECT_NE(message([&] { points.self_closest(options); }).find("other_clearance"), std::string::npos);
  EXPECT_EQ(points.self_collisions(), before);
}

TYPED_TEST(EveryHierarchy, RefusesPoliciesMadeForAnotherModel) {
  using Points = typename TypeParam::Points;
  const auto model = two_groups({Vec3::Zero()}, {Vec3::UnitX()});
  const TypedThresholds three({0, 0, 0}, 1, {1.0});
  EXPECT_THROW((Hierarchy(model, AdmitAll{}, three)), ModelError);
  EXPECT_THROW(TypedThresholds({0, 1}, 1, {1.0}), ModelError);
  EXPECT_THROW(TypedThresholds({0}, 2, {1.0, 2.0, 3.0, 1.0}), ModelError);
  EXPECT_THROW(TypedThresholds({0}, 1, {-1.0}), ModelError);
  EXPECT_THROW(TypedThresholds({0}, 1, {nan}), ModelError);
  EXPECT_THROW(TypedThresholds({0}, 2, {1.0}), ModelError);
  EXPECT_THROW(UniformClearance{-0.1}, ModelError);
  EXPECT_THROW(UniformClearance{nan}, ModelError);
  Points a(model, AdmitAll{}, UniformClearance{1.0}), b(model, AdmitAll{}, UniformClearance{2.0});
  EXPECT_THROW(a.collides(b), ModelError);
}

TYPED_TEST(EveryHierarchy, AnswersWhenConst) {
  using Points = typename TypeParam::Points;
  const auto model = two_groups({Vec3::Zero()}, {Vec3::UnitX()});
  Points moving(model, AdmitAll{}, UniformClearance{1.5});
  moving.update({0.0});
  const Points& points = moving;
  const Points copy = points;
  EXPECT_TRUE(points.self_collides());
  EXPECT_EQ(points.self_collisions(), copy.self_collisions());
  EXPECT_EQ(points.self_closest()->distance, 1.0);
  EXPECT_EQ(points.collisions(copy).size(), 4U);
  EXPECT_EQ(points.collisions(points), points.collisions(copy));
  EXPECT_EQ(points.placed()[1].position, Vec3(Vec3::UnitX()));
  EXPECT_THROW(moving.update({0.0, 1.0}), ConfigurationError);
}

TEST(ModelBuilder, RefusesPrimitivesWithoutFiniteBounds) {
  ModelBuilder<Sphere> build;
  EXPECT_THROW(build.add_primitive(world, Sphere{Vec3(nan, 0, 0), 1.0}), ModelError);
  EXPECT_THROW(build.add_primitive(world, Sphere{Vec3::Zero(), nan}), ModelError);
  EXPECT_THROW(build.add_primitive(world, Sphere{Vec3::Zero(), -1.0}), ModelError);
  EXPECT_THROW(build.add_primitive(id<LinkId>(3), Sphere{Vec3::Zero(), 1.0}), ModelError);
  build.add_primitive(world, Sphere{Vec3::Zero(), 0.0});
  build.set_basic_groups({1, 2});
  EXPECT_THROW(build.finish(), ModelError);
}

TEST(Hierarchy, CountsItsWork) {
  Random random(8);
  const auto make = [](Random& r, const Vec3&, const Vec3&) { return Point{r.vector(4.0)}; };
  const auto model = test::random_model(random, 30, 5, true, make);
  PointsOn<Lazy> lazy(model, AdmitAll{}, UniformClearance{0.5});
  PointsOn<Brute> brute(model, AdmitAll{}, UniformClearance{0.5});
  QueryCounts few, many;
  QueryOptions options;
  options.counts = &few;
  lazy.self_collisions(options);
  options.counts = &many;
  brute.self_collisions(options);
  EXPECT_EQ(many.pairs_tested, model.size() * (model.size() - 1) / 2);
  EXPECT_LT(few.pairs_tested, many.pairs_tested);
  EXPECT_GT(few.boxes_tested, 0U);
  EXPECT_GT(few.nodes_split, 0U);
  QueryCounts simd_counts;
  options.counts = &simd_counts;
  PointsOn<Simd> simd(model, AdmitAll{}, UniformClearance{0.5});
  simd.self_collisions(options);
  EXPECT_GT(simd_counts.boxes_tested, 0U);
  EXPECT_GT(simd_counts.pairs_tested, 0U);
}

TEST(Hierarchy, KeepsTheTreesOfGroupsThatStandStill) {
  Random random(8);
  std::vector<Vec3> fixed, moving;
  for (int k = 0; k < 300; ++k) fixed.push_back(random.vector(5.0));
  for (int k = 0; k < 5; ++k) moving.push_back(random.vector(5.0));
  PointsOn<Lazy> lazy(two_groups(fixed, moving), AdmitAll{}, UniformClearance{0.5});
  QueryCounts first, again;
  QueryOptions options;
  options.counts = &first;
  lazy.self_collisions(options);
  lazy.update(std::vector<double>{1e-9});
  options.counts = &again;
  lazy.self_collisions(options);
  EXPECT_GT(first.nodes_split, 50U);
  EXPECT_LT(again.nodes_split, 10U) << "only the moved group and the upper tree are built again";
}

}  // namespace hierarchy_test
}  // namespace hinge
