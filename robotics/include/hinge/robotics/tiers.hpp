// SPDX-License-Identifier: BSD-3-Clause
// Tier: how accurately a link is modelled, from its exact surface down to one capsule, chosen link by link.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <map>
#include <string>
#include <string_view>

#include "hinge/robotics/robot_description.hpp"

namespace hinge::robotics {

/// All but `mesh` enclose the link's surfaces, by 10^-10 m at least, so that none of them misses a contact that the
/// exact surfaces have, whatever is mixed. Hulls and capsules are solid, so that they also hold what lies inside a
/// solid shape. Spheres cover the surface alone: what lies deep inside a solid shape, touching no sphere, is missed.
enum class Tier : std::uint8_t {
  mesh,  ///< the shapes as they are
  hull,  ///< the convex hull of all shapes of the link, at most 10^-5 m too large (rounded shapes: the tolerance more)
  capsule,  ///< one capsule or sphere around all of them
  spheres   ///< a number of spheres over their surface
};

/// "mesh", "hull", "capsule" or "spheres"; ModelError for anything else.
Tier tier_named(std::string_view name);
const char* name(Tier tier) noexcept;

struct Tiers {
  Tier all = Tier::mesh;
  std::map<std::string, Tier, std::less<>> links{};  ///< those that differ, by name
  std::size_t most_spheres = 32;                     ///< of a link, >= 1
  double tolerance = 1e-3;  ///< m; how far a hull may be from the spheres, cylinders and capsules in it
};

/// The same robot with the links' shapes replaced. A link whose only shape is a sphere or capsule keeps it in every
/// tier: nothing is cheaper, and it is exact. ModelError: what Robot refuses; a link that does not exist, no spheres,
/// a tolerance that is not finite or not above 0, coordinates too large for a hull (beyond some 10^4 m).
RobotDescription with_tiers(RobotDescription description, const Tiers& tiers);

}  // namespace hinge::robotics
