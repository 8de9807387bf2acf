// SPDX-License-Identifier: BSD-3-Clause
// Tests invalid input: a typed exception names the element, and nothing is changed.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include "extremes/refusal.hpp"
#include "extremes/three_engines.hpp"
#include "hinge/policy/different_links.hpp"
#include "hinge/primitive/capsule.hpp"
#include "hinge/primitive/sphere.hpp"
#include "hinge/primitive/triangle.hpp"

namespace hinge {
namespace refused_test {

using test::AnyEngine;
using test::refusal;

constexpr double nan = std::numeric_limits<double>::quiet_NaN(), infinity = std::numeric_limits<double>::infinity();

/// Expects a message of one line that names the element.
void expect_names(const std::string& message, const std::string& element) {
  EXPECT_NE(message.find(element), std::string::npos) << "'" << message << "' should name '" << element << "'";
  EXPECT_EQ(message.find('\n'), std::string::npos) << message;
}

/// Two links with three points each; the second rotates about z.
ModelBuilder<Point> small_model() {
  ModelBuilder<Point> builder;
  const std::vector<Point> points = {{Vec3(0, 0, 0)}, {Vec3(2, 0, 0)}, {Vec3(0, 2, 1)}};
  builder.add_link(builder.add_link(world, Prismatic{}, points), Revolute{}, points);
  return builder;
}

/// Returns the visible state of a builder as text.
std::string state(ModelBuilder<Point> builder) {
  const Model<Point> model = builder.finish();
  std::string text = std::to_string(model.size()) + " primitives, " + std::to_string(model.tree().link_count()) +
                     " links, " + std::to_string(model.tree().dof_count()) + " DOF, " +
                     std::to_string(model.tree().closures().size()) + " closures:";
  for (const LinkId link : model.links()) text.append(" ").append(std::to_string(index(link)));
  return text;
}

TEST(Refused, NanOrInfinityInAnythingOfAModel) {
  ModelBuilder<Point> builder = small_model();
  const std::string before = state(builder);
  const LinkId second{2};
  for (const double bad : {nan, infinity, -infinity, 1e305}) {
    SCOPED_TRACE(bad);
    for (int k = 0; k < 3; ++k) {
      Vec3 x = Vec3::Zero();
      x[k] = bad;
      Pose shifted;
      shifted.translation = x;
      expect_names(refusal<ModelError>([&] { builder.add_primitive(second, Point{x}); }), "primitive 6 on link 2");
      expect_names(refusal<ModelError>([&] { builder.add_link(second, Fixed{}, {Point{}, Point{x}}); }), "primitive 7");
      expect_names(refusal<ModelError>([&] { builder.add_link(second, Fixed{shifted}); }), "link 3");
      expect_names(refusal<ModelError>([&] {
                     builder.add_link(second, Revolute{Vec3::UnitX(), x, {}, "wrist"});
                   }),
                   "link 3 (wrist)");
      expect_names(refusal<ModelError>([&] {
                     builder.add_closure({LinkId{1}, second, {x, x}, {x, x}, "ring"});
                   }),
                   "(ring)");
      if (bad == 1e305) continue;
      expect_names(refusal<ModelError>([&] { builder.add_link(second, Prismatic{x, {}, {}}); }), "axis");
      for (int row = 0; row < 3; ++row) {
        Pose turned;
        turned.rotation(row, k) = bad;
        EXPECT_FALSE(is_rigid(turned));
      }
    }
    EXPECT_THROW(UniformClearance{bad}, ModelError);
    expect_names(refusal<ModelError>([&] { test::one_type(1, bad); }), "entry (0, 0)");
  }
  EXPECT_EQ(state(builder), before);
}

TEST(Refused, NanOrNegativeRadiusAndNanInAnyCorner) {
  ModelBuilder<Sphere> spheres;
  ModelBuilder<Capsule> capsules;
  ModelBuilder<Triangle> triangles;
  for (const double bad : {nan, infinity, -1.0, -1e-300}) {
    EXPECT_THROW(spheres.add_primitive(world, Sphere{Vec3::Zero(), bad}), ModelError) << bad;
    EXPECT_THROW(capsules.add_primitive(world, Capsule{Vec3::Zero(), Vec3(10, 10, 10), bad}), ModelError) << bad;
    if (bad < 0.0) continue;
    for (int corner = 0; corner < 3; ++corner) {
      std::vector<Vec3> v = {Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(0, 1, 0)};
      v[static_cast<std::size_t>(corner)][1] = bad;
      EXPECT_THROW(triangles.add_primitive(world, Triangle{v[0], v[1], v[2]}), ModelError) << corner;
      const Capsule capsule{v[0], corner == 2 ? v[2] : v[1], 0.5};
      EXPECT_THROW(capsules.add_primitive(world, capsule), ModelError) << corner;
    }
  }
  spheres.add_primitive(world, Sphere{Vec3::Zero(), 0.0});
  EXPECT_EQ(spheres.finish().size(), 1U);
  EXPECT_EQ(capsules.finish().size() + triangles.finish().size(), 0U);
}

TEST(Refused, NanOrInfinityInAnythingOfAState) {
  const Model<Point> model = small_model().finish();
  for (AnyEngine<Point>& engine : test::atoms_on_three_engines(model, test::one_type(6, 1.5))) {
    SCOPED_TRACE(engine.name);
    const std::vector<double> q = {0.5, 0.25};
    engine.update(q);
    const std::vector<Hit> before = engine.within(0.5, {});
    ASSERT_FALSE(before.empty());
    for (const double bad : {nan, infinity, -infinity}) {
      expect_names(refusal<ConfigurationError>([&] { engine.update(std::vector<double>{0.0, bad}); }), "value 1");
      std::vector<Pose> poses(3);
      poses[2].translation[1] = bad;
      expect_names(refusal<ConfigurationError>([&] { engine.update_poses(poses); }), "rigid group 2");
      poses[2] = Pose{};
      poses[1].rotation(0, 2) = bad;
      expect_names(refusal<ConfigurationError>([&] { engine.update_poses(poses); }), "rigid group 1");
      std::vector<Point> placed(6);
      placed[4].position[0] = bad;
      expect_names(refusal<ConfigurationError>([&] { engine.update_placed(placed); }), "primitive 4");
      expect_names(refusal<ConfigurationError>([&] { engine.within(bad, {}); }), "margin");
      const std::vector<double> clearance = {0.0, 0.0, bad};
      QueryOptions options;
      options.clearance = clearance;
      expect_names(refusal<ConfigurationError>([&] { engine.collides(options); }), "rigid group 2");
    }
    EXPECT_THROW(engine.update(std::vector<double>{1e305, 0.0}), ConfigurationError);  // a prismatic joint
    EXPECT_THROW(engine.update(std::vector<double>{0.0}), ConfigurationError);
    EXPECT_THROW(engine.update_poses(std::vector<Pose>(2)), ConfigurationError);
    EXPECT_THROW(engine.update_placed(std::vector<Point>(7)), ConfigurationError);
    EXPECT_THROW(engine.within(-0.5, {}), ConfigurationError);
    EXPECT_EQ(engine.within(0.5, {}), before);
  }
}

struct Listed {
  std::vector<PrimitiveId> with_each;
  bool admits(PrimitiveId, PrimitiveId) const noexcept { return false; }
  std::span<const PrimitiveId> excluded(PrimitiveId) const noexcept { return with_each; }
};

TEST(Refused, BadThresholdTableTypeExclusionOrIndex) {
  using Types = std::vector<std::uint16_t>;
  const double m = 1.0, other = std::nextafter(1.0, 2.0);
  expect_names(refusal<ModelError>([&] { TypedThresholds(Types{0, 1}, 2, {m, -0.5, -0.5, m}); }), "entry (0, 1)");
  expect_names(refusal<ModelError>([&] { TypedThresholds(Types{0, 1}, 2, {m, m, other, m}); }), "mirror");
  expect_names(refusal<ModelError>([&] { TypedThresholds(Types{0, 1}, 2, {m, m, m}); }), "3 entries");
  expect_names(refusal<ModelError>([&] { TypedThresholds(Types{0, 2}, 2, {m, m, m, m}); }), "primitive 1");
  expect_names(refusal<ModelError>([&] { TypedThresholds(Types{}, std::size_t{1} << 32, {}); }), "types");
  const Model<Point> model = small_model().finish();
  const auto on = [&](const auto& filter, const auto& matrix) { test::on_engine<Brute>("", model, filter, matrix); };
  const UniformClearance clearance(1.0);
  expect_names(refusal<ModelError>([&] { on(AdmitAll{}, test::one_type(5, 1.0)); }), "5");
  expect_names(refusal<ModelError>([&] { on(Listed{{PrimitiveId{0}}}, clearance); }), "primitive 0, itself");
  expect_names(refusal<ModelError>([&] { on(Listed{{PrimitiveId{6}}}, clearance); }), "primitive 6, which does not");
  expect_names(refusal<ModelError>([&] { on(Listed{{PrimitiveId{5}, PrimitiveId{4}}}, clearance); }), "out of order");
  const std::vector<LinkId> links(6, LinkId{1});
  expect_names(refusal<ModelError>([&] { on(DifferentLinks(links), clearance); }), "links");
  expect_names(refusal<ModelError>([&] { DifferentLinks(links, {{LinkId{1}, LinkId{1}}}); }), "link 1 with itself");
  expect_names(refusal<ModelError>([] { DifferentLinks({LinkId{0xffffffffU}}); }), "link 4294967295");
  KinematicTree larger;
  for (int k = 0; k < 3; ++k) larger.add_link(world, Revolute{});
  expect_names(refusal<ModelError>([&] { SelectedModel<Point>(model, DofSelection::all(larger)); }), "DOF 2");
  expect_names(refusal<ModelError>([&] { DofSelection(model.tree(), {DofId{2}}); }), "DOF 2");
  ModelBuilder<Point> builder = small_model();
  const std::string before = state(builder);
  const std::array<Vec3, 2> origins = {Vec3::Zero(), Vec3::Zero()};
  expect_names(refusal<ModelError>([&] { builder.add_primitive(LinkId{3}, Point{}); }), "link 3 does not exist");
  expect_names(refusal<ModelError>([&] { builder.add_link(LinkId{3}, Fixed{}); }), "parent 3");
  expect_names(refusal<ModelError>([&] {
                 builder.add_closure({LinkId{1}, LinkId{3}, origins, origins, "a"});
               }),
               "closure 0 (a)");
  EXPECT_EQ(state(builder), before);
  builder.set_basic_groups({1, 2});
  expect_names(refusal<ModelError>([&] { builder.finish(); }), "2 basic group labels");
}

TEST(Refused, AnAxisOfZeroLengthButNoOther) {
  ModelBuilder<Point> builder = small_model();
  const std::string before = state(builder);
  expect_names(refusal<ModelError>([&] {
                 builder.add_link(world, Revolute{Vec3::Zero(), Vec3::Zero(), {}, "knee"}, {Point{}});
               }),
               "link 3 (knee): the axis has length 0");
  EXPECT_THROW(builder.add_link(world, Prismatic{-Vec3::Zero(), {}, {}}), ModelError);
  EXPECT_EQ(state(builder), before);
  // The squares of these sizes overflow or underflow.
  for (const double size : {5e-324, 1e-200, 1e-161, 1e-160, 1.0, 1e160, 1e300}) {
    KinematicTree tree;
    const Joint& joint = tree.joint(tree.add_link(world, Revolute{Vec3(0, size, size), Vec3::Zero(), {}, {}}));
    EXPECT_EQ(joint.axis, Vec3(0, joint.axis[1], joint.axis[1])) << size;
    EXPECT_DOUBLE_EQ(joint.axis[1], std::sqrt(0.5)) << size;
  }
}

TEST(Refused, APlacementThatIsScaledShearedMirroredOrZero) {
  const auto turned = [](const Mat3& factor) {
    return Pose{rotation_about(Vec3::UnitX(), 0.7) * factor, Vec3::Zero()};
  };
  const auto scaled = [](double s) { return Mat3(s * Mat3::Identity()); };
  Mat3 shear = Mat3::Identity();
  shear(0, 1) = 0.01;
  const std::vector<Pose> bad = {turned(scaled(1.001)), turned(scaled(-1.0)),     turned(scaled(0.0)),
                                 turned(shear),         turned(scaled(1 + 1e-9)), turned(scaled(1 - 1e-9))};
  const Pose good = turned(scaled(1 + 4e-10));  // small deviations are accepted
  ModelBuilder<Point> builder = small_model();
  for (const Pose& pose : bad) EXPECT_THROW(builder.add_link(world, Fixed{pose}), ModelError);
  for (const Pose& pose : bad)
    EXPECT_THROW(builder.add_link(world, Revolute{{1, 0, 0}, Vec3::Zero(), pose, {}}), ModelError);
  const Model<Point> model = builder.finish();
  EXPECT_EQ(model.tree().link_count(), 3U);
  for (AnyEngine<Point>& engine : test::atoms_on_three_engines(model, test::one_type(6, 1.5))) {
    SCOPED_TRACE(engine.name);
    std::vector<Pose> poses(3);
    poses[2] = good;
    engine.update_poses(poses);
    const std::vector<Hit> before = engine.within(0.5, {});
    EXPECT_EQ(engine.placed()[5].position, good * Vec3(0, 2, 1));
    for (const Pose& pose : bad) {
      poses[1] = pose;
      expect_names(refusal<ConfigurationError>([&] { engine.update_poses(poses); }), "rigid group 1");
    }
    poses = {good, Pose{}, Pose{}};
    expect_names(refusal<ConfigurationError>([&] { engine.update_poses(poses); }),
                 "expected the identity, because this group is the world");
    EXPECT_EQ(engine.within(0.5, {}), before);
  }
}

}  // namespace refused_test
}  // namespace hinge
