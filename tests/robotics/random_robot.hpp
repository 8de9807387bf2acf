// SPDX-License-Identifier: BSD-3-Clause
// Small random robots built in code, and their triangles in the world, computed by Eigen without Hinge's geometry.
#pragma once

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "hinge/core/id.hpp"
#include "hinge/core/philox.hpp"
#include "hinge/core/pose.hpp"
#include "hinge/kinematics/joint.hpp"
#include "hinge/primitive/triangle.hpp"
#include "hinge/robotics/robot.hpp"
#include "hinge/robotics/robot_description.hpp"

namespace hinge::test {

/// Returns a number in [low, high).
inline double uniform(SampleStream& stream, double low, double high) { return low + (high - low) * stream.uniform(); }

/// Returns a point with coordinates in [-size, size).
inline Vec3 random_point(SampleStream& stream, double size) {
  return {uniform(stream, -size, size), uniform(stream, -size, size), uniform(stream, -size, size)};
}

/// Returns a random rotation of up to 3 rad and a translation with coordinates in [-size, size).
inline Pose random_pose(SampleStream& stream, double size) {
  Vec3 axis = random_point(stream, 1.0);
  axis /= std::sqrt(squared_norm(axis));
  return {rotation_about(axis, uniform(stream, -3.0, 3.0)), random_point(stream, size)};
}

/// Returns a mesh of separate random triangles.
inline std::shared_ptr<robotics::TriangleMesh> random_mesh(SampleStream& stream, std::size_t triangles, double size) {
  auto mesh = std::make_shared<robotics::TriangleMesh>();
  for (std::size_t t = 0; t < triangles; ++t) {
    const Vec3 corner = random_point(stream, size);
    mesh->triangles.push_back(
        {corner, corner + random_point(stream, size / 2), corner + random_point(stream, size / 2)});
  }
  return mesh;
}

/// A tree of links with random meshes and some balls, joints of every type, and one mimic joint.
inline robotics::RobotDescription random_description(SampleStream& stream, std::size_t links) {
  using namespace robotics;
  RobotDescription robot{"random", {}, {}};
  const JointType types[] = {JointType::revolute, JointType::continuous, JointType::prismatic, JointType::fixed};
  for (std::size_t l = 0; l < links; ++l) {
    robot.links.push_back({"link" + std::to_string(l)});
    if (l % 5 != 3)
      robot.links[l].geometry.push_back({MeshShape{random_mesh(stream, 3 + l % 3, 0.3)}, random_pose(stream, 0.1)});
    if (l % 3 == 1)
      robot.links[l].geometry.push_back({SphereShape{uniform(stream, 0.02, 0.15)}, random_pose(stream, 0.3)});
    if (l == 0) continue;
    JointDescription joint;
    joint.name = "joint" + std::to_string(l);
    joint.type = types[l % 4];
    joint.parent =
        robot.links[std::min(l - 1, static_cast<std::size_t>(stream.uniform() * static_cast<double>(2 * l)))].name;
    joint.child = robot.links[l].name;
    joint.origin = random_pose(stream, 0.4);
    joint.axis = random_point(stream, 1.0);
    joint.lower = -2.0;
    joint.upper = 2.0;
    if (l == 5) joint.mimic = Mimic{"joint2", -0.5, 0.1};
    robot.joints.push_back(joint);
  }
  return robot;
}

inline Eigen::Isometry3d isometry(const Pose& pose) {
  Eigen::Isometry3d x = Eigen::Isometry3d::Identity();
  x.linear() = pose.rotation;
  x.translation() = pose.translation;
  return x;
}

/// A triangle in the world, inflated by its radius.
struct Grown {
  Triangle triangle;
  double radius = 0.0;
};

/// Returns the distance of the triangles minus both radii.
inline double apart(const Grown& x, const Grown& y) {
  return std::sqrt(squared_distance(x.triangle, y.triangle)) - x.radius - y.radius;
}

inline Triangle moved(const Triangle& t, const Eigen::Isometry3d& x) { return {x * t.a, x * t.b, x * t.c}; }

/// Returns link poses by link name. `values`: joint values by name; mimic joints are computed.
inline std::map<std::string, Eigen::Isometry3d> frames_of(const robotics::RobotDescription& robot,
                                                          const std::map<std::string, double>& values) {
  using namespace robotics;
  std::map<std::string, Eigen::Isometry3d> frames = {{robot.links[0].name, Eigen::Isometry3d::Identity()}};
  for (const JointDescription& joint : robot.joints) {
    Eigen::Isometry3d motion = Eigen::Isometry3d::Identity();
    double q = 0.0;
    if (joint.type != JointType::fixed)
      q = joint.mimic ? joint.mimic->multiplier * values.at(joint.mimic->joint) + joint.mimic->offset
                      : values.at(joint.name);
    if (joint.type == JointType::prismatic) motion.translation() = q * joint.axis.normalized();
    if (joint.type == JointType::revolute || joint.type == JointType::continuous)
      motion.linear() = Eigen::AngleAxisd(q, joint.axis.normalized()).toRotationMatrix();
    frames[joint.child] = frames.at(joint.parent) * isometry(joint.origin) * motion;
  }
  return frames;
}

/// Returns triangles by link of `robot`. q: independent joints. Supports meshes and balls only.
inline std::vector<std::vector<Grown>> grown_triangles(const robotics::Robot& robot, const std::vector<double>& q,
                                                       const Eigen::Isometry3d& base = Eigen::Isometry3d::Identity()) {
  using namespace robotics;
  std::map<std::string, double> values;
  for (std::size_t k = 0; k < q.size(); ++k) values[robot.independent_name(k)] = q[k];
  const auto frames = frames_of(robot.description(), values);
  std::vector<std::vector<Grown>> links(robot.link_count());
  for (const LinkDescription& link : robot.description().links)
    for (const PlacedShape& placed : link.geometry) {
      const Eigen::Isometry3d at = base * frames.at(link.name) * isometry(placed.origin);
      std::vector<Grown>& list = links[index(*robot.find_link(link.name))];
      if (const auto* mesh = std::get_if<MeshShape>(&placed.shape))
        for (const Triangle& triangle : mesh->mesh->triangles) list.push_back({moved(triangle, at), 0.0});
      if (const auto* ball = std::get_if<SphereShape>(&placed.shape))
        list.push_back({{at.translation(), at.translation(), at.translation()}, ball->radius});
    }
  return links;
}

/// Returns the smallest distance of the surfaces of two lists; infinity if a list is empty.
inline double apart(const std::vector<Grown>& x, const std::vector<Grown>& y) {
  double least = std::numeric_limits<double>::infinity();
  for (const Grown& a : x)
    for (const Grown& b : y) least = std::min(least, apart(a, b));
  return least;
}

}  // namespace hinge::test
