// SPDX-License-Identifier: BSD-3-Clause
// The inner loops with hinge::simd: the compilers' vector types, with intrinsics for table look-up and compression.
#include <cstddef>
#include <cstdint>

#include "hinge/detail/bounds/float_box.hpp"
#include "hinge/detail/simd/gather_bits.hpp"
#include "hinge/detail/simd/instruction_set.hpp"
#include "hinge/detail/simd/lanes.hpp"
#include "simd/kernels.hpp"

namespace hinge::bench {

namespace {

constexpr std::size_t n = detail::simd::width;

void near_points(const PointTasks& tasks, std::uint32_t* bits) {
  using detail::simd::Float16;
  for (std::size_t t = 0; t < tasks.size; ++t) {
    const std::uint32_t slot = tasks.slots[t], block = tasks.blocks[t];
    const float* one = tasks.packed + slot / n * 3 * n + slot % n;
    const float* sixteen = tasks.packed + block * 3 * n;
    const Float16 x = Float16(sixteen) - Float16(one[0]), y = Float16(sixteen + n) - Float16(one[n]),
                  z = Float16(sixteen + 2 * n) - Float16(one[2 * n]);
    const Float16 squared = x * x + y * y + z * z;
    const Float16 near =
        look_up(tasks.squares + tasks.classes[slot] * n, detail::simd::Index16(tasks.classes + block * n));
    bits[t] = ~less(near, squared) & detail::simd::all_bits;
  }
}

std::size_t touching_boxes(const BoxTasks& tasks, std::uint32_t* hits) {
  std::size_t count = 0;
  for (std::size_t b = 0; b < tasks.box_count; ++b) {
    const detail::BoxLanes box(tasks.boxes[b]);
    for (std::size_t r = 0; r < tasks.row_count; ++r)
      count +=
          detail::simd::append_lanes(overlapping(tasks.rows[r], box), static_cast<std::uint32_t>(r * n), hits + count);
  }
  return count;
}

}  // namespace

template <>
Kernels hinge_kernels<detail::simd::compiled_for()>() {
  return {"vector types", near_points, touching_boxes};
}

}  // namespace hinge::bench
