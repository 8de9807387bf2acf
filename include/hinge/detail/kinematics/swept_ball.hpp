// SPDX-License-Identifier: BSD-3-Clause
// SweptBall: a set that contains all positions of a ball while the joints of a chain move within intervals.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

#include "hinge/core/vec3.hpp"
#include "hinge/detail/core/sincos.hpp"
#include "hinge/kinematics/joint.hpp"

namespace hinge::detail {

/// A joint axis at the midpoint of an interval of joint values, and the half width of the interval.
struct AxisInterval {
  JointKind kind = JointKind::revolute;
  Vec3 axis = Vec3::UnitZ();  ///< unit length
  Vec3 point = Vec3::Zero();  ///< a point of the line; unused for prismatic joints
  double half = 0.0;          ///< rad or model length unit, >= 0
  double sine = 0.0;          ///< largest |sin| of the deviation from the midpoint
  double cosine = 1.0;        ///< smallest cos of the deviation, at least 0
  double chord = 0.0;         ///< 2 sin(half / 2): largest change of a unit vector
  std::size_t joint = 0;      ///< label of the joint in add_shares()

  void set_half(double value) noexcept {
    constexpr double quarter = 1.5707963267948966, half_turn = 3.141592653589793;
    half = value;
    const SinCos sc = sincos(std::min(value, quarter));
    sine = value < quarter ? sc.sin : 1.0;
    cosine = value < quarter ? std::max(sc.cos, 0.0) : 0.0;
    chord = value < half_turn ? 2.0 * sincos(value / 2.0).sin : 2.0;
  }
};

/// The set of points centre + sum of s_k generator_k + a ball of radius `growth`, with |s_k| <= 1 (a Minkowski sum). It
/// contains every position of a point. Each sweep below replaces the set by one that contains all its images under a
/// joint, in real arithmetic. Callers add the rounding error. docs/explanation/collision_matrix.md derives both.
class SweptBall {
 public:
  static constexpr std::size_t most_generators = 12;  // further generators are added to the growth

  explicit SweptBall(const Vec3& middle = Vec3::Zero()) noexcept : centre_(middle) {}

  /// Sweeps the set over the interval of one joint. Apply the joints in order, nearest to the ball first.
  void sweep(const AxisInterval& by) noexcept {
    if (by.half == 0.0) return;
    if (by.kind == JointKind::prismatic) return add(by.axis * by.half, by.joint);
    const Vec3 from = centre_ - by.point;
    const Vec3 foot = by.point + by.axis * dot(by.axis, from);
    const Vec3 arm = centre_ - foot;
    turn_generators(by);
    turned_ += by.chord;
    if (by.half > widest_arc) {
      // A wide arc lies in a ball around the middle of its chord, or around the axis when it is a half turn or more.
      const double length = std::sqrt(squared_norm(arm));
      centre_ = foot + arm * by.cosine;
      grow(length * by.sine, by.joint);
    } else {
      // The position is arm cos t + (axis x arm) sin t, with cos t between `cosine` and 1.
      const double sagitta = 0.5 * (1.0 - by.cosine);
      centre_ = foot + arm * (1.0 - sagitta);
      grow(std::sqrt(squared_norm(arm)) * sagitta, by.joint);
      add(cross(by.axis, arm) * by.sine, by.joint);
    }
  }

  const Vec3& centre() const noexcept { return centre_; }
  double growth() const noexcept { return growth_; }
  /// Upper bound on the change of a unit vector carried along.
  double turned() const noexcept { return std::min(turned_, 2.0); }
  /// Half the extent of the generators' sum along n.
  double generators_along(const Vec3& n) const noexcept {
    double sum = 0.0;
    for (std::size_t k = 0; k < count_; ++k) sum += std::abs(dot(n, generator_[k]));
    return sum;
  }
  /// Upper bound of half the largest extent in any direction.
  double extent() const noexcept {
    double sum = growth_;
    for (std::size_t k = 0; k < count_; ++k) sum += std::sqrt(squared_norm(generator_[k]));
    return sum;
  }
  /// Adds the contribution of each joint to the extent along n, to shares[label].
  template <class Shares>
  void add_shares(const Vec3& n, Shares& shares) const noexcept {
    for (std::size_t k = 0; k < count_; ++k) shares[label_[k]] += std::abs(dot(n, generator_[k]));
    for (std::size_t k = 0; k < grown_; ++k) shares[grown_by_[k]] += grown_length_[k];
  }

 private:
  // Half width (rad) above which the arc is replaced by a ball around the middle of its chord. Above it the sagitta is
  // as large as the saving of a segment along the chord. The bound holds for any value up to pi / 2.
  static constexpr double widest_arc = 0.8;

  void turn_generators(const AxisInterval& by) noexcept {
    double more = 0.0;
    std::size_t kept = 0;
    for (std::size_t k = 0; k < count_; ++k) {
      const Vec3 along = by.axis * dot(by.axis, generator_[k]);
      const double across = std::sqrt(squared_norm(Vec3(generator_[k] - along)));
      if (by.half > widest_arc) {
        // The component across the axis may point in any direction.
        more += across;
        generator_[kept] = along;
      } else {
        more += by.chord * across;
        generator_[kept] = generator_[k];
      }
      label_[kept++] = label_[k];
    }
    count_ = kept;
    grow(more, by.joint);
  }

  void add(const Vec3& generator, std::size_t label) noexcept {
    if (count_ == most_generators) return grow(std::sqrt(squared_norm(generator)), label);
    generator_[count_] = generator;
    label_[count_++] = label;
  }

  void grow(double length, std::size_t label) noexcept {
    growth_ += length;
    if (grown_ > 0 && (grown_by_[grown_ - 1] == label || grown_ == most_generators)) {
      grown_length_[grown_ - 1] += length;
      return;
    }
    grown_by_[grown_] = label;
    grown_length_[grown_++] = length;
  }

  Vec3 centre_;
  double growth_ = 0.0;
  double turned_ = 0.0;
  std::size_t count_ = 0;
  std::array<Vec3, most_generators> generator_;
  std::array<std::size_t, most_generators> label_{};
  std::size_t grown_ = 0;  // number of joints in grown_by_, in order of growth
  std::array<std::size_t, most_generators> grown_by_{};
  std::array<double, most_generators> grown_length_{};
};

}  // namespace hinge::detail
