// SPDX-License-Identifier: BSD-3-Clause
// Identity and CrossModelTransform: read the coordinates of a candidate's single primitive, in its own model or
// transformed into another model, with the float error of the distances.
#pragma once

#include <array>
#include <cmath>
#include <cstddef>

#include "hinge/detail/bounds/float_box.hpp"
#include "hinge/detail/engine/simd/float_transform.hpp"
#include "hinge/detail/engine/simd/simd_side.hpp"
#include "hinge/detail/engine/simd/threshold_classes.hpp"
#include "hinge/detail/primitive/batch.hpp"

namespace hinge::detail {

/// Reads coordinates of the same model: no transform.
template <Primitive P>
struct Identity {
  [[gnu::always_inline]] typename Batch<P>::One operator()(const float* at) const noexcept {
    return typename Batch<P>::One(at);
  }
  /// Bound of the error of float distances, scaled, for the largest threshold plus |cutoff| and extra clearances.
  double band(const SimdSide<P>& one, const SimdSide<P>&, const ThresholdTable& table, double cutoff) const noexcept {
    return one.blocks().band(static_cast<double>(table.largest) + std::abs(cutoff * one.layout().scale) +
                             2 * static_cast<double>(one.largest_extra()));
  }
  float scale = 1.0F;
};

/// Transforms coordinates into the origin and scale of another model.
template <Primitive P>
struct CrossModelTransform {
  CrossModelTransform(const SimdSide<P>& from, const SimdSide<P>& to) noexcept
      : scale(static_cast<float>(to.layout().scale / from.layout().scale)) {
    for (std::size_t k = 0; k < 3; ++k) {
      const auto i = static_cast<Eigen::Index>(k);
      shift[k] = static_cast<float>((from.blocks().origin()[i] - to.blocks().origin()[i]) * to.layout().scale);
    }
  }
  /// True if floats can hold both models in one unit.
  bool holds() const noexcept {
    bool all = scale >= 0x1p-60F && scale <= 0x1p60F;
    for (const float s : shift) all = all && std::abs(s) <= largest_sane_coordinate;
    return all;
  }
  [[gnu::always_inline]] typename Batch<P>::One operator()(const float* at) const noexcept {
    return {at, scale, shift};
  }
  /// Bound of the error of float distances between the two models, in the scale of `sixteen`.
  double band(const SimdSide<P>& one, const SimdSide<P>& sixteen, const ThresholdTable& table,
              double cutoff) const noexcept {
    const auto ratio = static_cast<double>(scale);
    double largest = static_cast<double>(table.largest) + std::abs(cutoff * sixteen.layout().scale) +
                     static_cast<double>(sixteen.largest_extra()) + ratio * static_cast<double>(one.largest_extra());
    // The shift rounds once more, relative to its own size.
    for (const float s : shift) largest += 2 * std::abs(static_cast<double>(s));
    return sixteen.blocks().band(largest) + 2 * ratio * one.blocks().band(0.0);
  }
  /// Box in the other model's unit and origin.
  FloatBox operator()(FloatBox box) const noexcept {
    for (std::size_t k = 0; k < 3; ++k) {
      box.lower[k] = box.lower[k] * scale + shift[k];
      box.upper[k] = box.upper[k] * scale + shift[k];
    }
    return box;
  }
  /// The inverse transform of a box.
  FloatBox back(FloatBox box) const noexcept {
    for (std::size_t k = 0; k < 3; ++k) {
      box.lower[k] = (box.lower[k] - shift[k]) / scale;
      box.upper[k] = (box.upper[k] - shift[k]) / scale;
    }
    return box;
  }
  float scale = 1.0F;
  std::array<float, 3> shift{};
};

}  // namespace hinge::detail
