// SPDX-License-Identifier: BSD-3-Clause
// The threshold of a pair and the extra clearance of a group, as the rules of queries use them.
#pragma once

#include <span>

#include "hinge/core/id.hpp"
#include "hinge/policy/distance_matrix.hpp"

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

}  // namespace hinge::detail
