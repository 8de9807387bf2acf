// SPDX-License-Identifier: BSD-3-Clause
// Tests link poses of the shared robots against Orocos KDL, whose tree is built from urdfdom's parse of the same file.
#include <gtest/gtest.h>
#include <urdf_model/joint.h>
#include <urdf_model/link.h>
#include <urdf_model/model.h>
#include <urdf_parser/urdf_parser.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <kdl/chain.hpp>
#include <kdl/chainfksolverpos_recursive.hpp>
#include <kdl/frames.hpp>
#include <kdl/jntarray.hpp>
#include <kdl/tree.hpp>
#include <map>
#include <string>
#include <vector>

#include "hinge/hierarchy.hpp"
#include "hinge/policy/distance_matrix.hpp"
#include "hinge/policy/pair_filter.hpp"
#include "robotics/robots.hpp"

namespace hinge::robotics {
namespace forward_kinematics_test {

KDL::Frame frame(const urdf::Pose& pose) {
  const urdf::Rotation& r = pose.rotation;
  return {KDL::Rotation::Quaternion(r.x, r.y, r.z, r.w),
          KDL::Vector(pose.position.x, pose.position.y, pose.position.z)};
}

KDL::Joint joint(const urdf::Joint& from) {
  const KDL::Frame origin = frame(from.parent_to_joint_origin_transform);
  const KDL::Vector axis = origin.M * KDL::Vector(from.axis.x, from.axis.y, from.axis.z);
  if (from.type == urdf::Joint::FIXED) return KDL::Joint(from.name, KDL::Joint::Fixed);
  return KDL::Joint(from.name, origin.p, axis,
                    from.type == urdf::Joint::PRISMATIC ? KDL::Joint::TransAxis : KDL::Joint::RotAxis);
}

void add_below(const urdf::Link& link, KDL::Tree& tree) {
  for (const auto& child : link.child_links) {
    const urdf::Joint& above = *child->parent_joint;
    tree.addSegment(KDL::Segment(child->name, joint(above), frame(above.parent_to_joint_origin_transform)), link.name);
    add_below(*child, tree);
  }
}

/// Returns the value of a joint as URDF defines it; mimic joints are resolved recursively.
double value_of(const urdf::ModelInterface& model, const urdf::Joint& joint, const std::map<std::string, double>& q) {
  if (!joint.mimic) return q.at(joint.name);
  return joint.mimic->multiplier * value_of(model, *model.getJoint(joint.mimic->joint_name), q) + joint.mimic->offset;
}

class ForwardKinematics : public testing::TestWithParam<test::SharedRobot> {};

TEST_P(ForwardKinematics, EqualsOrocosKdl) {
  const std::filesystem::path file = test::shared_folder(GetParam().name) / (GetParam().name + ".urdf");
  if (!std::filesystem::exists(file)) GTEST_SKIP() << "no shared data at " << file;
  const urdf::ModelInterfaceSharedPtr model = urdf::parseURDFFile(file.string());
  ASSERT_TRUE(model);
  KDL::Tree tree(model->getRoot()->name);
  add_below(*model->getRoot(), tree);

  const Robot robot(read_urdf(file));
  Hierarchy hierarchy(robot.model(), AdmitAll{}, UniformClearance(0.0));
  constexpr std::uint64_t seed = 20260101;
  double worst = 0.0;
  for (std::uint64_t sample = 0; sample < 10; ++sample) {
    SampleStream stream(seed, sample);
    const std::vector<double> q = test::random_configuration(robot, stream);
    hierarchy.update(robot.expand(q));
    std::map<std::string, double> by_name;
    for (std::size_t k = 0; k < q.size(); ++k) by_name[robot.independent_name(k)] = q[k];
    for (std::size_t l = 1; l < robot.link_count(); ++l) {
      KDL::Chain chain;
      ASSERT_TRUE(tree.getChain(model->getRoot()->name, robot.link_name(id<LinkId>(l)), chain));
      KDL::JntArray values(chain.getNrOfJoints());
      unsigned next = 0;
      for (const KDL::Segment& segment : chain.segments)
        if (segment.getJoint().getType() != KDL::Joint::Fixed)
          values(next++) = value_of(*model, *model->getJoint(segment.getJoint().getName()), by_name);
      KDL::Frame expected;
      ASSERT_GE(KDL::ChainFkSolverPos_recursive(chain).JntToCart(values, expected), 0);
      const Pose pose = hierarchy.link_pose(id<LinkId>(l));
      for (int r = 0; r < 3; ++r) {
        worst = std::max(worst, std::abs(pose.translation[r] - expected.p(r)));
        for (int c = 0; c < 3; ++c) worst = std::max(worst, std::abs(pose.rotation(r, c) - expected.M(r, c)));
      }
    }
  }
  EXPECT_LT(worst, 1e-12) << "seed " << seed;
}

INSTANTIATE_TEST_SUITE_P(All, ForwardKinematics, testing::ValuesIn(test::shared_robots()),
                         [](const auto& robot) { return robot.param.name; });

}  // namespace forward_kinematics_test
}  // namespace hinge::robotics
