// SPDX-License-Identifier: BSD-3-Clause
// Implements tiers: tessellates all shapes of a link in its frame and fits the tier's shapes around them.
#include "hinge/robotics/tiers.hpp"

#include <algorithm>
#include <array>
#include <memory>
#include <set>
#include <utility>
#include <variant>
#include <vector>

#include "approximation/convex_hull.hpp"
#include "approximation/fit_capsule.hpp"
#include "approximation/fit_spheres.hpp"
#include "description/check_description.hpp"
#include "hinge/core/error.hpp"
#include "hinge/robotics/containment.hpp"
#include "hinge/robotics/tessellate.hpp"

namespace hinge::robotics {

namespace {

constexpr std::array<std::pair<Tier, const char*>, 4> tier_names = {
    {{Tier::mesh, "mesh"}, {Tier::hull, "hull"}, {Tier::capsule, "capsule"}, {Tier::spheres, "spheres"}}};

bool is_rounded(const Shape& shape) {
  return std::holds_alternative<SphereShape>(shape) || std::holds_alternative<CapsuleShape>(shape);
}

/// Returns circumscribed triangles of all shapes of a link, in its frame.
std::vector<Triangle> triangles_of(const LinkDescription& link, double tolerance) {
  std::vector<Triangle> triangles;
  for (const PlacedShape& placed : link.geometry)
    for (const Triangle& t : tessellate(placed.shape, {Tessellation::Manner::circumscribed, tolerance}).triangles)
      triangles.push_back(t.placed(placed.origin));
  return triangles;
}

std::vector<PlacedShape> fitted(const std::vector<Triangle>& triangles, Tier tier, std::size_t most_spheres) {
  if (tier == Tier::spheres) return fit_spheres(triangles, most_spheres);
  std::vector<Vec3> corners;
  for (const Triangle& t : triangles) corners.insert(corners.end(), {t.a, t.b, t.c});
  if (tier == Tier::capsule) return {fit_capsule(corners)};
  auto mesh = std::make_shared<TriangleMesh>();
  mesh->triangles = convex_hull(corners);
  MeshShape hull{std::move(mesh)};
  hull.solid = closed(hull.mesh->triangles);  // only a closed mesh may be solid
  return {{hull}};
}

void check(const RobotDescription& robot, const Tiers& tiers) {
  if (const auto problem = first_problem(robot)) throw ModelError(problem->what);
  if (tiers.most_spheres == 0) throw ModelError("at most 0 spheres per link, expected at least 1");
  std::set<std::string_view> known;
  for (const LinkDescription& link : robot.links) known.insert(link.name);
  for (const auto& [link, tier] : tiers.links)
    if (!known.contains(link))
      throw ModelError("tier '" + std::string(name(tier)) + "' is given for link '" + link + "', which does not exist");
}

}  // namespace

Tier tier_named(std::string_view text) {
  for (const auto& [tier, word] : tier_names)
    if (text == word) return tier;
  throw ModelError("tier '" + std::string(text) + "', expected mesh, hull, capsule or spheres");
}

const char* name(Tier tier) noexcept { return tier_names[static_cast<std::size_t>(tier)].second; }

RobotDescription with_tiers(RobotDescription description, const Tiers& tiers) {
  check(description, tiers);
  for (LinkDescription& link : description.links) {
    const auto own = tiers.links.find(link.name);
    const Tier tier = own == tiers.links.end() ? tiers.all : own->second;
    if (tier == Tier::mesh || link.geometry.empty()) continue;
    if (link.geometry.size() == 1 && is_rounded(link.geometry[0].shape)) continue;
    try {
      link.geometry = fitted(triangles_of(link, tiers.tolerance), tier, tiers.most_spheres);
    } catch (const ModelError& error) {
      throw ModelError("link '" + link.name + "': " + error.what());
    }
  }
  return description;
}

}  // namespace hinge::robotics
