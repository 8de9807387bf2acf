// SPDX-License-Identifier: BSD-3-Clause
// Witnesses: the closest pairs of recent queries. Their present distance is an upper bound for the next answer.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <vector>

#include "hinge/core/id.hpp"
#include "hinge/core/pose.hpp"
#include "hinge/core/vec3.hpp"
#include "hinge/model/state.hpp"
#include "hinge/policy/collector.hpp"
#include "hinge/policy/primitive.hpp"

namespace hinge::detail {

/// Stores the two closest points of each pair in the frames of their groups. The present distance of the points is an
/// upper bound. Primitives without closest_points are not stored.
template <Primitive P>
class Witnesses {
 public:
  Witnesses() { list_.reserve(most); }
  void clear() noexcept { list_.clear(); }

  /// Upper bound of the smallest d - M, model unit; infinite if nothing is stored.
  template <class PairTest>
  double bound(State<P>& a, State<P>& b, const PairTest& pair_test) const noexcept {
    double least = std::numeric_limits<double>::infinity();
    for (const Witness& w : list_) {
      const Vec3 p = a.pose(a.model().group_of(w.i)) * w.p, q = b.pose(b.model().group_of(w.j)) * w.q;
      double size = 0.0;
      for (int k = 0; k < 3; ++k)
        size = std::max({size, std::abs(p[k]), std::abs(q[k]), std::abs(w.p[k]), std::abs(w.q[k])});
      // The points are off their primitives by a few roundings of coordinates.
      const double upper =
          std::sqrt(squared_norm(Vec3(q - p))) * (1 + 0x1p-40) + 0x1p-40 * size - pair_test.threshold(w.i, w.j);
      if (upper < least && pair_test.admits(w.i, w.j)) least = upper;
    }
    return least;
  }

  void remember(const Hit& hit, State<P>& a, State<P>& b) {
    if constexpr (HasClosestPoints<P>) {
      if (!(hit.distance > 0.0)) return;
      const auto [p, q] = closest_points(a.alone(hit.first), b.alone(hit.second));
      const Witness now{hit.first, hit.second, local(a, hit.first, p), local(b, hit.second, q)};
      auto at =
          std::find_if(list_.begin(), list_.end(), [&](const Witness& w) { return w.i == now.i && w.j == now.j; });
      if (at == list_.end()) {
        if (list_.size() < most) list_.push_back(now);
        at = list_.end() - 1;
      }
      *at = now;
      std::rotate(list_.begin(), at, at + 1);
    }
  }

 private:
  struct Witness {
    PrimitiveId i, j;
    Vec3 p, q;  // in the frames of their groups
  };
  static constexpr std::size_t most = 32;

  static Vec3 local(State<P>& state, PrimitiveId i, const Vec3& point) noexcept {
    return state.pose(state.model().group_of(i)).inverse() * point;
  }

  std::vector<Witness> list_;  // the latest first
};

}  // namespace hinge::detail
