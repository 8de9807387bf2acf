// SPDX-License-Identifier: BSD-3-Clause
// Robots built in code for tests of the collision matrix.
#pragma once

#include <string>

#include "hinge/core/pose.hpp"
#include "hinge/core/vec3.hpp"
#include "hinge/robotics/collision_matrix.hpp"
#include "hinge/robotics/robot.hpp"
#include "hinge/robotics/robot_description.hpp"
#include "hinge/robotics/shape.hpp"

namespace hinge::test {

/// Options with few samples (200); these are enough to find the pairs that collide often.
inline robotics::MatrixOptions few_samples() {
  robotics::MatrixOptions options;
  options.samples = 200;
  return options;
}

/// Builds a robot description: a chain of calls adds links, shapes and joints. A shape goes to the last link.
class Builder {
 public:
  Builder& link(const std::string& name) {
    robot_.links.push_back({name, {}});
    return *this;
  }
  Builder& box(const Vec3& size, const Vec3& at) { return shape(robotics::BoxShape{size}, at); }
  Builder& shape(const robotics::Shape& shape, const Vec3& at) {
    Pose origin;
    origin.translation = at;
    robot_.links.back().geometry.push_back({shape, origin});
    return *this;
  }
  Builder& joint(robotics::JointType type, const std::string& parent, const std::string& child, const Vec3& at,
                 const Vec3& axis, double lower, double upper) {
    robotics::JointDescription joint;
    joint.name = "to_" + child;
    joint.type = type;
    joint.parent = parent;
    joint.child = child;
    joint.origin.translation = at;
    joint.axis = axis;
    joint.lower = lower;
    joint.upper = upper;
    robot_.joints.push_back(joint);
    return *this;
  }
  Builder& mimic(const std::string& other, double multiplier, double offset) {
    robot_.joints.back().mimic = robotics::Mimic{other, multiplier, offset};
    return *this;
  }
  robotics::Robot robot() const { return robotics::Robot(robot_); }

 private:
  robotics::RobotDescription robot_{"built", {}, {}};
};

}  // namespace hinge::test
