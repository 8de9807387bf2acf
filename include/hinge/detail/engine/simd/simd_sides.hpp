// SPDX-License-Identifier: BSD-3-Clause
// SimdSides: the layouts of one model that the queries of engine/simd choose from.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "hinge/detail/engine/simd/block_layout.hpp"
#include "hinge/detail/engine/simd/placed_blocks.hpp"
#include "hinge/detail/engine/simd/simd_side.hpp"
#include "hinge/detail/engine/simd/threshold_classes.hpp"
#include "hinge/detail/model/out_of_reach.hpp"
#include "hinge/model/selected_model.hpp"
#include "hinge/policy/distance_matrix.hpp"
#include "hinge/policy/pair_filter.hpp"
#include "hinge/policy/primitive.hpp"

namespace hinge::detail {

/// Which primitives a query leaves out.
enum class LeftOut : std::uint8_t {
  none,
  never_colliding,  ///< those whose thresholds are all 0: for queries without a margin
  /// These, and those at rest that nothing can approach: for self-queries without a margin, while the poses of the
  /// groups follow from the joints.
  out_of_reach,
};

/// One side has blocks by rigid group; another has blocks by index, for coordinates given from outside. Each has
/// variants without the point-like primitives that cannot take part in a query.
template <Primitive P>
class SimdSides {
 public:
  template <DistanceMatrix D>
  SimdSides(const SelectedModel<P>& model, const D& matrix) {
    if constexpr (IsPointLike<P>) {
      const auto count = [](const std::vector<std::uint8_t>& flags) {
        return static_cast<std::size_t>(std::count(flags.begin(), flags.end(), std::uint8_t{1}));
      };
      never_collides_ = zero_thresholds(matrix, model.size());
      const std::size_t without_threshold = count(never_collides_);
      all_never_collide_ = without_threshold == model.size();
      out_of_reach_ = out_of_reach(model, matrix);
      for (std::size_t i = 0; i < model.size(); ++i) out_of_reach_[i] |= never_collides_[i];
      if (count(out_of_reach_) < without_threshold + model.size() / 16) out_of_reach_.clear();
      if (without_threshold == 0) never_collides_.clear();
    }
  }

  /// True if every primitive is point-like and all thresholds are 0.
  bool all_never_collide() const noexcept { return all_never_collide_; }

  /// Returns a side, made at its first use. deform: rigid groups may deform.
  template <PairFilter F, DistanceMatrix D>
  SimdSide<P>& side(const SelectedModel<P>& model, const F& filter, const D& matrix, bool deform, LeftOut left_out) {
    if (left_out == LeftOut::out_of_reach && out_of_reach_.empty()) left_out = LeftOut::never_colliding;
    if (left_out == LeftOut::never_colliding && never_collides_.empty()) left_out = LeftOut::none;
    std::optional<SimdSide<P>>& chosen = sides_[2 * static_cast<std::size_t>(left_out) + std::size_t{deform}];
    if (!chosen) {
      std::span<const std::uint8_t> flags;
      if (left_out == LeftOut::never_colliding) flags = never_collides_;
      if (left_out == LeftOut::out_of_reach) flags = out_of_reach_;
      chosen.emplace(std::make_shared<const SimdParts<P>>(
                         deform ? BlockLayout::by_index(model, flags) : BlockLayout::by_groups(model, flags),
                         ThresholdClasses(matrix, model.size()), model),
                     model, filter, deform);
    }
    return *chosen;
  }

 private:
  std::vector<std::uint8_t> never_collides_;  // per primitive; empty: every primitive may collide
  std::vector<std::uint8_t> out_of_reach_;    // per primitive, also those of never_collides_; empty: too few more
  bool all_never_collide_ = false;
  std::array<std::optional<SimdSide<P>>, 6> sides_;
};

}  // namespace hinge::detail
