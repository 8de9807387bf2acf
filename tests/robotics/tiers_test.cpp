// SPDX-License-Identifier: BSD-3-Clause
// Tests that tiers miss no contact of the exact surfaces in any mix; rejected input; links that tiers do not change.
#include "hinge/robotics/tiers.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <iterator>
#include <limits>
#include <memory>
#include <set>
#include <span>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "hinge/core/error.hpp"
#include "hinge/hierarchy.hpp"
#include "hinge/kinematics/joint.hpp"
#include "hinge/query/link_pair_hits.hpp"
#include "hinge/robotics/link_margins.hpp"
#include "hinge/robotics/robot.hpp"
#include "hinge/robotics/tested_pairs.hpp"
#include "robotics/robots.hpp"
#include "robotics/tiered.hpp"

namespace hinge::robotics {
namespace tiers_test {

constexpr std::array<Tier, 4> every_tier = {Tier::mesh, Tier::hull, Tier::capsule, Tier::spheres};

using LinkSet = std::set<std::pair<LinkId, LinkId>>;

/// A robot in a hierarchy; returns the link pairs that collide at a configuration.
class Asked {
 public:
  explicit Asked(const RobotDescription& description)
      : robot_(description),
        hierarchy_(robot_.model(), LinkPairFilter(robot_, tested_pairs(robot_)), LinkMargins(robot_)),
        hits_(robot_.model().links()) {}

  LinkSet meeting(const std::vector<double>& q) {
    hierarchy_.update(robot_.expand(q));
    hits_.clear();
    hierarchy_.self_query(hits_);
    const auto links = robot_.model().links();
    LinkSet pairs;
    for (const Hit& hit : hits_.hits()) pairs.insert(std::minmax(links[index(hit.first)], links[index(hit.second)]));
    return pairs;
  }

  const Robot& robot() const { return robot_; }
  std::span<const Triangle> placed() { return hierarchy_.placed(); }

 private:
  Robot robot_;
  Hierarchy<Triangle, LinkPairFilter, LinkMargins> hierarchy_;
  LinkPairHits hits_;
};

/// Returns a mesh with random size, holes and extra triangles.
Shape random_mesh(SampleStream& stream) {
  auto mesh = std::make_shared<TriangleMesh>();
  const auto triangles = tessellate(SphereShape{1.0}, {Tessellation::Manner::circumscribed, 0.2}).triangles;
  const Vec3 size = 0.25 * test::random_point(stream);
  for (const Triangle& t : triangles)
    if (stream.uniform() < 0.7)
      mesh->triangles.push_back({t.a.cwiseProduct(size), t.b.cwiseProduct(size), t.c.cwiseProduct(size)});
  for (int k = 0; k < 3; ++k)
    mesh->triangles.push_back({0.2 * test::random_point(stream), 0.2 * test::random_point(stream), Vec3::Zero()});
  return MeshShape{mesh};
}

Shape random_shape(SampleStream& stream) {
  const auto size = [&] { return 0.02 + 0.2 * stream.uniform(); };
  switch (static_cast<int>(5 * stream.uniform())) {
    case 0: return BoxShape{{size(), size(), size()}};
    case 1: return CylinderShape{size() / 2, size()};
    case 2: return CapsuleShape{size() / 2, size()};
    case 3: return SphereShape{size() / 2};
    default: return random_mesh(stream);
  }
}

/// Seven links in a chain with one to three shapes each.
RobotDescription random_chain(std::uint64_t seed) {
  SampleStream stream(seed, 0);
  RobotDescription robot;
  robot.name = "chain";
  for (int k = 0; k < 7; ++k) {
    LinkDescription& link = robot.links.emplace_back();
    link.name = "l" + std::to_string(k);
    for (int n = 0; n <= k % 3; ++n) {
      PlacedShape& placed = link.geometry.emplace_back();
      placed.shape = random_shape(stream);
      placed.origin.rotation = rotation_about(test::random_point(stream).normalized(), 6 * stream.uniform());
      placed.origin.translation = 0.1 * test::random_point(stream);
    }
    if (k == 0) continue;
    JointDescription& joint = robot.joints.emplace_back();
    joint.name = "j" + std::to_string(k);
    joint.type = JointType::continuous;
    joint.parent = "l" + std::to_string(k - 1);
    joint.child = link.name;
    joint.origin.translation = 0.25 * test::random_point(stream);
    joint.axis = test::random_point(stream);
  }
  return robot;
}

Tiers random_tiers(const RobotDescription& robot, std::uint64_t seed) {
  SampleStream stream(seed, 1);
  Tiers tiers;
  tiers.most_spheres = 1 + static_cast<std::size_t>(20 * stream.uniform());
  for (const LinkDescription& link : robot.links)
    tiers.links[link.name] = every_tier[static_cast<std::size_t>(4 * stream.uniform())];
  return tiers;
}

/// Returns whether all of link `inner` is strictly behind every triangle of the convex link `outer`.
bool wholly_inside(Asked& robot, LinkId outer, LinkId inner) {
  const auto placed = robot.placed();
  const auto links = robot.robot().model().links();
  const auto radii = robot.robot().radii();
  for (std::size_t i = 0; i < placed.size(); ++i) {
    if (links[i] != outer) continue;
    const Triangle& t = placed[i];
    const Vec3 normal = cross(Vec3(t.b - t.a), Vec3(t.c - t.a)).normalized();
    for (std::size_t j = 0; j < placed.size(); ++j) {
      if (links[j] != inner) continue;
      for (const Vec3& p : {placed[j].a, placed[j].b, placed[j].c})
        if (!(dot(normal, Vec3(p - t.a)) + (radii.empty() ? 0.0 : radii[j]) < 0.0)) return false;
    }
  }
  return true;
}

/// Counts the pairs that collide by their meshes, and those that their tiers miss because one is inside a hull.
struct Tally {
  int met = 0, inside_a_hull = 0;

