// SPDX-License-Identifier: BSD-3-Clause
// SelfRules and CrossRules: the threshold and the admission of pairs in one query, within a model or between two.
#pragma once

#include <span>

#include "hinge/core/id.hpp"
#include "hinge/model/placement.hpp"
#include "hinge/policy/distance_matrix.hpp"
#include "hinge/policy/pair_filter.hpp"
#include "hinge/policy/primitive.hpp"
#include "hinge/query/query_options.hpp"

namespace hinge::detail {

/// Returns the extra clearance of a group, or 0 when the list is empty.
inline double clearance_of(std::span<const double> clearance, GroupId group) noexcept {
  return clearance.empty() ? 0.0 : clearance[index(group)];
}

/// Returns the threshold for closer_than: M as a double, or the exact terms of a radius sum.
template <DistanceMatrix D>
auto threshold_of(const D& matrix, PrimitiveId i, PrimitiveId j) noexcept {
  if constexpr (AdditiveRadii<D>)
    return matrix.sum(i, j);
  else
    return matrix.threshold(i, j);
}
template <CrossMatrix D>
auto threshold_of(const D& matrix, PrimitiveId i, const D& other, PrimitiveId j) noexcept {
  if constexpr (AdditiveRadii<D>)
    return matrix.sum(i, other, j);
  else
    return matrix.threshold(i, other, j);
}

/// Pairs inside one model. A view that is valid during one query.
template <Primitive P, PairFilter F, DistanceMatrix D>
struct SelfRules {
  Placement<P>& placement;
  const F& filter;
  const D& matrix;
  const QueryOptions& options;

  auto threshold(PrimitiveId i, PrimitiveId j) const noexcept {
    const auto m = threshold_of(matrix, i, j);
    if (options.clearance.empty()) return m;
    const auto& model = placement.model();
    return m +
           (clearance_of(options.clearance, model.group_of(i)) + clearance_of(options.clearance, model.group_of(j)));
  }
  /// Returns true when the filter admits the pair, its distance is not constant and, in moved-only queries, the two
  /// groups moved relative to each other.
  bool admits(PrimitiveId i, PrimitiveId j) const noexcept {
    const auto& model = placement.model();
    return filter.admits(i, j) && !placement.constant(i, j) &&
           (!options.moved_only || placement.moved_apart(model.group_of(i), model.group_of(j)));
  }
};

/// Pairs of two models: i of the first, j of the second. A view that is valid during one query.
template <Primitive P, PairFilter F, CrossMatrix D>
struct CrossRules {
  Placement<P>& first;
  Placement<P>& second;
  const F& filter;
  const D& first_matrix;
  const D& second_matrix;
  const QueryOptions& options;

  auto threshold(PrimitiveId i, PrimitiveId j) const noexcept {
    return threshold_of(first_matrix, i, second_matrix, j) +
           (clearance_of(options.clearance, first.model().group_of(i)) +
            clearance_of(options.other_clearance, second.model().group_of(j)));
  }
  bool admits(PrimitiveId i, PrimitiveId j) const noexcept {
    return filter.admits(i, j) &&
           (!options.moved_only || first.moved(first.model().group_of(i)) || second.moved(second.model().group_of(j)));
  }
};

}  // namespace hinge::detail
