// SPDX-License-Identifier: BSD-3-Clause
// Helpers for tests of tiers: a link of given triangles, its tiers, and random points.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <map>
#include <memory>
#include <span>
#include <string>
#include <tuple>
#include <utility>
#include <variant>
#include <vector>

#include "hinge/core/philox.hpp"
#include "hinge/primitive/triangle.hpp"
#include "hinge/robotics/robot_description.hpp"
#include "hinge/robotics/tiers.hpp"

namespace hinge::test {

/// Returns a robot of one link with these triangles.
inline robotics::RobotDescription lone_link(std::vector<Triangle> triangles) {
  auto mesh = std::make_shared<robotics::TriangleMesh>();
  mesh->triangles = std::move(triangles);
  robotics::RobotDescription robot;
  robot.name = "lone";
  robot.links = {{"link", {}}};
  robot.links[0].geometry.emplace_back().shape = robotics::MeshShape{std::move(mesh)};
  return robot;
}

/// Returns the shapes of the first link after applying the tier.
inline std::vector<robotics::PlacedShape> tiered(const robotics::RobotDescription& robot, robotics::Tier tier,
                                                 std::size_t most_spheres = 32) {
  robotics::Tiers tiers;
  tiers.all = tier;
  tiers.most_spheres = most_spheres;
  return robotics::with_tiers(robot, tiers).links.at(0).geometry;
}

/// Returns a degenerate triangle per point.
inline std::vector<Triangle> as_triangles(std::span<const Vec3> points) {
  std::vector<Triangle> triangles;
  for (const Vec3& p : points) triangles.push_back({p, p, p});
  return triangles;
}

/// Returns the triangles of the hull tier of these points.
inline std::vector<Triangle> hull_of(std::span<const Vec3> points) {
  const auto geometry = tiered(lone_link(as_triangles(points)), robotics::Tier::hull);
  return std::get<robotics::MeshShape>(geometry.at(0).shape).mesh->triangles;
}

/// Returns whether every directed edge occurs once, and once in the opposite direction.
inline bool is_closed(std::span<const Triangle> triangles) {
  using Corner = std::tuple<double, double, double>;
  std::map<std::pair<Corner, Corner>, int> runs;
  const auto corner = [](const Vec3& v) { return Corner{v[0], v[1], v[2]}; };
  for (const Triangle& t : triangles)
    for (const auto& [a, b] : {std::pair(t.a, t.b), std::pair(t.b, t.c), std::pair(t.c, t.a)})
      ++runs[{corner(a), corner(b)}];
  for (const auto& [edge, count] : runs)
    if (count != 1 || !runs.contains({edge.second, edge.first})) return false;
  return true;
}

/// Returns a point with coordinates uniform in (-1, 1).
inline Vec3 random_point(SampleStream& stream) {
  const double x = stream.uniform(), y = stream.uniform(), z = stream.uniform();
  return {2 * x - 1, 2 * y - 1, 2 * z - 1};
}

/// Returns points with coordinates in (-1, 1).
inline std::vector<Vec3> random_points(std::uint64_t seed, std::size_t count) {
  SampleStream stream(seed, 0);
  std::vector<Vec3> points;
  for (std::size_t k = 0; k < count; ++k) points.push_back(random_point(stream));
  return points;
}

/// Returns named point sets without volume, or with duplicates.
inline std::vector<std::pair<std::string, std::vector<Vec3>>> degenerate_points() {
  std::vector<std::pair<std::string, std::vector<Vec3>>> cases = {
      {"one", {{1, 2, 3}}},
      {"one, repeated", std::vector<Vec3>(7, Vec3(1, 2, 3))},
      {"two", {{0, 0, 0}, {1, 0, 0}}},
      {"three", {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}},
      {"line", {{0, 0, 0}, {0.1, 0.2, 0.3}, {0.2, 0.4, 0.6}, {0.3, 0.6, 0.9}, {-0.1, -0.2, -0.3}}}};
  std::vector<Vec3> grid, tilted = random_points(1, 100), slab = random_points(2, 100), twice = random_points(3, 50);
  for (int i = 0; i < 6; ++i)
    for (int j = 0; j < 6; ++j) grid.emplace_back(0.1 * i, 0.1 * j, 0.3);
  for (Vec3& p : tilted) p[2] = 0.3 * p[0] + 0.7 * p[1];
  for (Vec3& p : slab) p[1] *= 1e-8;
  twice.insert(twice.end(), twice.begin(), twice.begin() + 25);
  cases.insert(cases.end(), {{"grid", grid}, {"tilted plane", tilted}, {"slab", slab}, {"repeated", twice}});
  return cases;
}

}  // namespace hinge::test
