// SPDX-License-Identifier: BSD-3-Clause
// LargestThreshold: an upper bound of the thresholds of a model, so no d - M is below its negative.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "hinge/core/id.hpp"
#include "hinge/policy/distance_matrix.hpp"

namespace hinge::detail {

/// Upper bounds in the model's length unit. With a typed matrix they are the exact largest thresholds of the types that
/// occur.
template <DistanceMatrix D>
class LargestThreshold {
 public:
  /// n: number of primitives of the matrix.
  LargestThreshold(const D& matrix, std::size_t n) {
    if constexpr (TypedThresholdMatrix<D>) {
      occurs_.resize(matrix.type_count());
      to_type_.resize(matrix.type_count());
      for (std::size_t i = 0; i < n; ++i) occurs_[matrix.type(id<PrimitiveId>(i))] = 1;
      for (std::size_t s = 0; s < occurs_.size(); ++s)
        for (std::size_t t = 0; t < occurs_.size() && occurs_[s] != 0; ++t)
          to_type_[t] = std::max(to_type_[t], matrix.between_types(s, t));
    } else {
      for (std::size_t i = 0; i < n; ++i) reach_ = std::max(reach_, matrix.reach(id<PrimitiveId>(i)));
    }
  }

  /// Bound for pairs within this model.
  double within() const noexcept { return between(*this); }
  /// Bound for pairs between this model and another model with a compatible matrix.
  double between(const LargestThreshold& other) const noexcept {
    if constexpr (!TypedThresholdMatrix<D>) return reach_ + other.reach_;
    double largest = 0.0;
    for (std::size_t t = 0; t < std::min(to_type_.size(), other.occurs_.size()); ++t)
      if (other.occurs_[t] != 0) largest = std::max(largest, to_type_[t]);
    return largest;
  }

 private:
  std::vector<std::uint8_t> occurs_;  // per type: 1 if a primitive has it
  std::vector<double> to_type_;       // per type: the largest threshold between it and a type of this model
  double reach_ = 0.0;
};

}  // namespace hinge::detail
