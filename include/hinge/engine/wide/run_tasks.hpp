// SPDX-License-Identifier: BSD-3-Clause
// run_tasks: the inner loop of engine/wide. Float lower bounds of distances against thresholds plus margin.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "hinge/bounds/float_box.hpp"
#include "hinge/engine/wide/tasks.hpp"
#include "hinge/engine/wide/wide_side.hpp"
#include "hinge/primitive/batch.hpp"
#include "hinge/simd/gather_bits.hpp"

namespace hinge {

/// Coordinates of one model as they are.
template <Primitive P>
struct Exactly {
  [[gnu::always_inline]] typename Batch<P>::One operator()(const float* at, std::size_t lane) const noexcept {
    return {at, lane};
  }
  float scale = 1.0F;
};

/// Coordinates of one model in the origin and scale of another.
template <Primitive P>
struct Into {
  Into(const WideSide<P>& from, const WideSide<P>& to) noexcept
      : scale(static_cast<float>(to.layout().scale / from.layout().scale)) {
    for (std::size_t k = 0; k < 3; ++k) {
      const auto i = static_cast<Eigen::Index>(k);
      shift[k] = static_cast<float>((from.state().origin()[i] - to.state().origin()[i]) * to.layout().scale);
    }
  }
  [[gnu::always_inline]] typename Batch<P>::One operator()(const float* at, std::size_t lane) const noexcept {
    return {at, lane, scale, shift};
  }
  FloatBox operator()(FloatBox box) const noexcept {
    for (std::size_t k = 0; k < 3; ++k) {
      box.lower[k] = box.lower[k] * scale + shift[k];
      box.upper[k] = box.upper[k] * scale + shift[k];
    }
    return box;
  }
  FloatBox back(FloatBox box) const noexcept {
    for (std::size_t k = 0; k < 3; ++k) {
      box.lower[k] = (box.lower[k] - shift[k]) / scale;
      box.upper[k] = (box.upper[k] - shift[k]) / scale;
    }
    return box;
  }
  float scale = 1.0F;
  std::array<float, 3> shift{};
};

/// Thresholds plus a margin, and their squares, row by row.
class Thresholds16 {
 public:
  /// What is within `margin` of a threshold of the table, or closer, is near.
  void set(const ThresholdTable& table, float margin) noexcept {
    margin_ = margin;
    for (std::size_t c = 0; c < simd::width; ++c) {
      const simd::Float16 near = simd::Float16(table.row.data() + c * simd::width) + simd::Float16(margin);
      near.store(plain_.data() + c * simd::width);
      (near * near).store(squares_.data() + c * simd::width);
    }
  }
  float margin() const noexcept { return margin_; }
  const float* plain() const noexcept { return plain_.data(); }
  const float* squares() const noexcept { return squares_.data(); }

 private:
  float margin_ = 0.0F;
  alignas(64) std::array<float, simd::width * simd::width> plain_{};
  alignas(64) std::array<float, simd::width * simd::width> squares_{};
};

/// Calls visit(slot of `one`, block of `sixteen`, lanes) for every task that floats cannot rule out; visit may lower
/// the thresholds and answers false to stop.
template <Primitive P, class Convert, class Visit>
void run_tasks(const Tasks& tasks, const WideSide<P>& one, const WideSide<P>& sixteen, const Convert& convert,
               const Thresholds16& thresholds, const Visit& visit) {
  constexpr std::size_t n = simd::width;
  const float *single = one.state().packed(0), *packed = sixteen.state().packed(0);
  const std::uint8_t *single_class = one.parts().slot_class.data(), *classes = sixteen.parts().slot_class.data();
  const std::uint16_t* masks = sixteen.near().masks();
  const float *plain = thresholds.plain(), *squares = thresholds.squares();
  const bool extra = one.has_extra() || sixteen.has_extra();
  const std::uint32_t *slots = tasks.slots(), *blocks = tasks.blocks(), *mask = tasks.masks();
  const std::size_t size = tasks.size();
  for (std::size_t t = 0; t < size; ++t) {
    const std::uint32_t slot = slots[t], block = blocks[t];
    const std::size_t own = slot / n;
    const simd::Float16 squared =
        convert(single + own * Batch<P>::floats, slot % n).squared_distances(packed + block * Batch<P>::floats);
    const std::size_t row = single_class[slot] * n;
    const simd::Index16 index(classes + block * n);
    simd::Float16 near = look_up(squares + row, index);
    if (extra) {
      const float more = one.extra(static_cast<std::uint32_t>(own)) * convert.scale + sixteen.extra(block);
      near = look_up(plain + row, index) + simd::Float16(more);
      near = near * near;
    }
    // Not "where it is less": what overflowed or is no number has to be looked at.
    const simd::Bits bits = ~less(near, squared) & masks[mask[t]];
    if (bits != 0 && !visit(slot, block, bits)) return;
  }
}

}  // namespace hinge
