// SPDX-License-Identifier: BSD-3-Clause
// unpack_xtc: the compressed coordinates of an XTC frame.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "hinge/core/vec3.hpp"

namespace hinge::molecular {

/// The header of the packed bits.
struct XtcBlock {
  double per_nanometre = 0.0;                   ///< grid steps per nanometre; > 0
  std::array<std::int32_t, 3> least{}, most{};  ///< range of the coordinates, in grid steps
  std::int32_t small = 0;                       ///< number of the first small range
};

/// Number of extra bytes that `bits` needs after the coordinates: they are read in 64-bit words.
inline constexpr std::size_t xtc_padding = 16;

/// Returns the positions, angstrom: integer grid steps, rounded to the nearest double. bits: the packed bytes, then
/// xtc_padding further bytes. Throws LoadError, with `what` as the location, if the data are damaged.
std::vector<Vec3> unpack_xtc(const XtcBlock& block, std::span<const char> bits, std::size_t atoms,
                             const std::string& what);

}  // namespace hinge::molecular
