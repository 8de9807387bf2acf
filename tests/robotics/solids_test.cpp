// SPDX-License-Identifier: BSD-3-Clause
// Tests that boxes, cylinders, spheres and capsules are solid, against projections onto convex sets, which use no
// triangles.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "engine/random_mechanism.hpp"
#include "hinge/core/error.hpp"
#include "hinge/robotics/collision_matrix.hpp"
#include "hinge/robotics/environment.hpp"
#include "hinge/robotics/path_checker.hpp"
#include "hinge/robotics/robot_checker.hpp"
#include "hinge/robotics/tessellate.hpp"
#include "hinge/robotics/tiers.hpp"

namespace hinge::robotics {
namespace solids_test {

constexpr std::uint64_t seed = 8489;
using test::Random;

/// Returns the point of the solid nearest to x, in the solid's frame.
struct Nearest {
  Vec3 x;
  Vec3 operator()(const BoxShape& box) const { return x.cwiseMax(-box.size / 2).cwiseMin(box.size / 2); }
  Vec3 operator()(const SphereShape& ball) const {
    return x.norm() <= ball.radius ? x : Vec3(x.normalized() * ball.radius);
  }
  Vec3 operator()(const CylinderShape& c) const {
    Vec3 y = x;
    const double r = std::hypot(x[0], x[1]);
    if (r > c.radius) y.head<2>() *= c.radius / r;
    y[2] = std::clamp(x[2], -c.length / 2, c.length / 2);
    return y;
  }
  Vec3 operator()(const CapsuleShape& c) const {
    const Vec3 middle(0, 0, std::clamp(x[2], -c.length / 2, c.length / 2)), way = x - middle;
    return way.norm() <= c.radius ? x : Vec3(middle + way.normalized() * c.radius);
  }
  Vec3 operator()(const MeshShape&) const { return x; }
  Vec3 operator()(const PointCloudShape&) const { return x; }
};

/// Returns the distance of two convex solids by alternating projections; 0 if they overlap.
double distance_of_solids(const Shape& a, const Pose& at_a, const Shape& b, const Pose& at_b) {
  Vec3 x = at_a.translation, y = x;
  for (int k = 0; k < 3000; ++k) {
    y = at_b * std::visit(Nearest{at_b.inverse() * x}, b);
    const Vec3 next = at_a * std::visit(Nearest{at_a.inverse() * y}, a);
    if ((next - y).norm() < 1e-12) return 0.0;
    const bool stays = (next - x).norm() < 1e-14;
    x = next;
    if (stays) break;
  }
  return (x - y).norm();
}

Shape random_solid(Random& random, std::size_t kind) {
  const auto size = [&] { return random.one_in(3) ? random.uniform(0.02, 0.1) : random.uniform(0.1, 1.0); };
  if (kind == 0) return BoxShape{{size(), size(), size()}};
  if (kind == 1) return SphereShape{size() / 2};
  if (kind == 2) return CylinderShape{size() / 2, size()};
  return CapsuleShape{size() / 2, size()};
}

/// A robot with shape `a` on the root and shape `b` at pose `at_b` on a link behind two joints.
std::shared_ptr<const Robot> pair_of(const Shape& a, const Shape& b, const Pose& at_b, double reach = 1.0) {
  RobotDescription robot{"pair", {{"a", {{a}}}, {"between"}, {"b", {{b}}}}, {}};
  JointDescription turn{"turn", JointType::continuous, "a", "between"};
  turn.axis = Vec3::UnitZ();
  JointDescription slide{"slide", JointType::prismatic, "between", "b", at_b};
  slide.lower = -reach;
  slide.upper = reach;
  robot.joints = {turn, slide};
  return std::make_shared<const Robot>(robot);
}

RobotChecker checker_of(const std::shared_ptr<const Robot>& robot, const std::string& engine = "simd",
                        double clearance = 0.0) {
  return {robot, tested_pairs(*robot), LinkMargins(*robot, clearance), {engine}};
}

Pose at(double x, double y = 0.0, double z = 0.0) { return {Mat3::Identity(), Vec3(x, y, z)}; }

std::shared_ptr<const TriangleMesh> mesh_of(const Shape& shape) {
  return std::make_shared<const TriangleMesh>(
      TriangleMesh{tessellate(shape, {Tessellation::Manner::circumscribed}).triangles});
}

TEST(Solids, CollideWhenTheyShareAPoint) {
  SCOPED_TRACE(seed);
  Random random(seed);
  constexpr double tolerance = 2.5e-3;  // cylinders are enclosed to 1 mm each
  std::size_t free = 0, surfaces = 0, inside = 0;
  for (std::size_t k = 0; k < 1600; ++k) {
    SCOPED_TRACE(k);
    const Shape a = random_solid(random, k % 4), b = random_solid(random, k / 4 % 4);
    const Pose at_b = random.pose(random.one_in(2) ? 0.1 : 0.7);
    const double expected = distance_of_solids(a, {}, b, at_b);
    if (expected > 0.0 && expected < tolerance) continue;
    const auto robot = pair_of(a, b, at_b);
    const std::string engine = k % 3 == 0 ? "simd" : k % 3 == 1 ? "lazy" : "brute";
    RobotChecker checker = checker_of(robot, engine);
    const bool hit = expected == 0.0;
    ASSERT_EQ(checker.collides(), hit);
    ASSERT_EQ(checker.colliding_links().size(), hit ? 1U : 0U);
    const auto closest = checker.closest();
    ASSERT_TRUE(closest.has_value());
    ASSERT_EQ(closest->collides(), hit);
    ASSERT_NEAR(closest->distance, expected, tolerance);
    const auto near = checker.distances(10.0);
    ASSERT_EQ(near.size(), 1U);
    ASSERT_NEAR(near[0].distance, closest->distance, 1e-12);
    if (hit) {
      ASSERT_TRUE(closest->point1 == closest->point2);
      ASSERT_LT((closest->point1 - std::visit(Nearest{closest->point1}, a)).norm(), tolerance);
      const Vec3 in_b = at_b.inverse() * closest->point1;
      ASSERT_LT((in_b - std::visit(Nearest{in_b}, b)).norm(), tolerance);
      (checker.triangle_pairs().empty() ? inside : surfaces) += 1;
    } else {
      ++free;
    }

    // The same shapes as a link and a body, in both roles.
    const auto alone = pair_of(a, SphereShape{0.001}, at(100.0));
    RobotChecker one = checker_of(alone, engine);
    Environment environment(0.0, engine);
    const BodyId body = environment.add(b, at_b, "b");
    ASSERT_EQ(one.collides(environment), hit);
    ASSERT_EQ(one.collisions(environment).size(), hit ? 1U : 0U);
    const auto nearest = one.closest(environment);
    ASSERT_EQ(nearest->collides(), hit);
    ASSERT_EQ(nearest->body, body);
    ASSERT_NEAR(nearest->distance, expected, tolerance);
    ASSERT_EQ(one.distances(environment, 10.0).size(), 1U);
    ASSERT_NEAR(one.distances(environment, 10.0)[0].distance, expected, tolerance);

    const auto other_robot = pair_of(b, SphereShape{0.001}, at(-100.0));
    RobotChecker other = checker_of(other_robot, engine);
    other.set_base(at_b);
    ASSERT_EQ(one.collides(other), hit);
    ASSERT_EQ(one.collisions(other).size(), hit ? 1U : 0U);
    ASSERT_EQ(other.closest(one)->collides(), hit);

    if (k % 4 != 0) continue;
    const std::vector<double> start(2, 0.0);
    PathChecker path(checker);
    ASSERT_EQ(path.certify(start, start).verdict, hit ? PathVerdict::colliding : PathVerdict::free);
    ASSERT_EQ(path.sample(start, start, 0.1).verdict, hit ? PathVerdict::colliding : PathVerdict::free);
    PathChecker among(one, environment);
    const auto verdict = among.certify(start, start).verdict;
    ASSERT_EQ(verdict, hit ? PathVerdict::colliding : PathVerdict::free);
  }
  EXPECT_GT(free, 40U);
  EXPECT_GT(surfaces, 40U);
  EXPECT_GT(inside, 40U);
}

TEST(Solids, HoldMeshesAndTheirPartsButHollowMeshesHoldNothing) {
  auto two = std::make_shared<TriangleMesh>(*mesh_of(BoxShape{Vec3::Constant(0.1)}));
  const auto one = *two;
  for (const Triangle& t : one.triangles) two->triangles.push_back(t.placed(at(5.0)));
  const MeshShape parts{two}, room{mesh_of(BoxShape{Vec3::Ones()})};
  MeshShape solid_room = room;
  solid_room.solid = true;
  for (const double x : {0.0, -5.0}) {  // the first component inside, then the second
    EXPECT_TRUE(checker_of(pair_of(BoxShape{}, parts, at(x))).collides());
    EXPECT_TRUE(checker_of(pair_of(parts, BoxShape{}, at(-x))).collides());
    EXPECT_TRUE(checker_of(pair_of(solid_room, parts, at(x))).collides());
    EXPECT_FALSE(checker_of(pair_of(room, parts, at(x))).collides());
  }
  EXPECT_FALSE(checker_of(pair_of(BoxShape{}, parts, at(-2.5))).collides());
  EXPECT_TRUE(checker_of(pair_of(CylinderShape{0.5, 1.0}, parts, {})).collides());
  auto open = std::make_shared<TriangleMesh>(*room.mesh);
  open->triangles.pop_back();
  MeshShape solid_open{open};
  solid_open.solid = true;
  EXPECT_THROW(pair_of(solid_open, parts, {}), ModelError);
}

/// There is no tolerance: the last bit of a double decides.
TEST(Solids, EndExactlyAtTheirSurface) {
  const Shape point = SphereShape{0x1p-60};
  EXPECT_TRUE(checker_of(pair_of(BoxShape{}, point, at(std::nextafter(0.5, 0.0)))).collides());
  EXPECT_FALSE(checker_of(pair_of(BoxShape{}, point, at(0.5 + 0x1p-50))).collides());
  EXPECT_TRUE(checker_of(pair_of(BoxShape{Vec3::Constant(2.0)}, BoxShape{}, at(0.5))).collides()) << "faces touch";
}

TEST(Solids, AreFoundFarFromTheOrigin) {
  const auto robot = pair_of(BoxShape{}, SphereShape{0.1}, {});
  for (const double far : {1e3, 1e6, 1e9, 1e12}) {
    RobotChecker checker = checker_of(robot);
    checker.set_base(at(far, -far, far));
    EXPECT_TRUE(checker.collides()) << far;
  }
}

TEST(Solids, AreSolidOnCertifiedPaths) {
  const std::vector<double> from{0.0, -0.5}, to{0.5, 0.5};
  const auto verdict = [&](const Shape& outer, const Pose& pose) {
    RobotChecker checker = checker_of(pair_of(outer, SphereShape{0.1}, pose, 10.0));
    PathChecker path(checker);
    const RobotPathAnswer answer = path.certify(from, to);
    EXPECT_EQ(answer.verdict, path.sample(from, to, 0.01).verdict);
    if (answer.verdict == PathVerdict::colliding) {
      EXPECT_TRUE(answer.contact.has_value());
      checker.update(answer.configuration);
      EXPECT_TRUE(checker.collides());
    }
    return answer.verdict;
  };
  // Start and end are inside: no surface is crossed on the way.
  EXPECT_EQ(verdict(BoxShape{Vec3::Constant(4.0)}, {}), PathVerdict::colliding);
  EXPECT_EQ(verdict(CylinderShape{3.0, 4.0}, {}), PathVerdict::colliding);
  EXPECT_EQ(verdict(MeshShape{mesh_of(BoxShape{Vec3::Constant(4.0)})}, {}), PathVerdict::free);
  EXPECT_EQ(verdict(BoxShape{Vec3::Constant(4.0)}, at(0, 0, 3.0)), PathVerdict::free);
}

TEST(Solids, AreSolidToTheCollisionMatrix) {
  MatrixOptions options;
  options.samples = 200;
  const auto kind = [&](const Shape& outer, const Pose& pose, double reach) {
    const CollisionMatrix matrix = find_collision_matrix(*pair_of(outer, SphereShape{0.1}, pose, reach), options);
    EXPECT_EQ(matrix.entries.size(), 1U);
    return matrix.entries.at(0).kind;
  };
  EXPECT_EQ(kind(BoxShape{Vec3::Constant(4.0)}, {}, 1.0), PairKind::always);
  EXPECT_EQ(kind(MeshShape{mesh_of(BoxShape{Vec3::Constant(4.0)})}, {}, 1.0), PairKind::never);
  EXPECT_EQ(kind(BoxShape{Vec3::Constant(4.0)}, {}, 9.0), PairKind::in_default);
  EXPECT_EQ(kind(BoxShape{Vec3::Constant(4.0)}, at(0, 0, 3.0), 1.0), PairKind::never);
}

TEST(Solids, StaySolidInTiersThatAreSolid) {
  const RobotDescription description = pair_of(BoxShape{}, SphereShape{0.1}, {})->description();
  for (const Tier tier : {Tier::mesh, Tier::hull, Tier::capsule}) {
    const auto robot = std::make_shared<const Robot>(with_tiers(description, Tiers{tier}));
    EXPECT_TRUE(checker_of(robot).collides()) << name(tier);
  }
}

TEST(Solids, DistancesKeepTheirDigitsBehindALongSlide) {
  const auto behind = [](double offset) {
    RobotDescription robot{"rail", {{"ground"}, {"cart"}, {"a", {{BoxShape{}}}}, {"m"}, {"b", {{BoxShape{}}}}}, {}};
    const auto joint = [&](const char* name, JointType type, const char* parent, const char* child,
                           const Pose& origin) {
      JointDescription made{name, type, parent, child, origin};
      made.axis = Vec3(0.48, 0.6, 0.64);
      made.lower = -1e7;
      made.upper = 1e7;
      robot.joints.push_back(made);
    };
    joint("rail", JointType::prismatic, "ground", "cart", {});
    joint("turn", JointType::revolute, "cart", "a", at(0.1, 0.2, 0.3));
    joint("elbow", JointType::revolute, "a", "m", at(1.0 / 3.0, 2.0, 0.1));
    joint("wrist", JointType::revolute, "m", "b", at(0.7, 1.1, 0.9));
    RobotChecker checker = checker_of(std::make_shared<const Robot>(robot));
    checker.update(std::vector<double>{offset, 0.3, 0.7, -0.4});
    const std::vector<ClosestLinks> listed = checker.distances(3.0);
    EXPECT_EQ(listed.size(), 1U);
    EXPECT_EQ(listed.at(0).distance, checker.closest()->distance);
    EXPECT_TRUE(listed.at(0).point2 == checker.closest()->point2);
    return *checker.closest();
  };
  const ClosestLinks near = behind(0.0), far = behind(1e6);
  EXPECT_GT(near.distance, 0.1);
  EXPECT_NEAR(far.distance, near.distance, 4e-15);
  EXPECT_NEAR(far.gap, near.gap, 4e-15);
  EXPECT_NEAR((far.point2 - far.point1).norm(), far.distance, 1e-8) << "points are those of the world";
}

TEST(EnvironmentBodies, ArePrimitivesThatLinksMayBeAllowedToTouch) {
  const auto robot = pair_of(BoxShape{}, SphereShape{0.1}, at(2.0));
  RobotChecker checker = checker_of(robot);
  Environment environment;
  const BodyId table = environment.add(BoxShape{{3.0, 3.0, 1.0}}, at(0, 0, -1.0), "table");
  EXPECT_EQ(environment.name(table), "table");
  EXPECT_EQ(checker.collisions(environment).size(), 1U);
  environment.allow(table, robot, {*robot->find_link("a")});
  EXPECT_TRUE(checker.collisions(environment).empty());
  EXPECT_FALSE(checker.collides(environment));
  EXPECT_EQ(robot->link_name(checker.closest(environment)->link), "b");
  const std::vector<double> still(2, 0.0);
  EXPECT_TRUE(PathChecker(checker, environment).certify(still, still).is_free());
  environment.set_pose(table, at(2.0));
  EXPECT_EQ(checker.collisions(environment).size(), 1U) << "the other link still counts";
  EXPECT_THROW(environment.allow(table, robot, {id<LinkId>(9)}), ModelError);
  EXPECT_THROW(environment.allow(table, nullptr, {}), ModelError);
  EXPECT_THROW(environment.add(SphereShape{-1.0}, {}, "bad"), ModelError);
  const BodyId ball = environment.add(SphereShape{0.25}, at(0, 0, 5.0), "ball");
  environment.set_pose(table, at(100.0));
  EXPECT_NEAR(checker.closest(environment)->distance, 5.0 - 0.25 - 0.5, 1e-12);
  EXPECT_EQ(checker.closest(environment)->body, ball);
}

/// Bodies so far away that squared lengths overflow.
TEST(EnvironmentBodies, HaveFiniteDistancesHoweverFar) {
  RobotChecker checker = checker_of(pair_of(BoxShape{}, SphereShape{0.1}, at(2.0)));
  Environment environment;
  for (const double x : {4e200, 1e200, 2e200}) environment.add(BoxShape{}, at(x), std::to_string(x));
  const auto closest = checker.closest(environment);
  ASSERT_TRUE(closest.has_value());
  EXPECT_NEAR(closest->distance / 1e200, 1.0, 1e-12);
  EXPECT_NEAR(closest->point2[0] / 1e200, 1.0, 1e-12);
  EXPECT_FALSE(checker.collides(environment));
}

}  // namespace solids_test
}  // namespace hinge::robotics
