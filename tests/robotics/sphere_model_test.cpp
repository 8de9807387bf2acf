// SPDX-License-Identifier: BSD-3-Clause
// Tests sphere models of robots: numbering, mimic joints, rejected shapes, verdicts of sixteen configurations at once.
#include "hinge/robotics/sphere_model.hpp"

#include <gtest/gtest.h>

#include <bit>
#include <cstddef>
#include <filesystem>
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

}  // namespace sphere_model_test
}  // namespace hinge::robotics
