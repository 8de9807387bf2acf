// SPDX-License-Identifier: BSD-3-Clause
// TreeOperand: one of the two models of a query through trees.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <span>

#include "hinge/core/id.hpp"
#include "hinge/detail/bounds/float_box.hpp"
#include "hinge/detail/engine/simd/tree/placed_trees.hpp"
#include "hinge/detail/engine/simd/tree/relative_transform.hpp"
#include "hinge/detail/engine/simd/tree/tree_parts.hpp"
#include "hinge/detail/query/pair_threshold.hpp"
#include "hinge/model/state.hpp"

namespace hinge::detail {

/// Trees, coordinates and extra clearances of one model in a query. Refers to the caller's objects.
template <Primitive P>
struct TreeOperand {
  PlacedTrees<P>& trees;
  State<P>& state;
  std::span<const double> clearance;

  /// The tree part of a link.
  const TreePart& part(std::size_t p) const noexcept { return trees.parts().links.parts[p]; }
  double clearance_at(const TreePart& part) const noexcept { return clearance_of(clearance, id<GroupId>(part.group)); }
  double clearance_at(std::size_t p) const noexcept { return clearance_at(part(p)); }
  double largest_clearance() const noexcept {
    double most = 0.0;
    for (const double c : clearance) most = std::max(most, c);
    return most;
  }
  PrimitiveId primitive(std::uint32_t slot) const noexcept { return id<PrimitiveId>(trees.parts().store.slots[slot]); }
  RelativeTransform turn(const TreePart& a, const TreeOperand& other, const TreePart& b) const noexcept {
    return {trees.frame(a.group),       trees.parts().scale,       a.extent,
            other.trees.frame(b.group), other.trees.parts().scale, b.extent};
  }
  /// A length in tree units, rounded up, with room for the rounding of a few sums.
  float scaled(double length) const noexcept {
    const double there = length * trees.parts().scale;
    return float_above(there + std::abs(there) * 0x1p-20);
  }
};

}  // namespace hinge::detail
