// SPDX-License-Identifier: BSD-3-Clause
// Interface of the two inner loops that bench_simd compares. Each is compiled once per library and level.
#pragma once

#include <cstddef>
#include <cstdint>

#include "hinge/detail/bounds/float_box.hpp"
#include "hinge/detail/simd/instruction_set.hpp"

namespace hinge::bench {

/// "One point against sixteen" in the layout of engine/simd: blocks of sixteen points, axis by axis.
struct PointTasks {
  const float* packed;          ///< 48 numbers per block
  const std::uint8_t* classes;  ///< 16 per block, each below 16
  const float* squares;         ///< 16 x 16 squared thresholds by class
  const std::uint32_t* slots;   ///< per task: index of the single point, 16 * block + lane
  const std::uint32_t* blocks;  ///< per task: index of the block of sixteen points
  std::size_t size;
};

/// "One box against sixteen": tests every box against every row.
struct BoxTasks {
  const detail::FloatBox* boxes;
  std::size_t box_count;
  const detail::BoxRow* rows;
  std::size_t row_count;
};

/// Function pointers prevent inlining into the timed code and sharing of template instances between levels.
struct Kernels {
  const char* target;  ///< name of the target, as the library reports it
  /// Per task: sets the bits of the sixteen points that are not proved farther than their thresholds.
  void (*near_points)(const PointTasks& tasks, std::uint32_t* bits);
  /// Writes 16 * row + lane for every box of a row that intersects, and returns their number. May overwrite 16
  /// further elements.
  std::size_t (*touching_boxes)(const BoxTasks& tasks, std::uint32_t* hits);
};

/// Specialised in files that are compiled for the level.
template <detail::simd::InstructionSet Level>
Kernels hinge_kernels();
template <detail::simd::InstructionSet Level>
Kernels highway_kernels();

}  // namespace hinge::bench
