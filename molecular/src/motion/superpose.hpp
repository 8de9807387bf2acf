// SPDX-License-Identifier: BSD-3-Clause
// closest_rotation: the rotation that superposes two sets of positions.
#pragma once

#include <span>

#include "hinge/core/vec3.hpp"

namespace hinge::molecular {

/// Returns the mean position; positions: at least one, angstrom.
Vec3 centre(std::span<const Vec3> positions);

/// Returns the least-squares rotation from `moved` to `onto`, each relative to its centre: the quaternion of the
/// largest eigenvalue (Horn, J. Opt. Soc. Am. A 4:629, 1987). Both have the same length.
Mat3 closest_rotation(std::span<const Vec3> moved, const Vec3& centre_moved, std::span<const Vec3> onto,
                      const Vec3& centre_onto);

}  // namespace hinge::molecular
