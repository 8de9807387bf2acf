// SPDX-License-Identifier: BSD-3-Clause
// next_up, next_down: the neighbouring doubles, for bounds that may only grow. Branch-light, since every box uses them.
#pragma once

#include <bit>
#include <cstdint>

namespace hinge::detail {

/// Returns the smallest double above a finite x.
inline double next_up(double x) noexcept {
  if (x == 0.0) return std::bit_cast<double>(std::uint64_t{1});
  const auto bits = std::bit_cast<std::int64_t>(x);
  return std::bit_cast<double>(bits + (bits >= 0 ? 1 : -1));
}

/// Returns the largest double below a finite x.
inline double next_down(double x) noexcept { return -next_up(-x); }

}  // namespace hinge::detail
