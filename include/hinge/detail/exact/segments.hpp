// SPDX-License-Identifier: BSD-3-Clause
// Two segments with radii in exact integer arithmetic: the collision decision, the gap and the nearest points.
#pragma once

#include <array>
#include <cstddef>

#include "hinge/core/finite.hpp"
#include "hinge/core/radius_sum.hpp"
#include "hinge/core/vec3.hpp"
#include "hinge/detail/exact/gap.hpp"
#include "hinge/detail/exact/integer.hpp"
#include "hinge/detail/exact/orient.hpp"

namespace hinge::detail::exact {

/// Segments ab and cd, which may be degenerate. Their nearest points are two ends, or an end and an interior point, or
/// two interior points. The squared distance of each candidate is a fraction of integers. With the radius sum, the
/// integers have at most 12,600 bits.
class WholeSegments {
 public:
  WholeSegments(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d, const RadiusSum& reach) noexcept
      : ends_{{{a, b}, {c, d}}}, counts_touching_(reach.counts_touching()) {
    unit_ = common_unit(reach, common_unit(ends_[0], common_unit(ends_[1])));
    if (unit_ == no_unit) unit_ = 0;
    reach_ = whole(reach, unit_);
  }

  /// Returns true when the distance is below the radius sum, or equal to it when touching counts.
  bool closer_than_reach() const noexcept {
    bool closer = false;
    visit([&](const Integer& numerator, const Integer& denominator, const auto&) noexcept {
      closer = within(numerator, denominator, reach_, counts_touching_);
      return closer;
    });
    return closer;
  }

  struct Nearest {
    double squared_gap = 0.0;  ///< relative error at most 20 u; exactly 0 within the radius sum
    double s = 0.0, t = 0.0;   ///< parameters of the nearest points: fractions of ab and of cd
  };

  Nearest nearest() const noexcept {
    Scaled least_gap, least;
    Nearest best;
    bool first = true;
    visit([&](const Integer& numerator, const Integer& denominator, const auto& places) noexcept {
      const Scaled squared = numerator.scaled() / denominator.scaled();
      const Scaled gap = squared_gap(numerator, denominator, reach_);
      // All candidates within the radius sum have gap 0, so their distances decide.
      const bool meets = gap.mantissa == 0.0, least_meets = least_gap.mantissa == 0.0;
      const bool closer = meets ? !least_meets || squared < least : !least_meets && gap < least_gap;
      if (!first && !closer) return false;
      first = false;
      least_gap = gap;
      least = squared;
      places(best);
      return numerator.sign() == 0;
    });
    best.squared_gap = to_double(least_gap, unit_);
    return best;
  }

 private:
  WholePoint between(const Vec3& from, const Vec3& to) const noexcept { return whole_difference(to, from, unit_); }

  /// Calls f(numerator, denominator, places) for every candidate pair of points; places(Nearest&) writes the
  /// parameters. A true result of f ends the visit.
  template <class Visitor>
  void visit(const Visitor& f) const noexcept {
    if (two_ends(f)) return;
    for (std::size_t side = 0; side < 2; ++side)
      for (std::size_t k = 0; k < 2; ++k)
        if (inside_of_other(f, side, k)) return;
    insides(f);
  }

  template <class Visitor>
  [[gnu::noinline]] bool two_ends(const Visitor& f) const noexcept {
    const Integer one = Integer::of(1.0, 0);
    for (std::size_t k = 0; k < 2; ++k)
      for (std::size_t l = 0; l < 2; ++l) {
        const WholePoint w = between(ends_[0][k], ends_[1][l]);
        const auto places = [&](Nearest& n) noexcept {
          n.s = static_cast<double>(k);
          n.t = static_cast<double>(l);
        };
        if (f(dot(w, w), one, places)) return true;
      }
    return false;
  }

  /// End k of one segment and the interior of the other: |w x u|^2 / u^2.
  template <class Visitor>
  [[gnu::noinline]] bool inside_of_other(const Visitor& f, std::size_t side, std::size_t k) const noexcept {
    const auto& other = ends_[1 - side];
    const WholePoint u = between(other[0], other[1]), w = between(other[0], ends_[side][k]);
    const Integer along = dot(w, u), square = dot(u, u);
    if (along.sign() <= 0 || square <= along) return false;
    const WholePoint across = cross(w, u);
    return f(dot(across, across), square, [&](Nearest& n) noexcept {
      (side == 0 ? n.s : n.t) = static_cast<double>(k);
      (side == 0 ? n.t : n.s) = ratio(along, square);
    });
  }

  /// The interiors of both segments: (w . n)^2 / n^2, where n is the common normal. Only when both feet are interior.
  template <class Visitor>
  [[gnu::noinline]] void insides(const Visitor& f) const noexcept {
    const WholePoint u = between(ends_[0][0], ends_[0][1]), v = between(ends_[1][0], ends_[1][1]);
    const WholePoint w = between(ends_[0][0], ends_[1][0]);
    const WholePoint normal = cross(u, v);
    const Integer square = dot(normal, normal);
    if (square.sign() == 0) return;
    const Integer s = triple(w, v, normal), t = triple(w, u, normal);
    if (s.sign() < 0 || t.sign() < 0 || square < s || square < t) return;
    const Integer height = dot(w, normal);
    f(height * height, square, [&](Nearest& n) noexcept {
      n.s = ratio(s, square);
      n.t = ratio(t, square);
    });
  }

  std::array<std::array<Vec3, 2>, 2> ends_;  // per segment
  int unit_ = 0;
  Integer reach_;
  bool counts_touching_ = false;
};

[[gnu::cold, gnu::noinline]] inline bool segments_closer_than(const Vec3& a, const Vec3& b, const Vec3& c,
                                                              const Vec3& d, const RadiusSum& reach) noexcept {
  if (!is_finite(reach.clearance)) return true;
  return WholeSegments(a, b, c, d, reach).closer_than_reach();
}

[[gnu::cold, gnu::noinline]] inline WholeSegments::Nearest nearest_of_segments(const Vec3& a, const Vec3& b,
                                                                               const Vec3& c, const Vec3& d,
                                                                               const RadiusSum& reach) noexcept {
  return WholeSegments(a, b, c, d, reach).nearest();
}

}  // namespace hinge::detail::exact
