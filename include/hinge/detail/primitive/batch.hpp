// SPDX-License-Identifier: BSD-3-Clause
// Batch<P> for every primitive, and what some batches can do more.
#pragma once

#include <array>
#include <concepts>

#include "hinge/detail/bounds/float_box.hpp"
#include "hinge/detail/primitive/box_batch.hpp"
#include "hinge/detail/primitive/hull_batch.hpp"
#include "hinge/detail/simd/lanes.hpp"

namespace hinge::detail {

/// Optional: a batch of one rigid group is transformed in float, without access to the primitives.
template <class P>
concept TransformsBatch = requires(const float* local, const std::array<float, 9>& rotation,
                                   const std::array<float, 3>& translation, float* to) {
  { Batch<P>::turn(local, rotation, translation, to) } -> std::same_as<FloatBox>;
};

/// Optional: squared_distances(), up to rounding.
template <class P>
concept MeasuresDistances = requires {
  requires Batch<P>::measures;
};

/// Optional: two primitives of batches can be transformed and compared without their batches. extent: the largest
/// magnitude of a coordinate.
template <class P>
concept ComparesTwo = TransformsBatch<P> &&
    requires(const typename Batch<P>::One& one, const std::array<float, 9>& rotation,
             const std::array<float, 3>& translation) {
  { one.turned(rotation, translation) } -> std::same_as<typename Batch<P>::One>;
  { one.closer_than(one, 0.0F) } -> std::same_as<bool>;
  { one.extent() } -> std::same_as<float>;
};

}  // namespace hinge::detail
