// SPDX-License-Identifier: BSD-3-Clause
// narrow_phase: the inner loop of engine/simd: float lower bounds of distances against thresholds plus margin.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "hinge/detail/bounds/float_box.hpp"
#include "hinge/detail/engine/simd/candidate_list.hpp"
#include "hinge/detail/engine/simd/cross_model_transform.hpp"
#include "hinge/detail/engine/simd/threshold_classes.hpp"
#include "hinge/detail/primitive/batch.hpp"
#include "hinge/detail/simd/gather_bits.hpp"

namespace hinge::detail {

/// Thresholds plus a margin, and their squares, by rows of the threshold table.
class Thresholds16 {
 public:
  /// Pairs with d <= M + margin are near.
  void set(const ThresholdTable& table, float margin) noexcept {
    margin_ = margin;
    for (std::size_t c = 0; c < table.rows; ++c) {
      const simd::Float16 near = simd::Float16(table.row.data() + c * simd::width) + simd::Float16(margin);
      near.store(plain_.data() + c * simd::width);
      (near * near).store(squares_.data() + c * simd::width);
      largest_squares_[c] = largest(near * near);
      largest_plain_[c] = largest(near);
    }
  }
  float margin() const noexcept { return margin_; }
  const float* plain() const noexcept { return plain_.data(); }
  const float* squares() const noexcept { return squares_.data(); }
  /// The largest value of each row.
  const float* largest_plain() const noexcept { return largest_plain_.data(); }
  const float* largest_squares() const noexcept { return largest_squares_.data(); }

 private:
  float margin_ = 0.0F;
  alignas(64) std::array<float, simd::width * simd::width> plain_{};
  alignas(64) std::array<float, simd::width * simd::width> squares_{};
  std::array<float, simd::width> largest_plain_{}, largest_squares_{};
};

/// Calls visit(position of the single primitive, position of the block, lanes) for every candidate that floats cannot
/// rule out. visit may lower the thresholds; it returns false to stop. It is called for most of what is left in lists
/// of pairs, so it is inlined: an indirect call would cost such lists a tenth. The first loop tests all candidates
/// against the largest threshold of the single primitive's class. The second loop tests the rest lane by lane. Side:
/// SimdSide, or any type that holds floats of P under threshold classes.
template <Primitive P, class Side, class Convert, class Visit>
void narrow_phase(CandidateList& candidates, const Side& one, const Side& sixteen, const Convert& convert,
                  const Thresholds16& thresholds, const Visit& visit) {
  const float *single = one.packed(), *packed = sixteen.packed();
  const std::uint8_t *single_class = one.position_class(), *classes = sixteen.position_class();
  const std::uint32_t *ones = candidates.ones(), *sixteens = candidates.sixteens();
  const simd::Bits* masks = candidates.masks();
  constexpr bool squared = Batch<P>::squared_limits;
  const auto near = [&](std::size_t t, const simd::Float16& limit) __attribute__((always_inline)) {
    return convert(single + ones[t]).near(packed + sixteens[t], limit);
  };
  const auto extra = [&](std::size_t t) __attribute__((always_inline)) {
    return one.extra_at(ones[t]) * convert.scale + sixteen.extra_at(sixteens[t]);
  };
  const bool has_extra = one.has_extra() || sixteen.has_extra();
  CandidateList::Left* left = candidates.left();
  std::size_t left_count = 0;
  const auto rule_out = [&](const auto& limit) __attribute__((always_inline)) {
    const auto lanes = [&](std::size_t t) __attribute__((always_inline)) { return near(t, limit(t)) & masks[t]; };
    // A branch is cheaper if it is almost never taken. It costs twice as much as no branch if it is unpredictable.
    if (candidates.many_left()) {
      for (std::size_t t = 0; t < candidates.size(); ++t) {
        left[left_count] = {static_cast<std::uint32_t>(t), lanes(t)};
        left_count += left[left_count].lanes != 0;
      }
    } else {
      for (std::size_t t = 0; t < candidates.size(); ++t)
        if (const simd::Bits bits = lanes(t); bits != 0) [[unlikely]]
          left[left_count++] = {static_cast<std::uint32_t>(t), bits};
    }
    candidates.set_left(left_count);
  };
  if (has_extra) {
    rule_out([&](std::size_t t) {
      const float distance = thresholds.largest_plain()[single_class[ones[t]]] + extra(t);
      return simd::Float16(squared ? distance * distance : distance);
    });
  } else {
    rule_out([ limits = squared ? thresholds.largest_squares() : thresholds.largest_plain(), ones, single_class ](
        std::size_t t) __attribute__((always_inline)) { return simd::Float16(limits[single_class[ones[t]]]); });
  }
  for (std::size_t k = 0; k < left_count; ++k) {
    const std::size_t t = left[k].candidate, row = single_class[ones[t]] * simd::width;
    const simd::Index16 index(classes + sixteens[t]);
    simd::Float16 limit = look_up((squared && !has_extra ? thresholds.squares() : thresholds.plain()) + row, index);
    if (has_extra) {
      limit = limit + simd::Float16(extra(t));
      if (squared) limit = limit * limit;
    }
    const simd::Bits bits = left[k].lanes & near(t, limit);
    if (bits != 0 && !visit(ones[t], sixteens[t], bits)) return;
  }
}

}  // namespace hinge::detail