  void count(Asked& tiered, const Tiers& tiers, const LinkSet& by_mesh, const LinkSet& by_tier) {
    for (const auto& [a, b] : by_mesh) {
      ++met;
      if (by_tier.contains({a, b})) continue;
      const auto is_hull = [&](LinkId link) { return tiers.links.at(tiered.robot().link_name(link)) == Tier::hull; };
      const bool excused = (is_hull(a) && wholly_inside(tiered, a, b)) || (is_hull(b) && wholly_inside(tiered, b, a));
      EXPECT_TRUE(excused) << tiered.robot().link_name(a) << " and " << tiered.robot().link_name(b);
      ++inside_a_hull;
    }
  }
};

TEST(Tiers, MissNoContactOfTheMeshesWhateverIsMixed) {
  Tally tally;
  int more = 0;
  for (std::uint64_t seed = 1; seed <= 12; ++seed) {
    const RobotDescription description = random_chain(seed);
    const Tiers tiers = random_tiers(description, seed);
    Asked exact(description), tiered(with_tiers(description, tiers));
    SampleStream stream(seed, 2);
    for (int k = 0; k < 100; ++k) {
      const std::vector<double> q = test::random_configuration(exact.robot(), stream);
      const LinkSet by_mesh = exact.meeting(q), by_tier = tiered.meeting(q);
      tally.count(tiered, tiers, by_mesh, by_tier);
      more += static_cast<int>(by_tier.size()) - static_cast<int>(by_mesh.size());
    }
  }
  std::printf("%d contacts, %d inside a hull; %d more by tiers\n", tally.met, tally.inside_a_hull, more);
  EXPECT_GT(tally.met, 1000);
  EXPECT_LT(tally.inside_a_hull, tally.met / 10);
  EXPECT_GT(more, 0);  // otherwise no tier was coarser than its mesh
}

/// Tests the configuration where meshes start to touch, found to the last bit of the path parameter.
TEST(Tiers, MissNoContactThatHasJustBegun) {
  Tally tally;
  for (std::uint64_t seed = 1; seed <= 12; ++seed) {
    const RobotDescription description = random_chain(seed);
    const Tiers tiers = random_tiers(description, seed);
    Asked exact(description), tiered(with_tiers(description, tiers));
    SampleStream stream(seed, 3);
    for (int k = 0; k < 6; ++k) {
      const std::vector<double> from = test::random_configuration(exact.robot(), stream),
                                to = test::random_configuration(exact.robot(), stream);
      const auto at = [&](double t) {
        std::vector<double> q = from;
        for (std::size_t d = 0; d < q.size(); ++d) q[d] += t * (to[d] - from[d]);
        return q;
      };
      const LinkSet before = exact.meeting(from), after = exact.meeting(to);
      LinkSet begun;
      std::set_difference(after.begin(), after.end(), before.begin(), before.end(), std::inserter(begun, begun.end()));
      if (begun.empty()) continue;
      double free = 0.0, hit = 1.0;
      for (double middle = 0.5; free < middle && middle < hit; middle = free + (hit - free) / 2)
        (exact.meeting(at(middle)).contains(*begun.begin()) ? hit : free) = middle;
      const LinkSet by_mesh = exact.meeting(at(hit));
      ASSERT_TRUE(by_mesh.contains(*begun.begin()));
      tally.count(tiered, tiers, by_mesh, tiered.meeting(at(hit)));
    }
  }
  EXPECT_GT(tally.met, 50);
}

RobotDescription two_bodies(const Shape& a, const Shape& b, const Vec3& apart) {
  RobotDescription robot;
  robot.name = "two";
  robot.links = {{"a", {{a}}}, {"between", {}}, {"b", {{b}}}};
  robot.joints.resize(2);
  robot.joints[0] = {"one", JointType::continuous, "a", "between", {}};
  robot.joints[1] = {"two", JointType::continuous, "between", "b", {Mat3::Identity(), apart}};
  return robot;
}

bool collides(const RobotDescription& robot) { return !Asked(robot).meeting({0.0, 0.0}).empty(); }

Tiers all(Tier tier) {
  Tiers tiers;
  tiers.all = tier;
  return tiers;
}

TEST(Tiers, HullsAreSurfacesCapsulesAndSpheresAreSolid) {
  const RobotDescription nested = two_bodies(BoxShape{{1, 1, 1}}, BoxShape{{0.1, 0.1, 0.1}}, Vec3::Zero());
  EXPECT_FALSE(collides(nested));
  EXPECT_FALSE(collides(with_tiers(nested, all(Tier::hull))));
  EXPECT_TRUE(collides(with_tiers(nested, all(Tier::capsule))));
  // Two walls, and a box that touches one from inside: surface contact that the hulls miss, as documented.
  auto walls = std::make_shared<TriangleMesh>();
  for (const double side : {-0.5, 0.5})
    for (Triangle t : tessellate(BoxShape{{0.1, 1, 1}}).triangles) {
      for (Vec3* v : {&t.a, &t.b, &t.c}) (*v)[0] += side;
      walls->triangles.push_back(t);
    }
  const RobotDescription rod = two_bodies(MeshShape{walls}, BoxShape{{0.1, 0.1, 0.1}}, Vec3(0.4, 0, 0));
  EXPECT_TRUE(collides(rod));
  EXPECT_FALSE(collides(with_tiers(rod, all(Tier::hull))));
  EXPECT_TRUE(collides(with_tiers(rod, all(Tier::capsule))));
  EXPECT_TRUE(collides(with_tiers(rod, all(Tier::spheres))));
}

TEST(Tiers, LeaveLoneSpheresAndCapsulesAndLinksWithoutGeometryAsTheyAre) {
  RobotDescription robot = two_bodies(SphereShape{0.3}, CapsuleShape{0.2, 1.0}, Vec3(1, 0, 0));
  for (const Tier tier : every_tier) {
    const RobotDescription tiered = with_tiers(robot, all(tier));
    EXPECT_EQ(std::get<SphereShape>(tiered.links[0].geometry.at(0).shape).radius, 0.3);
    EXPECT_TRUE(tiered.links[1].geometry.empty());
    EXPECT_EQ(std::get<CapsuleShape>(tiered.links[2].geometry.at(0).shape).length, 1.0);
  }
  robot.links[0].geometry.push_back({BoxShape{}});
  EXPECT_EQ(with_tiers(robot, all(Tier::hull)).links[0].geometry.size(), 1U);
  EXPECT_EQ(with_tiers(robot, all(Tier::capsule)).links[0].geometry.size(), 1U);
  EXPECT_EQ(with_tiers(robot, all(Tier::mesh)).links[0].geometry.size(), 2U);
}

TEST(Tiers, AreChosenLinkByLink) {
  Tiers tiers = all(Tier::capsule);
  tiers.links = {{"b", Tier::mesh}};
  const RobotDescription robot = with_tiers(two_bodies(BoxShape{{1, 1, 3}}, BoxShape{}, Vec3::Zero()), tiers);
  EXPECT_TRUE(std::holds_alternative<CapsuleShape>(robot.links[0].geometry.at(0).shape));
  EXPECT_TRUE(std::holds_alternative<BoxShape>(robot.links[2].geometry.at(0).shape));
}

TEST(Tiers, RefuseWhatTheyCannotDo) {
  const RobotDescription robot = two_bodies(BoxShape{}, BoxShape{}, Vec3::Zero());
  const auto refusal = [](const RobotDescription& description, const Tiers& tiers) -> std::string {
    try {
      with_tiers(description, tiers);
    } catch (const ModelError& error) {
      return error.what();
    }
    return "";
  };
  Tiers tiers = all(Tier::hull);
  tiers.links = {{"c", Tier::capsule}};
  EXPECT_EQ(refusal(robot, tiers), "tier 'capsule' is given for link 'c', which does not exist");
  tiers = all(Tier::spheres);
  tiers.most_spheres = 0;
  EXPECT_EQ(refusal(robot, tiers), "at most 0 spheres per link, expected at least 1");
  tiers = all(Tier::hull);
  tiers.tolerance = std::numeric_limits<double>::quiet_NaN();
  EXPECT_NE(refusal(robot, tiers).find("link 'a': tessellation tolerance nan"), std::string::npos);
  RobotDescription bad = robot;
  bad.links[2].geometry[0].shape = BoxShape{{1, -1, 1}};
  EXPECT_NE(refusal(bad, all(Tier::hull)).find("link 'b': box of size 1 -1 1"), std::string::npos);
}

TEST(Tiers, HaveNames) {
  for (const Tier tier : every_tier) EXPECT_EQ(tier_named(name(tier)), tier);
  EXPECT_THROW(tier_named("sphere"), ModelError);
  EXPECT_THROW(tier_named(""), ModelError);
}

}  // namespace tiers_test
}  // namespace hinge::robotics
