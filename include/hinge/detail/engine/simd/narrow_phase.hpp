// SPDX-License-Identifier: BSD-3-Clause
// NarrowPhase: the inner loop of engine/simd: float lower bounds of distances against thresholds plus margin.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

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

/// Finds the candidates that floats cannot rule out. It knows no filter and no collector, so all queries share its
/// code. Side: SimdSide, or any type that holds floats of P under threshold classes.
template <Primitive P, class Side, class Convert>
class NarrowPhase {
 public:
  /// Tests all candidates against the largest threshold of the class of their single primitive.
  [[gnu::noinline]] NarrowPhase(CandidateList& candidates, const Side& one, const Side& sixteen, const Convert& convert,
                                const Thresholds16& thresholds)
      : candidates_(candidates), one_(one), sixteen_(sixteen), convert_(convert), thresholds_(thresholds) {
    const std::uint8_t* const classes = one.position_class();
    if (has_extra_)
      rule_out([&](std::size_t t) {
        const float distance = thresholds.largest_plain()[classes[candidates.ones()[t]]] + extra(t);
        return simd::Float16(squared ? distance * distance : distance);
      });
    else
      rule_out([
        classes, ones = candidates.ones(), limits = squared ? thresholds.largest_squares() : thresholds.largest_plain()
      ](std::size_t t) __attribute__((always_inline)) { return simd::Float16(limits[classes[ones[t]]]); });
  }

  /// Calls visit(position of the floats of the single primitive, position of the block, lanes) for every candidate that
  /// remains when its lanes are tested one by one, until visit returns false. thresholds_fall: visit may lower
  /// the thresholds, so it is called before the next candidate is tested.
  template <class Visit>
  [[gnu::always_inline]] void each(bool thresholds_fall, const Visit& visit) {
    // A yes/no query often ends at the first candidate. Later ones are tested in batches before their visits.
    for (std::size_t most = 1;; most = thresholds_fall ? 1 : std::min(2 * most, candidates_.near().size())) {
      const std::span<const Near> found = next(most);
      if (found.empty()) return;
      for (const Near& near : found)
        if (!visit(near.one, near.sixteen, near.lanes)) return;
    }
  }

 private:
  static constexpr bool squared = Batch<P>::squared_limits;
  using Near = CandidateList::Near;

  /// Returns the next candidates that remain under the present thresholds: 1 to `most` of them, or none at the end.
  [[gnu::noinline]] std::span<const Near> next(std::size_t most) noexcept {
    const std::uint32_t *ones = candidates_.ones(), *sixteens = candidates_.sixteens();
    const CandidateList::Left* const left = candidates_.left();
    const float* const limits = squared && !has_extra_ ? thresholds_.squares() : thresholds_.plain();
    auto& found = candidates_.near();
    std::size_t count = 0;
    for (; tested_ < left_ && count < most; ++tested_) {
      const std::size_t t = left[tested_].candidate, row = one_.position_class()[ones[t]] * simd::width;
      simd::Float16 limit = look_up(limits + row, simd::Index16(sixteen_.position_class() + sixteens[t]));
      if (has_extra_) {
        limit = limit + simd::Float16(extra(t));
        if (squared) limit = limit * limit;
      }
      found[count] = {ones[t], sixteens[t], left[tested_].lanes & near(t, limit)};
      count += found[count].lanes != 0;
    }
    return {found.data(), count};
  }

  [[gnu::always_inline]] simd::Bits near(std::size_t t, const simd::Float16& limit) const noexcept {
    return convert_(one_.packed() + candidates_.ones()[t]).near(sixteen_.packed() + candidates_.sixteens()[t], limit);
  }
  [[gnu::always_inline]] float extra(std::size_t t) const noexcept {
    return one_.extra_at(candidates_.ones()[t]) * convert_.scale + sixteen_.extra_at(candidates_.sixteens()[t]);
  }

  template <class Limit>
  [[gnu::always_inline]] void rule_out(const Limit& limit) noexcept {
    CandidateList::Left* const left = candidates_.left();
    const simd::Bits* const masks = candidates_.masks();
    const auto lanes = [&](std::size_t t) __attribute__((always_inline)) { return near(t, limit(t)) & masks[t]; };
    std::size_t count = 0;
    // A branch is cheaper if it is almost never taken. It costs twice as much as no branch if it is unpredictable.
    if (candidates_.many_left()) {
      for (std::size_t t = 0; t < candidates_.size(); ++t) {
        left[count] = {static_cast<std::uint32_t>(t), lanes(t)};
        count += left[count].lanes != 0;
      }
    } else {
      for (std::size_t t = 0; t < candidates_.size(); ++t)
        if (const simd::Bits bits = lanes(t); bits != 0) [[unlikely]]
          left[count++] = {static_cast<std::uint32_t>(t), bits};
    }
    candidates_.set_left(count);
    left_ = count;
  }

  CandidateList& candidates_;
  const Side &one_, &sixteen_;
  const Convert convert_;
  const Thresholds16& thresholds_;
  bool has_extra_ = one_.has_extra() || sixteen_.has_extra();
  std::size_t left_ = 0, tested_ = 0;  // candidates that the first test left, and those of them that next() has tested
};

}  // namespace hinge::detail
