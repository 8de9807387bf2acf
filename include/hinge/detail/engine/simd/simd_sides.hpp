// SPDX-License-Identifier: BSD-3-Clause
// SimdSides: the layouts of one model that the queries of engine/simd choose from.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "hinge/detail/engine/simd/block_layout.hpp"
#include "hinge/detail/engine/simd/placed_blocks.hpp"
#include "hinge/detail/engine/simd/simd_side.hpp"
#include "hinge/detail/engine/simd/threshold_classes.hpp"
#include "hinge/model/selected_model.hpp"
#include "hinge/policy/distance_matrix.hpp"
#include "hinge/policy/pair_filter.hpp"
#include "hinge/policy/primitive.hpp"

namespace hinge::detail {

/// One side has blocks by rigid group; another has blocks by index, for coordinates given from outside. If some
/// primitives never collide (point-like, all thresholds 0), each of the two has a variant without them, for queries
/// without a margin.
template <Primitive P>
class SimdSides {
 public:
  template <DistanceMatrix D>
  SimdSides(const SelectedModel<P>& model, const D& matrix) {
    if constexpr (IsPointLike<P>) {
      never_collides_ = zero_thresholds(matrix, model.size());
      const auto count =
          static_cast<std::size_t>(std::count(never_collides_.begin(), never_collides_.end(), std::uint8_t{1}));
      all_never_collide_ = count == model.size();
      if (count == 0) never_collides_.clear();
    }
  }

  /// True if every primitive is point-like and all thresholds are 0.
  bool all_never_collide() const noexcept { return all_never_collide_; }

  /// Returns a side, made at its first use. deform: rigid groups may deform. without_margin: skip primitives that never
  /// collide.
  template <PairFilter F, DistanceMatrix D>
  SimdSide<P>& side(const SelectedModel<P>& model, const F& filter, const D& matrix, bool deform, bool without_margin) {
    const bool fewer = without_margin && !never_collides_.empty();
    std::optional<SimdSide<P>>& chosen = sides_[2 * std::size_t{deform} + std::size_t{fewer}];
    if (!chosen) {
      const std::span<const std::uint8_t> left_out =
          fewer ? std::span(never_collides_) : std::span<const std::uint8_t>();
      chosen.emplace(std::make_shared<const SimdParts<P>>(
                         deform ? BlockLayout::by_index(model, left_out) : BlockLayout::by_groups(model, left_out),
                         ThresholdClasses(matrix, model.size()), model),
                     model, filter, deform);
    }
    return *chosen;
  }

 private:
  std::vector<std::uint8_t> never_collides_;  // per primitive; empty: every primitive may collide
  bool all_never_collide_ = false;
  std::array<std::optional<SimdSide<P>>, 4> sides_;
};

}  // namespace hinge::detail
