// SPDX-License-Identifier: BSD-3-Clause
// The inner loops with Highway's portable operations, for its static target: the best that the compiler's flags
// allow.
#include <hwy/highway.h>

#include <array>
#include <cstddef>
#include <cstdint>

#include "hinge/detail/bounds/float_box.hpp"
#include "hinge/detail/simd/instruction_set.hpp"
#include "simd/kernels.hpp"

namespace hinge::bench {

namespace {

namespace hn = hwy::HWY_NAMESPACE;
constexpr std::size_t n = detail::simd::width;
const hn::CappedTag<float, n> floats;
const hn::RebindToSigned<decltype(floats)> ints;
const hn::RebindToUnsigned<decltype(floats)> indices;
constexpr std::size_t lanes = hn::MaxLanes(floats);

/// table[index] for `lanes` indices into a table of sixteen. The case is selected at compile time.
template <std::size_t Lanes, class Floats, class Ints>
HWY_INLINE auto look_up(Floats d, Ints di, const float* table, const std::uint8_t* index) {
  const hn::Rebind<std::uint8_t, Ints> bytes;
  const auto i = hn::PromoteTo(di, hn::LoadU(bytes, index));
  if constexpr (Lanes == n) {
    return hn::TableLookupLanes(hn::LoadU(d, table), hn::IndicesFromVec(d, i));
  } else if constexpr (2 * Lanes == n) {
    const auto half = hn::IndicesFromVec(d, hn::And(i, hn::Set(di, 7)));
    const auto low = hn::TableLookupLanes(hn::LoadU(d, table), half);
    const auto high = hn::TableLookupLanes(hn::LoadU(d, table + Lanes), half);
    return hn::IfThenElse(hn::RebindMask(d, hn::Gt(i, hn::Set(di, 7))), high, low);
  } else {
    return hn::GatherIndex(d, table, i);
  }
}

void near_points(const PointTasks& tasks, std::uint32_t* bits) {
  for (std::size_t t = 0; t < tasks.size; ++t) {
    const std::uint32_t slot = tasks.slots[t], block = tasks.blocks[t];
    const float* one = tasks.packed + slot / n * 3 * n + slot % n;
    const float* table = tasks.squares + tasks.classes[slot] * n;
    bits[t] = 0;
    for (std::size_t first = 0; first < n; first += lanes) {
      const float* some = tasks.packed + block * 3 * n + first;
      const auto x = hn::Sub(hn::LoadU(floats, some), hn::Set(floats, one[0]));
      const auto y = hn::Sub(hn::LoadU(floats, some + n), hn::Set(floats, one[n]));
      const auto z = hn::Sub(hn::LoadU(floats, some + 2 * n), hn::Set(floats, one[2 * n]));
      const auto squared = hn::Add(hn::Add(hn::Mul(x, x), hn::Mul(y, y)), hn::Mul(z, z));
      const auto near = look_up<lanes>(floats, ints, table, tasks.classes + block * n + first);
      // Copies byte by byte: a read wider than the bytes just written would stall.
      std::array<std::uint8_t, 8> mask;
      hn::StoreMaskBits(floats, hn::Not(hn::Lt(near, squared)), mask.data());
      const unsigned part = lanes > 8 ? mask[0] | (unsigned{mask[1]} << 8) : mask[0];
      bits[t] |= part << first;
    }
  }
}

std::size_t touching_boxes(const BoxTasks& tasks, std::uint32_t* hits) {
  // Highway 1.0.3 computes Iota lane by lane, so it is computed once, outside the loop.
  const auto counting = hn::Iota(indices, 0);
  std::size_t count = 0;
  for (std::size_t b = 0; b < tasks.box_count; ++b) {
    const detail::FloatBox& box = tasks.boxes[b];
    for (std::size_t r = 0; r < tasks.row_count; ++r)
      for (std::size_t first = 0; first < n; first += lanes) {
        const auto along = [&](std::size_t k) {
          const auto lower = hn::LoadU(floats, tasks.rows[r].lower.data() + k * n + first);
          const auto upper = hn::LoadU(floats, tasks.rows[r].upper.data() + k * n + first);
          return hn::And(hn::Le(lower, hn::Set(floats, box.upper[k])), hn::Le(hn::Set(floats, box.lower[k]), upper));
        };
        const auto touching = hn::RebindMask(indices, hn::And(hn::And(along(0), along(1)), along(2)));
        const auto numbers = hn::Add(counting, hn::Set(indices, static_cast<std::uint32_t>(r * n + first)));
        // Compresses in a register, as hinge::simd does.
        hn::StoreU(hn::Compress(numbers, touching), indices, hits + count);
        count += hn::CountTrue(indices, touching);
      }
  }
  return count;
}

}  // namespace

template <>
Kernels highway_kernels<detail::simd::compiled_for()>() {
  return {hwy::TargetName(HWY_TARGET), near_points, touching_boxes};
}

}  // namespace hinge::bench
