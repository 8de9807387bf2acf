// SPDX-License-Identifier: BSD-3-Clause
// Scenery: 1.26 million triangles around a robot, bumpy ground with 69 boulders, and its pose relative to the robot.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <memory>
#include <numbers>
#include <utility>
#include <vector>

#include "hinge/core/philox.hpp"
#include "hinge/core/pose.hpp"
#include "hinge/primitive/triangle.hpp"
#include "hinge/robotics/robot.hpp"
#include "hinge/robotics/robot_description.hpp"
#include "hinge/robotics/shape.hpp"
#include "oracle/fcl_robots.hpp"
#include "robots/subject.hpp"

namespace hinge::bench {

/// Objects in m. The scene is the same for all robots; only its pose differs.
inline std::vector<std::vector<Triangle>> draw_scenery() {
  constexpr double half_width = 3.0, lowest = -1.3;
  std::vector<std::vector<Triangle>> objects(1);
  const auto grid = [](std::vector<Triangle>& to, int n, const auto& corner) {
    for (int i = 0; i < n; ++i)
      for (int j = 0; j < n; ++j) {
        to.push_back({corner(i, j), corner(i + 1, j), corner(i + 1, j + 1)});
        to.push_back({corner(i, j), corner(i + 1, j + 1), corner(i, j + 1)});
      }
  };
  constexpr int ground = 500, boulder = 74;
  grid(objects.front(), ground, [&](int i, int j) {
    const double x = half_width * (2.0 * i / ground - 1), y = half_width * (2.0 * j / ground - 1);
    return Vec3(x, y, lowest + 0.05 * std::sin(5 * x) * std::cos(4 * y) + 0.01 * std::sin(41 * x + 37 * y));
  });
  SampleStream stream(robot_seed, 1'000'000);
  for (int k = 0; k < 69; ++k) {
    const auto between = [&](double low, double high) { return low + (high - low) * stream.uniform(); };
    const double x = between(-2.5, 2.5), y = between(-2.5, 2.5), z = between(lowest, -lowest);
    const double radius = between(0.08, 0.2);
    grid(objects.emplace_back(), boulder, [&](int i, int j) {
      const double a = 2 * std::numbers::pi * (i % boulder) / boulder, s = std::numbers::pi * j / boulder;
      const double r = radius * (1 + 0.08 * std::sin(5 * a) * std::sin(7 * s));
      return Vec3(x + r * std::sin(s) * std::cos(a), y + r * std::sin(s) * std::sin(a), z + r * std::cos(s));
    });
  }
  return objects;
}

/// The same scene for Hinge (a robot model with one moving rigid group) and for FCL.
struct Scenery {
  robotics::Robot body;
  std::vector<oracle::Mesh> objects;

  static Scenery make() {
    using namespace robotics;
    std::vector<oracle::Mesh> meshes;
    TriangleMesh all;
    for (const auto& object : draw_scenery()) {
      meshes.emplace_back();
      for (const Triangle& t : object) {
        all.triangles.push_back(t);
        meshes.back().push_back(corners(t));
      }
    }
    RobotDescription description;
    description.name = "scenery";
    description.links = {{"stand"}, {"scenery", {{MeshShape{std::make_shared<const TriangleMesh>(std::move(all))}}}}};
    JointDescription joint;
    joint.name = "place";
    joint.type = JointType::prismatic;
    joint.parent = "stand";
    joint.child = "scenery";
    description.joints = {joint};
    return {Robot(std::move(description)), std::move(meshes)};
  }
};

/// The pose of the scene for a robot. Its base does not collide, and of the first postures as close to 40 % as
/// possible collide, among a hundred random poses.
template <oracle::FclBuild build>
Pose find_place(oracle::FclScene<build>& scene, oracle::FclRobot<build>& robot, const Subject& subject) {
  constexpr int places = 100, wanted_share = 40;  // percent of the postures
  const std::size_t asked = std::min<std::size_t>(50, subject.postures().size());
  Pose best;
  int nearest = 101;
  for (std::uint64_t k = 0; k < places; ++k) {
    SampleStream stream(robot_seed, 2'000'000 + k);
    Pose at;
    for (int axis = 0; axis < 3; ++axis) at.translation[axis] = (axis == 2 ? 1.0 : 3.0) * (stream.uniform() - 0.5);
    scene.place(placement(at));
    robot.take(0);
    bool touched = false;
    for (const std::size_t link : subject.base()) touched = touched || robot.hits(scene, link);
    if (touched) continue;
    std::size_t hits = 0;
    for (std::size_t p = 0; p < asked; ++p) {
      robot.take(p);
      hits += robot.hits(scene, oracle::FclManner::manager) ? 1 : 0;
    }
    const int share = static_cast<int>(100 * hits / asked), off = std::abs(share - wanted_share);
    if (off < nearest) {
      nearest = off;
      best = at;
    }
  }
  scene.place(placement(best));
  return best;
}

}  // namespace hinge::bench
