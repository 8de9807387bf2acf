// SPDX-License-Identifier: BSD-3-Clause
// Tier: the accuracy of a link's geometry, from its exact surface to one capsule, chosen per link.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <map>
#include <string>
#include <string_view>

#include "hinge/core/api.hpp"
#include "hinge/robotics/robot_description.hpp"

namespace hinge::robotics {

/// All tiers but `mesh` enclose the surfaces of the link with a margin of at least 10^-10 m. Any mixture of tiers
/// therefore reports every contact of the exact surfaces. Hulls and capsules are solid and also enclose the inside of
/// solid shapes. Spheres cover only the surface: they miss an object deep inside a solid shape that touches no sphere.
enum class Tier : std::uint8_t {
  mesh,     ///< the shapes of the description
  hull,     ///< convex hull of all shapes, at most 10^-5 m too large, plus Tiers::tolerance for rounded shapes
  capsule,  ///< one capsule or sphere around all shapes
  spheres   ///< several spheres that cover the surface
};

/// Returns the tier called "mesh", "hull", "capsule" or "spheres". Throws ModelError for any other name.
HINGE_API Tier tier_named(std::string_view name);
/// Returns the name of a tier. The string is static.
HINGE_API const char* name(Tier tier) noexcept;

/// The tiers of a robot.
struct Tiers {
  Tier all = Tier::mesh;                             ///< for all links that `links` does not name
  std::map<std::string, Tier, std::less<>> links{};  ///< exceptions, by link name
  std::size_t most_spheres = 32;                     ///< largest number per link, >= 1
  double tolerance = 1e-3;  ///< m; largest distance of a hull from the spheres, cylinders and capsules inside
};

/// Returns the description with the shapes of the links replaced. A link whose only shape is a sphere or capsule keeps
/// it in every tier, because it is exact and cheapest. Throws ModelError if Robot would reject the description, a link
/// does not exist, most_spheres is 0, the tolerance is not finite or not above 0, or coordinates are too large for a
/// hull (above about 10^4 m).
HINGE_API RobotDescription with_tiers(RobotDescription description, const Tiers& tiers);

}  // namespace hinge::robotics
