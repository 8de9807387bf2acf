// SPDX-License-Identifier: BSD-3-Clause
// Batch<P> for every primitive, and what some batches can do more.
#pragma once

#include <array>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <span>

#include "hinge/core/vec3.hpp"
#include "hinge/detail/bounds/float_box.hpp"
#include "hinge/detail/primitive/box_batch.hpp"
#include "hinge/detail/primitive/hull_batch.hpp"
#include "hinge/detail/simd/lanes.hpp"
#include "hinge/policy/primitive.hpp"

namespace hinge::detail {

/// Stores what Batch<P>::place() keeps, the radii, of the sixteen primitives `members` in the block at `at`.
template <Primitive P>
void set_radii([[maybe_unused]] float* at, [[maybe_unused]] std::span<const std::uint32_t> members,
               [[maybe_unused]] std::span<const P> primitives, [[maybe_unused]] double scale) noexcept {
  if constexpr (Batch<P>::floats > Batch<P>::coordinates)
    for (std::size_t k = 0; k < simd::width; ++k) Batch<P>::set(at, k, primitives[members[k]], Vec3::Zero(), scale);
}

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
