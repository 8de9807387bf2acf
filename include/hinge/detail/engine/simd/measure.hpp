// SPDX-License-Identifier: BSD-3-Clause
// Measure: float distances of candidates, for collectors that need no exact decision.
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>

#include "hinge/core/finite.hpp"
#include "hinge/core/id.hpp"
#include "hinge/detail/engine/simd/float_transform.hpp"
#include "hinge/detail/engine/simd/narrow_phase.hpp"
#include "hinge/detail/engine/simd/simd_side.hpp"
#include "hinge/detail/engine/simd/threshold_classes.hpp"
#include "hinge/detail/simd/lanes.hpp"
#include "hinge/policy/primitive.hpp"

namespace hinge::detail {

/// Made for the present candidates and margin. It does not hold if floats cannot represent the coordinates or the
/// squared thresholds.
class Measure {
 public:
  Measure() = default;
  template <Primitive P, class Convert>
  Measure(const SimdSide<P>& one, const SimdSide<P>& sixteen, const ThresholdTable& table,
          const Thresholds16& thresholds, const Convert& convert, double cutoff) noexcept
      : unit_(1.0 / sixteen.layout().scale) {
    const float near =
        table.largest + thresholds.margin() + one.largest_extra() * convert.scale + sixteen.largest_extra();
    const float extent = std::max(one.blocks().extent(), sixteen.blocks().extent());
    if (extent <= largest_sane_coordinate && is_finite(near * near))
      error_ = convert.band(one, sixteen, table, cutoff) * unit_;
  }

  /// True if distances can be measured.
  bool holds() const noexcept { return is_finite(error_); }

  /// Passes primitive i with the lanes of the sixteen `others` to the collector of `test_pair`, until it is done.
  /// squared: their squared distances in scaled units.
  template <class TestPair>
  [[gnu::always_inline]] void operator()(PrimitiveId i, const std::uint32_t* others, simd::Bits lanes,
                                         const simd::Float16& squared, const TestPair& test_pair) const {
    alignas(64) std::array<float, simd::width> squares;
    squared.store(squares.data());
    for (; lanes != 0 && !test_pair.collector.done(); lanes &= lanes - 1) {
      const auto k = static_cast<std::size_t>(std::countr_zero(lanes));
      const double distance = static_cast<double>(std::sqrt(squares[k])) * unit_;
      test_pair.add_measured(i, id<PrimitiveId>(others[k]), distance, error_);
    }
  }

 private:
  double unit_ = 0.0;  // model unit per scaled unit, a power of two: the product is exact
  double error_ = std::numeric_limits<double>::infinity();
};

}  // namespace hinge::detail
