// SPDX-License-Identifier: BSD-3-Clause
// make_subject: the five robots of the benchmark, from the shared data. If that is absent, they have generated bumpy
// links, with as many joints and triangles.
#pragma once

#include <cmath>
#include <cstddef>
#include <filesystem>
#include <memory>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

#include "hinge/robotics/link_pairs.hpp"
#include "hinge/robotics/robot.hpp"
#include "hinge/robotics/robot_description.hpp"
#include "hinge/robotics/shape.hpp"
#include "robotics/robots.hpp"
#include "robots/subject.hpp"

namespace hinge::bench {

struct SubjectKind {
  const char* shared;               ///< name of the shared robot
  int distances;                    ///< number of configurations for minimum distance queries; fewer for slow robots
  int links, chain, around, along;  ///< generated robot: links, links per branch, triangles of a link as a grid
};
inline constexpr SubjectKind subject_kinds[] = {{"panda", 100, 9, 9, 12, 12},
                                                {"ur5_robotiq", 60, 7, 7, 80, 92},
                                                {"talos", 24, 33, 8, 20, 20},
                                                {"pr2", 60, 21, 7, 12, 12},
                                                {"snake40", 10, 41, 41, 30, 30}};

/// A closed tube with round ends along z from `from` to `to`, in m. Its radius varies by 10 %.
inline std::vector<Triangle> bumpy_link(double from, double to, double radius, int around, int along) {
  const auto corner = [&](int i, int j) {
    const double s = static_cast<double>(j) / along, angle = 2 * std::numbers::pi * (i % around) / around;
    const double bumps = 1.0 + 0.1 * std::sin(3 * angle) * std::sin(11 * s);
    const double r = radius * bumps * std::sqrt(std::max(0.0, 1.0 - std::pow(2 * s - 1, 8)));
    return Vec3(r * std::cos(angle), r * std::sin(angle), from + s * (to - from));
  };
  std::vector<Triangle> triangles;
  for (int j = 0; j < along; ++j)
    for (int i = 0; i < around; ++i) {
      triangles.push_back({corner(i, j), corner(i + 1, j), corner(i + 1, j + 1)});
      triangles.push_back({corner(i, j), corner(i + 1, j + 1), corner(i, j + 1)});
    }
  return triangles;
}

/// Links 0.25 m long; each rotates about an axis across the previous link. Every branch starts at the root.
inline robotics::Robot generated_robot(const SubjectKind& kind) {
  using namespace robotics;
  constexpr double length = 0.25, radius = 0.045, ends = 0.02;
  const auto mesh = std::make_shared<const TriangleMesh>(
      TriangleMesh{bumpy_link(ends, length - ends, radius, kind.around, kind.along)});
  RobotDescription description;
  description.name = "generated-" + std::to_string(kind.links);
  for (int l = 0; l < kind.links; ++l) {
    LinkDescription link;
    link.name = "link" + std::to_string(l);
    link.geometry.push_back({MeshShape{mesh}});
    description.links.push_back(std::move(link));
    if (l == 0) continue;
    const bool starts = (l - 1) % kind.chain == 0;
    JointDescription joint;
    joint.name = "joint" + std::to_string(l);
    joint.type = JointType::revolute;
    joint.parent = "link" + std::to_string(starts ? 0 : l - 1);
    joint.child = "link" + std::to_string(l);
    joint.origin.translation = Vec3(0, 0, length);
    if (starts && kind.links > kind.chain) {  // branches point sideways, away from the root
      const double around = 2 * std::numbers::pi * ((l - 1) / kind.chain) * kind.chain / (kind.links - 1);
      joint.origin.rotation = rotation_about(Vec3::UnitZ(), around) * rotation_about(Vec3::UnitY(), 1.4);
      joint.origin.translation = joint.origin.rotation * Vec3(0, 0, length);
    }
    // With these limits, some postures collide and some do not.
    const double limit = kind.links > kind.chain ? 1.9 : 2.7;
    joint.axis = l % 2 == 0 ? Vec3::UnitY() : Vec3(Vec3(0.9, 0.0, 0.4));
    joint.lower = -limit;
    joint.upper = limit;
    description.joints.push_back(std::move(joint));
  }
  return Robot(std::move(description));
}

/// The shared robot, or its generated replacement, with `postures` random postures.
inline Subject make_subject(const SubjectKind& kind, std::size_t postures) {
  if (std::filesystem::exists(test::shared_folder(kind.shared))) {
    test::LoadedRobot loaded = test::load_shared(kind.shared);
    return {kind.shared, std::move(loaded.robot), loaded.disabled, postures};
  }
  robotics::Robot robot = generated_robot(kind);
  const robotics::LinkPairs none(robot.link_count());
  std::string name = robot.name();
  return {std::move(name), std::move(robot), none, postures};
}

}  // namespace hinge::bench
