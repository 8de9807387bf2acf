// SPDX-License-Identifier: BSD-3-Clause
// The two inner loops that bench_simd compares, as seen from outside: each is compiled once per library and level.
#pragma once

#include <cstddef>
#include <cstdint>

#include "hinge/detail/bounds/float_box.hpp"
#include "hinge/detail/simd/instruction_set.hpp"

namespace hinge::bench {

/// "One point against sixteen", in the layout of engine/simd: blocks of sixteen points, axis by axis.
struct PointTasks {
  const float* packed;          ///< 48 numbers per block
  const std::uint8_t* classes;  ///< 16 per block, each below 16
  const float* squares;         ///< 16 x 16 squared thresholds by class
  const std::uint32_t* slots;   ///< per task: the one, 16 * block + lane
  const std::uint32_t* blocks;  ///< per task: the sixteen
  std::size_t size;
};

/// "One box against sixteen": every box against every row.
struct BoxTasks {
  const detail::FloatBox* boxes;
  std::size_t box_count;
  const detail::BoxRow* rows;
  std::size_t row_count;
};

/// Functions behind pointers: nothing is inlined into the clock, and no template of one level is shared with another.
struct Kernels {
  const char* target;  ///< what the library says it uses
  /// Per task: a bit for each of the sixteen that is not proven farther than its threshold.
  void (*near_points)(const PointTasks& tasks, std::uint32_t* bits);
  /// Appends 16 * row + lane for every box of a row that shares a point; returns how many. Leaves 16 more in disorder.
  std::size_t (*touching_boxes)(const BoxTasks& tasks, std::uint32_t* hits);
};

/// Specialised by the files that are compiled for the level.
template <detail::simd::InstructionSet Level>
Kernels hinge_kernels();
template <detail::simd::InstructionSet Level>
Kernels highway_kernels();

}  // namespace hinge::bench
