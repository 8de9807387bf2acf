// SPDX-License-Identifier: BSD-3-Clause
// WideSides: the sides of one model that engine/wide's queries choose from.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "hinge/detail/engine/wide/block_layout.hpp"
#include "hinge/detail/engine/wide/threshold_classes.hpp"
#include "hinge/detail/engine/wide/wide_side.hpp"
#include "hinge/detail/engine/wide/wide_state.hpp"
#include "hinge/model/placement.hpp"
#include "hinge/model/selected_model.hpp"
#include "hinge/policy/distance_matrix.hpp"
#include "hinge/policy/pair_filter.hpp"
#include "hinge/policy/primitive.hpp"

namespace hinge::detail {

/// Blocks by rigid groups, and by index for coordinates from elsewhere. Where some primitives are idle (they have no
/// body and no threshold above 0), there is another side of each that holds the others alone, for queries without a
/// margin. A side is made when it is first present.
template <Primitive P>
class WideSides {
 public:
  template <DistanceMatrix D>
  WideSides(const SelectedModel<P>& model, const D& matrix) {
    if constexpr (HasNoBody<P>) {
      idle_ = zero_thresholds(matrix, model.size());
      const auto count = static_cast<std::size_t>(std::count(idle_.begin(), idle_.end(), std::uint8_t{1}));
      all_idle_ = count == model.size();
      if (count == 0) idle_.clear();
    }
  }

  bool all_idle() const noexcept { return all_idle_; }

  template <PairFilter F, DistanceMatrix D>
  WideSide<P>& present(const Placement<P>& placement, const F& filter, const D& matrix, bool without_margin) {
    const bool deform = placement.groups_may_deform(), fewer = without_margin && !idle_.empty();
    std::optional<WideSide<P>>& side = sides_[2 * std::size_t{deform} + std::size_t{fewer}];
    if (!side) {
      const SelectedModel<P>& model = placement.model();
      const std::span<const std::uint8_t> left_out = fewer ? std::span(idle_) : std::span<const std::uint8_t>();
      side.emplace(std::make_shared<const WideParts<P>>(
                       deform ? BlockLayout::by_index(model, left_out) : BlockLayout::by_groups(model, left_out),
                       ThresholdClasses(matrix, model.size()), model),
                   model, filter, deform);
    }
    return *side;
  }

 private:
  std::vector<std::uint8_t> idle_;  // per primitive; empty: none is
  bool all_idle_ = false;
  std::array<std::optional<WideSide<P>>, 4> sides_;
};

}  // namespace hinge::detail
