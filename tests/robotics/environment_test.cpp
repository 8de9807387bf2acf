// SPDX-License-Identifier: BSD-3-Clause
// Tests an environment of bodies that move, are removed, and are attached to links; against brute force.
#include "hinge/robotics/environment.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "extremes/refusal.hpp"
#include "hinge/core/error.hpp"
#include "hinge/robotics/robot_checker.hpp"
#include "hinge/robotics/tessellate.hpp"
#include "robotics/random_robot.hpp"
#include "robotics/robots.hpp"

namespace hinge::robotics {
namespace environment_test {

constexpr std::uint64_t seed = 90210;
using Key = std::tuple<std::optional<BodyId>, LinkId, BodyId>;

const double nan = std::numeric_limits<double>::quiet_NaN();

std::shared_ptr<const TriangleMesh> cube(double size) {
  return std::make_shared<const TriangleMesh>(TriangleMesh{tessellate(BoxShape{Vec3::Constant(size)}).triangles});
}

Pose at(double x, double y = 0.0, double z = 0.0) { return {Mat3::Identity(), Vec3(x, y, z)}; }

/// A unit cube that slides along x on a root without geometry. A hand is fixed to the cube at (0, 0, 2).
std::shared_ptr<const Robot> slider() {
  RobotDescription robot{"slider", {{"root"}, {"cube", {{BoxShape{}}}}, {"hand", {{BoxShape{}}}}}, {}};
  JointDescription slide{"slide", JointType::prismatic, "root", "cube"};
  robot.joints.push_back(slide);
  JointDescription mount{"mount", JointType::fixed, "cube", "hand"};
  mount.origin = at(0, 0, 2);
  robot.joints.push_back(mount);
  return std::make_shared<const Robot>(robot);
}

RobotChecker checker_of(const std::shared_ptr<const Robot>& robot, double clearance = 0.0,
                        const std::string& engine = "simd") {
  return {robot, tested_pairs(*robot), LinkMargins(*robot, clearance), {engine}};
}

std::set<Key> keys(const std::vector<BodyContact>& contacts) {
  std::set<Key> found;
  for (const BodyContact& contact : contacts)
    EXPECT_TRUE(found.emplace(contact.held, contact.link, contact.body).second);
  return found;
}

class EnvironmentOf : public testing::TestWithParam<std::string> {};
INSTANTIATE_TEST_SUITE_P(All, EnvironmentOf, testing::Values("simd", "lazy", "brute"),
                         [](const auto& engine) { return engine.param; });

/// The test's own record of a body in the environment.
struct Known {
  BodyId id{};
  std::shared_ptr<const TriangleMesh> mesh;
  Pose pose{};                        ///< in the world, or in the frame of `link` if attached
  std::optional<std::string> link{};  ///< the link that the body is attached to
};

/// Returns the smallest d - M of every tested pair of a link (or attached body) and a body; Eigen computes the poses.
std::vector<std::pair<Key, double>> gaps(const Robot& robot, const std::vector<double>& q,
                                         const std::vector<Known>& bodies, double m_links, double m_held) {
  std::map<std::string, double> values;
  for (std::size_t k = 0; k < q.size(); ++k) values[robot.independent_name(k)] = q[k];
  const auto frames = test::frames_of(robot.description(), values);
  const auto links = test::grown_triangles(robot, q);
  const RigidGroups groups(robot.model().tree(), DofSelection::all(robot.model().tree()));
  const auto group = [&](const std::string& link) { return groups.group_of(*robot.find_link(link)); };
  const auto placed = [&](const Known& body) {
    const auto x = body.link ? frames.at(*body.link) * test::isometry(body.pose) : test::isometry(body.pose);
    std::vector<test::Grown> list;
    for (const Triangle& t : body.mesh->triangles) list.push_back({test::moved(t, x), 0.0});
    return list;
  };
  std::vector<std::pair<Key, double>> found;
  for (const Known& body : bodies) {
    for (std::size_t l = 1; l < links.size(); ++l) {
      if (body.link && group(*body.link) == groups.group_of(id<LinkId>(l))) continue;
      found.push_back({{std::nullopt, id<LinkId>(l), body.id}, test::apart(links[l], placed(body)) - m_links});
    }
    for (const Known& held : bodies) {
      if (!held.link || held.id == body.id) continue;
      if (body.link && (body.id < held.id || group(*body.link) == group(*held.link))) continue;
      found.push_back(
          {{held.id, *robot.find_link(*held.link), body.id}, test::apart(placed(held), placed(body)) - m_held});
    }
  }
  return found;
}

TEST_P(EnvironmentOf, AgreesWithAllPairsOneByOneWhileBodiesMoveComeAndGo) {
  SCOPED_TRACE(seed);
  std::size_t colliding = 0, free = 0, held_hits = 0;
  for (std::uint64_t number = 0; number < 12; ++number) {
    SampleStream stream(seed, number);
    const auto robot = std::make_shared<const Robot>(test::random_description(stream, 6));
    const double mine = number % 3 == 0 ? 0.0 : 0.03, theirs = number % 2 == 0 ? 0.0 : 0.06, m = std::max(mine, theirs);
    RobotChecker checker = checker_of(robot, mine, GetParam());
    Environment environment(theirs, GetParam());
    std::vector<Known> bodies;
    const auto add = [&] {
      bodies.push_back({{}, test::random_mesh(stream, 4, 0.4), test::random_pose(stream, 1.2)});
      bodies.back().id = environment.add(bodies.back().mesh, bodies.back().pose, "thing");
    };
    for (int k = 0; k < 4; ++k) add();
    for (int c = 0; c < 8; ++c) {
      if (c == 2) {
        environment.remove(bodies[1].id);
        bodies.erase(bodies.begin() + 1);
      }
      if (c == 3) add();
      if (c == 4 || c == 5) {
        Known& held = bodies[static_cast<std::size_t>(c - 4)];
        held.pose = test::random_pose(stream, 0.3);
        held.link = c == 4 ? "link2" : "link5";
        environment.attach(held.id, robot, *robot->find_link(*held.link), held.pose);
      }
      if (c == 7) {
        bodies[0].pose = environment.pose(bodies[0].id);
        bodies[0].link.reset();
        environment.detach(bodies[0].id);
      }
      bodies.back().pose = test::random_pose(stream, 0.8);
      environment.set_pose(bodies.back().id, bodies.back().pose);
      const std::vector<double> q = test::random_configuration(*robot, stream);
      checker.update(q);
      std::set<Key> hits, near;
      double least = std::numeric_limits<double>::infinity();
      for (const auto& [key, gap] : gaps(*robot, q, bodies, m, theirs)) {
        const double threshold = std::get<0>(key) ? theirs : m;
        if (gap < 0.0 || (threshold == 0.0 && gap == 0.0)) hits.insert(key);
        if (gap < 0.1) near.insert(key);
        least = std::min(least, gap);
      }
      EXPECT_EQ(checker.collides(environment), !hits.empty());
      // Calibrating the order of the pairs must not change later answers.
      if (number % 2 == 0) checker.calibrate_pair_order(environment);
      EXPECT_EQ(keys(checker.collisions(environment)), hits);
      EXPECT_EQ(keys(checker.within(environment, 0.1)), near);
      const auto closest = checker.closest(environment);
      ASSERT_TRUE(closest.has_value());
      EXPECT_NEAR(closest->gap, least, 1e-12);
      EXPECT_EQ(closest->collides(), !hits.empty());
      EXPECT_NEAR(std::sqrt(squared_norm(Vec3(closest->point1 - closest->point2))), closest->distance, 1e-12);
      EXPECT_NEAR(closest->distance, std::max(0.0, least + (closest->held ? theirs : m)), 1e-12);
      (hits.empty() ? free : colliding)++;
      for (const Key& key : hits) held_hits += std::get<0>(key) ? 1U : 0U;
    }
  }
  EXPECT_GT(colliding, 15U);
  EXPECT_GT(free, 15U);
  EXPECT_GT(held_hits, 1U);
}

TEST_P(EnvironmentOf, MovesHeldBodiesWithTheirLink) {
  const auto robot = slider();
  RobotChecker checker = checker_of(robot, 0.0, GetParam());
  Environment environment(0.0, GetParam());
  const BodyId tool = environment.add(cube(0.5), at(50), "tool"), wall = environment.add(cube(1.0), at(10), "wall");
  environment.attach(tool, robot, *robot->find_link("hand"), at(1, 0, -2));
  EXPECT_EQ(environment.attached_to(tool), robot->find_link("hand"));
  // The tool overlaps the cube, which is in the rigid group of the hand, and touches nothing more.
  EXPECT_FALSE(checker.collides(environment));
  EXPECT_EQ(environment.pose(tool).translation, Vec3(1, 0, 0));
  checker.update(std::vector<double>{8.5});
  const auto contacts = checker.collisions(environment);
  ASSERT_EQ(contacts.size(), 1U);
  EXPECT_EQ(contacts[0].held, tool);
  EXPECT_EQ(contacts[0].body, wall);
  EXPECT_EQ(contacts[0].link, *robot->find_link("hand"));
  checker.update(std::vector<double>{7.0});
  const auto closest = checker.closest(environment);
  EXPECT_EQ(closest->held, tool);
  EXPECT_EQ(closest->distance, 1.25);
  EXPECT_EQ(closest->point1[0], 8.25);
  EXPECT_EQ(closest->point2[0], 9.5);
  // After detaching, the tool stays where it is, and the cube collides with it.
  environment.detach(tool);
  EXPECT_FALSE(environment.attached_to(tool).has_value());
  checker.update(std::vector<double>{7.5});
  const auto after = checker.collisions(environment);
  ASSERT_EQ(after.size(), 1U);
  EXPECT_FALSE(after[0].held.has_value());
  EXPECT_EQ(after[0].link, *robot->find_link("cube"));
  EXPECT_EQ(environment.pose(tool).translation, Vec3(8, 0, 0));
}

TEST(Environment, LetsHeldBodiesTouchTheLinksNamedAlone) {
  const auto robot = slider();
  const LinkId hand = *robot->find_link("hand"), body = *robot->find_link("cube");
  RobotChecker checker = checker_of(robot);
  Environment environment;
  const BodyId rod = environment.add(cube(2.0), at(0, 0, 1), "rod");  // collides with hand and cube
  EXPECT_EQ(keys(checker.collisions(environment)), (std::set<Key>{{{}, body, rod}, {{}, hand, rod}}));
  environment.attach(rod, robot, hand, at(0, 0, -1));
  EXPECT_TRUE(checker.collisions(environment).empty());
  environment.attach(rod, robot, hand, at(0, 0, -1), std::vector<LinkId>{hand});
  EXPECT_EQ(keys(checker.collisions(environment)), (std::set<Key>{{{}, body, rod}}));
  environment.attach(rod, robot, hand, at(0, 0, -1), std::vector<LinkId>{});
  EXPECT_EQ(checker.collisions(environment).size(), 2U);
}

TEST(Environment, LeavesBodiesHeldByAnotherRobotWhereTheyAre) {
  const auto robot = slider(), other = slider();
  RobotChecker checker = checker_of(robot), holder = checker_of(other);
  Environment environment;
  const BodyId tool = environment.add(cube(0.5), at(50));
  environment.attach(tool, other, *other->find_link("cube"), at(0, 3, 0));
  EXPECT_FALSE(holder.collides(environment));
  EXPECT_EQ(environment.pose(tool).translation, Vec3(0, 3, 0));
  EXPECT_EQ(checker.closest(environment)->distance, 2.25);
  holder.update(std::vector<double>{4.0});
  holder.collides(environment);
  EXPECT_EQ(environment.pose(tool).translation, Vec3(4, 3, 0));
}

TEST(Environment, CopiesMoveForThemselvesAndShareMeshes) {
  const auto robot = slider();
  RobotChecker checker = checker_of(robot);
  Environment first;
  const auto mesh = cube(1.0);
  const BodyId body = first.add(mesh, at(10));
  Environment second = first;
  EXPECT_EQ(mesh.use_count(), 2);
  second.set_pose(body, at(0.5));
  EXPECT_TRUE(checker.collides(second));
  EXPECT_FALSE(checker.collides(first));
  second.remove(body);
  EXPECT_EQ(first.size(), 1U);
  EXPECT_EQ(second.size(), 0U);
  EXPECT_FALSE(checker.closest(second).has_value());
}

TEST(Environment, TouchesAtDistanceZero) {
  RobotChecker checker = checker_of(slider());
  Environment environment;
  const BodyId body = environment.add(cube(1.0), at(1));
  EXPECT_TRUE(checker.collides(environment));
  EXPECT_EQ(checker.closest(environment)->distance, 0.0);
  environment.set_pose(body, at(std::nextafter(1.0, 2.0)));
  EXPECT_FALSE(checker.collides(environment));
  EXPECT_EQ(checker.closest(environment)->distance, std::numeric_limits<double>::epsilon());
}

TEST(Environment, NeverGivesABodyIdTwice) {
  Environment environment;
  const BodyId first = environment.add(cube(1.0)), second = environment.add(cube(1.0), at(5), "box");
  environment.remove(second);
  const BodyId third = environment.add(cube(1.0));
  EXPECT_NE(third, second);
  EXPECT_EQ(environment.bodies(), (std::vector<BodyId>{first, third}));
  EXPECT_EQ(environment.triangle_count(third), 12U);
  EXPECT_EQ(hinge::test::refusal<Error>([&] { environment.remove(second); }),
            "body 1 was removed from the environment");
  EXPECT_EQ(hinge::test::refusal<Error>([&] { environment.set_pose(BodyId{7}, Pose{}); }),
            "body 7 was never added to the environment");
  EXPECT_EQ(hinge::test::refusal<Error>([&] { static_cast<void>(environment.pose(second)); }),
            "body 1 was removed from the environment");
  EXPECT_EQ(hinge::test::refusal<Error>([&] { environment.detach(second); }),
            "body 1 was removed from the environment");
}

TEST(Environment, RefusesMeshesAndPosesNamingTheBody) {
  Environment environment;
  TriangleMesh mesh = *cube(1.0);
  const auto add = [&](const TriangleMesh& bad, const Pose& pose) {
    return hinge::test::refusal<Error>(
        [&] { environment.add(std::make_shared<const TriangleMesh>(bad), pose, "table"); });
  };
  EXPECT_EQ(add({}, Pose{}), "body 0 'table': mesh: has no triangles");
  EXPECT_EQ(hinge::test::refusal<Error>([&] { environment.add(nullptr); }), "body 0: mesh: has no triangles");
  Pose bent;
  bent.rotation(0, 0) = 1.1;
  EXPECT_EQ(add(mesh, bent), "body 0 'table': its pose is not a rigid placement (finite, R R^T = 1, det 1)");
  mesh.triangles[3].b[1] = nan;
  EXPECT_EQ(add(mesh, Pose{}),
            "body 0 'table': mesh: triangle 3 has a vertex that is not finite, expected finite coordinates");
  EXPECT_EQ(environment.size(), 0U);
  const BodyId body = environment.add(cube(1.0), at(3), "table");
  EXPECT_EQ(hinge::test::refusal<Error>([&] { environment.set_pose(body, bent); }),
            "body 0 'table': its pose is not a rigid placement (finite, R R^T = 1, det 1)");
  EXPECT_THROW(environment.set_pose(body, at(nan)), ConfigurationError);
  EXPECT_EQ(environment.pose(body), at(3));
}

TEST(Environment, RefusesLinksThatAreNone) {
  const auto robot = slider();
  Environment environment;
  const BodyId body = environment.add(cube(1.0), at(3), "tool");
  EXPECT_EQ(hinge::test::refusal<Error>([&] { environment.attach(body, robot, id<LinkId>(4), Pose{}); }),
            "body 0 'tool': attached to link 4, but robot 'slider' has links 1 to 3");
  EXPECT_NE(hinge::test::refusal<Error>([&] { environment.attach(body, robot, world, Pose{}); }), "");
  EXPECT_EQ(hinge::test::refusal<Error>(
                [&] { environment.attach(body, robot, id<LinkId>(2), Pose{}, std::vector<LinkId>{id<LinkId>(9)}); }),
            "body 0 'tool': may touch link 9, but robot 'slider' has links 1 to 3");
  EXPECT_NE(hinge::test::refusal<Error>([&] { environment.attach(body, nullptr, id<LinkId>(1), Pose{}); }), "");
  EXPECT_THROW(environment.attach(body, robot, id<LinkId>(2), at(nan)), ConfigurationError);
  EXPECT_FALSE(environment.attached_to(body).has_value());
  environment.attach(body, robot, *robot->find_link("hand"), Pose{});
  EXPECT_EQ(hinge::test::refusal<Error>([&] { environment.set_pose(body, Pose{}); }),
            "body 0 'tool' is attached to link 'hand' of robot 'slider', expected a detached body");
}

TEST(Environment, RefusesClearancesEnginesAndMargins) {
  EXPECT_THROW(Environment(-1.0), ModelError);
  EXPECT_THROW(Environment{nan}, ModelError);
  EXPECT_THROW(Environment(0.0, "fast"), ModelError);
  Environment lazy(0.0, "lazy");
  RobotChecker checker = checker_of(slider());
  EXPECT_EQ(hinge::test::refusal<Error>([&] { checker.collides(lazy); }),
            "the environment uses engine 'lazy', the robot uses engine 'simd', expected one engine for both");
  Environment environment;
  EXPECT_THROW(checker.within(environment, nan), ConfigurationError);
}

TEST(Containment, OfLinksAndBodiesIsReportedBothWays) {
  const auto robot = slider();
  const LinkId body = *robot->find_link("cube"), hand = *robot->find_link("hand");
  for (const std::string engine : {"simd", "lazy", "brute"}) {
    RobotChecker checker = checker_of(robot, 0.0, engine);
    Environment environment(0.0, engine);
    const BodyId room = environment.add(cube(20.0)), speck = environment.add(cube(0.25), at(0.125));
    // The speck is in a box, which is solid. The room is a mesh, which is hollow.
    ASSERT_EQ(checker.collisions(environment).size(), 1U);
    EXPECT_EQ(checker.collisions(environment)[0].link, body);
    EXPECT_EQ(checker.collisions(environment)[0].body, speck);
    const auto found = checker.contained(environment);
    ASSERT_EQ(found.size(), 3U);
    const auto is = [](const BodyContainment& c, LinkId link, BodyId other, bool body_is_outer) {
      return c.link == link && c.body == other && c.body_is_outer == body_is_outer && c.whole && !c.held;
    };
    EXPECT_TRUE(is(found[0], body, room, true));
    EXPECT_TRUE(is(found[1], body, speck, false));
    EXPECT_TRUE(is(found[2], hand, room, true));
    environment.attach(speck, robot, hand, at(3));
    const auto held = checker.contained(environment);
    ASSERT_EQ(held.size(), 3U);
    EXPECT_EQ(held[2].held, speck);
    EXPECT_EQ(held[2].body, room);
    EXPECT_TRUE(held[2].body_is_outer);
    // At 10 the cube crosses the wall of the room, which is a collision; at 30 it is outside, which is neither.
    checker.update(std::vector<double>{10.0});
    EXPECT_TRUE(checker.collides(environment));
    checker.update(std::vector<double>{30.0});
    EXPECT_TRUE(checker.contained(environment).empty());
  }
}

TEST(Containment, IsNotLookedForInOpenBodies) {
  auto open = std::make_shared<TriangleMesh>(*cube(20.0));
  open->triangles.pop_back();
  RobotChecker checker = checker_of(slider());
  Environment environment;
  const BodyId room = environment.add(open);
  EXPECT_TRUE(environment.open_edge(room).has_value());
  EXPECT_TRUE(checker.contained(environment).empty());
  EXPECT_FALSE(environment.open_edge(environment.add(cube(1.0))).has_value());
}

}  // namespace environment_test
}  // namespace hinge::robotics
