// SPDX-License-Identifier: BSD-3-Clause
// The compressed coordinates of an XTC frame.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "hinge/core/vec3.hpp"

namespace hinge::molecular {

/// What stands before the bits.
struct XtcBlock {
  double per_nanometre = 0.0;                   ///< grid steps; > 0
  std::array<std::int32_t, 3> least{}, most{};  ///< coordinates, in grid steps
  std::int32_t small = 0;                       ///< number of the first small range
};

/// Number of bytes that `bits` must have behind the coordinates: they are read in long words.
inline constexpr std::size_t xtc_padding = 16;

/// The positions, angstrom: whole grid steps, to the nearest double. LoadError: `what` says where the damage is. bits:
/// used bytes, then xtc_padding more.
std::vector<Vec3> unpack_xtc(const XtcBlock& block, std::span<const char> bits, std::size_t atoms,
                             const std::string& what);

}  // namespace hinge::molecular
