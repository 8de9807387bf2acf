// SPDX-License-Identifier: BSD-3-Clause
// A function that returns lanes and is not inlined: how they are returned depends on the instruction set.
#pragma once

#include "hinge/detail/simd/lanes.hpp"

namespace hinge::isa {

[[gnu::noinline]] inline detail::simd::Float16 doubled(const float* from) {
  const detail::simd::Float16 x(from);
  return x + x;
}

/// Writes sixteen doubled numbers. Compiled for the baseline.
void store_doubled(const float* from, float* to);

}  // namespace hinge::isa
