// SPDX-License-Identifier: BSD-3-Clause
// Tests sphere models of robots: numbering, mimic joints, rejected shapes, verdicts of sixteen configurations at once.
#include "hinge/robotics/sphere_model.hpp"

#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <limits>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "hinge/batch/sphere_batch.hpp"
#include "hinge/core/error.hpp"
#include "hinge/core/philox.hpp"
#include "hinge/engine/brute.hpp"
#include "hinge/hierarchy.hpp"
#include "hinge/robotics/read_srdf.hpp"
#include "hinge/robotics/read_urdf.hpp"
#include "hinge/robotics/robot_checker.hpp"
#include "hinge/robotics/tested_pairs.hpp"

namespace hinge::robotics {
namespace sphere_model_test {

/// Three links in a column. The top joint rotates twice as far as the middle joint.
RobotDescription three_links() {
  RobotDescription robot{"three", {{"top"}, {"base"}, {"middle"}}, {}};
  for (LinkDescription& link : robot.links)
    for (const double z : {0.1, 0.3}) link.geometry.push_back({SphereShape{0.1}, {Mat3::Identity(), {0, 0, z}}});
  const Pose above{Mat3::Identity(), {0, 0, 0.4}};
  robot.joints = {{"second", JointType::revolute, "middle", "top", above, Vec3::UnitX(), -6, 6, Mimic{"first", 2.0}},
                  {"first", JointType::revolute, "base", "middle", above, Vec3::UnitX(), -3, 3}};
  return robot;
}

TEST(SphereModel, NumbersLinksAndSpheresAsTheRobotDoes) {
  const Robot robot(three_links());
  const Model<Sphere> model = spheres_of(robot);
  ASSERT_EQ(model.size(), robot.model().size());
  EXPECT_EQ(model.tree().link_count(), robot.model().tree().link_count());
  for (std::size_t k = 0; k < model.size(); ++k) {
    EXPECT_EQ(model.links()[k], robot.model().links()[k]);
    EXPECT_EQ(model.primitives()[k].center, robot.model().primitives()[k].a);
    EXPECT_EQ(model.primitives()[k].radius, robot.radii()[k]);
  }
}

TEST(SphereModel, FollowersFollowInBatches) {
  const Robot robot(three_links());
  SphereBatch batch(spheres_of(robot), LinkPairFilter(robot, tested_pairs(robot)));
  std::vector<double> block;
  for (const double angle : {0.0, 1.0, 1.3}) {
    const auto full = robot.expand({{angle}});
    block.insert(block.end(), full.begin(), full.end());
  }
  // At 1.3 rad the top link is tilted by 3 * 1.3 rad: one of its balls is 0.18 m from a ball of the base.
  EXPECT_EQ(batch.each(block), 0b100U);
}

TEST(SphereModel, RefusesOtherShapesNamingTheLink) {
  RobotDescription description = three_links();
  description.links[2].geometry.push_back({BoxShape{}});
  try {
    spheres_of(Robot(description));
    FAIL() << "a box was accepted";
  } catch (const ModelError& error) {
    EXPECT_NE(std::string(error.what()).find("'middle'"), std::string::npos) << error.what();
  }
}

TEST(SphereModel, BatchesOfPandaAgreeWithSingleQueries) {
  const auto folder = std::filesystem::path(HINGE_SHARED_DATA) / "robots" / "panda";
  const auto urdf = folder / "panda_spherized.urdf";
  if (!std::filesystem::exists(urdf)) GTEST_SKIP() << urdf << " is not there";
  const Robot robot(read_urdf(urdf));
  const LinkPairFilter filter(robot, tested_pairs(robot, read_srdf(folder / "panda.srdf", robot).disabled));
  SphereBatch batch(spheres_of(robot), filter);
  EXPECT_EQ(spheres_of(robot).size(), 59U);
  EXPECT_EQ(batch.pair_count(), 690U);
  Hierarchy<Sphere, LinkPairFilter, UniformClearance, Brute> single(spheres_of(robot), filter, UniformClearance{0.0});
  SampleStream stream(7, 1);
  std::size_t hits = 0;
  for (int b = 0; b < 250; ++b) {
    std::vector<double> block;
    for (std::size_t k = 0; k < SphereBatch::size * batch.dof_count(); ++k) {
      const std::size_t d = k % batch.dof_count();
      block.push_back(robot.lower()[d] + (robot.upper()[d] - robot.lower()[d]) * stream.uniform());
    }
    detail::simd::Bits expected = 0;
    for (std::size_t k = 0; k < SphereBatch::size; ++k) {
      single.update(std::span(block).subspan(k * batch.dof_count(), batch.dof_count()));
      if (single.self_collides()) expected |= detail::simd::Bits{1} << k;
    }
    ASSERT_EQ(batch.each(block), expected) << "block " << b;
    ASSERT_EQ(batch.any(block), expected != 0) << "block " << b;
    hits += static_cast<std::size_t>(std::popcount(expected));
  }
  EXPECT_GT(hits, 200U);
}

/// A chain of links with spheres of many sizes, some of which touch exactly at q = 0; one joint follows another one.
RobotDescription chain_of_spheres(bool with_box) {
  RobotDescription robot{"chain", {}, {}};
  for (int l = 0; l < 7; ++l) {
    LinkDescription link{"link" + std::to_string(l)};
    for (int k = 0; k < 3; ++k)
      link.geometry.push_back(
          {SphereShape{0.0625 + 0.03125 * ((l + k) % 2)}, Pose{Mat3::Identity(), Vec3(0.125 * k, 0, 0)}});
    if (with_box && l == 3) link.geometry.push_back({BoxShape{{0.01, 0.01, 0.01}}});
    robot.links.push_back(std::move(link));
    if (l == 0) continue;
    JointDescription joint{"joint" + std::to_string(l), l % 3 == 0 ? JointType::prismatic : JointType::revolute,
                           "link" + std::to_string(l - 1), "link" + std::to_string(l)};
    joint.origin.translation = Vec3(0.3125, 0, 0);
    joint.axis = l % 2 == 0 ? Vec3::UnitZ() : Vec3::UnitY();
    joint.lower = -2.5;
    joint.upper = 2.5;
    if (l == 5) joint.mimic = Mimic{"joint4", -1.0, 0.25};
    robot.joints.push_back(std::move(joint));
  }
  return robot;
}

TEST(CheckBatch, GivesTheVerdictsOfSingleChecks) {
  struct Case {
    const char* name;
    bool with_box;
    double clearance;
    const char* engine;
    bool moved_base;
  };
  for (const Case& c : {Case{"spheres", false, 0.0, "simd", false}, Case{"a box, too", true, 0.0, "simd", false},
                        Case{"a clearance", false, 0.01, "simd", false}, Case{"engine lazy", false, 0.0, "lazy", false},
                        Case{"a base", false, 0.0, "simd", true}}) {
    SCOPED_TRACE(c.name);
    const auto robot = std::make_shared<const Robot>(chain_of_spheres(c.with_box));
    EXPECT_EQ(has_only_spheres(*robot), !c.with_box);
    RobotChecker batch(robot, tested_pairs(*robot), LinkMargins(*robot, c.clearance), CheckOptions{c.engine});
    if (c.moved_base) batch.set_base(Pose{rotation_about(Vec3::UnitX(), 0.3), Vec3(1, 2, 3)});
    RobotChecker single = batch;
    const std::size_t n = robot->independent_joints().size();
    SampleStream stream(11, 2);
    std::vector<double> all;
    for (std::size_t k = 0; k < 1003 * n; ++k)
      // Multiples of 2^-4 give exact contacts between slides.
      all.push_back(k % 5 == 0 ? std::ldexp(std::floor(stream.uniform() * 80 - 40), -4) : 5 * stream.uniform() - 2.5);
    const std::vector<std::uint8_t> verdicts = batch.check_batch(all);
    ASSERT_EQ(verdicts.size(), 1003U);
    std::size_t hits = 0;
    for (std::size_t k = 0; k < verdicts.size(); ++k) {
      single.update(std::span(all).subspan(k * n, n));
      ASSERT_EQ(verdicts[k] != 0, single.collides()) << "configuration " << k;
      hits += verdicts[k];
    }
    EXPECT_GT(hits, 50U);
    EXPECT_LT(hits, 950U);
    EXPECT_EQ(batch.link_pose(id<LinkId>(5)), single.link_pose(id<LinkId>(5)));
    EXPECT_EQ(batch.check_batch(std::span(all).first(n)), std::vector<std::uint8_t>{verdicts[0]});
    EXPECT_TRUE(batch.check_batch({}).empty());
    all[20 * n + 1] = std::numeric_limits<double>::quiet_NaN();
    try {
      batch.check_batch(all);
      FAIL() << "NaN was accepted";
    } catch (const ConfigurationError& error) {
      EXPECT_EQ(std::string(error.what()).rfind("configuration 20: ", 0), 0U) << error.what();
    }
    EXPECT_THROW(batch.check_batch(std::span(all).first(n + 1)), ConfigurationError);
  }
}

}  // namespace sphere_model_test
}  // namespace hinge::robotics
