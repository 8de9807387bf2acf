// SPDX-License-Identifier: BSD-3-Clause
// xtc_frame: a frame of GROMACS' XTC format, with compressed coordinates.
#pragma once

#include <cstddef>
#include <span>
#include <string>

#include "hinge/core/vec3.hpp"

namespace hinge::molecular {

/// Returns the bytes of one frame, without a unit cell. positions: angstrom, rounded to 0.01 angstrom if there are more
/// than nine. number: of the frame, from 0; it becomes step and time. Throws ModelError if a coordinate does not fit
/// the format.
std::string xtc_frame(std::span<const Vec3> positions, std::size_t number);

}  // namespace hinge::molecular
