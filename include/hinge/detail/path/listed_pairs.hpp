// SPDX-License-Identifier: BSD-3-Clause
// ListedPairs: collects the pairs that may come too close in a segment, except those proved apart at once.
#pragma once

#include <cstdint>
#include <utility>
#include <vector>

#include "hinge/core/id.hpp"
#include "hinge/detail/path/group_rates.hpp"
#include "hinge/detail/path/path_segments.hpp"
#include "hinge/detail/path/prove_apart.hpp"
#include "hinge/detail/path/relative_motion.hpp"
#include "hinge/model/selected_model.hpp"
#include "hinge/policy/collector.hpp"
#include "hinge/policy/distance_matrix.hpp"
#include "hinge/policy/primitive.hpp"

namespace hinge::detail {

/// Returns true if two points, at least `least` (model length unit) apart at the middle of a segment, keep their
/// threshold in the whole segment. It uses the largest approach of their groups.
template <Primitive P, DistanceMatrix D>
struct StaysApart {
  const SelectedModel<P>& model;
  const D& matrix;
  const GroupRates& rates;
  RelativeMotions& motions;
  double half;

  bool operator()(PrimitiveId first, PrimitiveId second, double least) const {
    const auto a = static_cast<std::uint32_t>(index(model.group_of(first)));
    const auto b = static_cast<std::uint32_t>(index(model.group_of(second)));
    const double closer = motions(rates.groups(), a, b, half).approach;
    return farther_than(least, matrix.threshold(first, second), closer, rates.scale());
  }
};
template <Primitive P, DistanceMatrix D>
StaysApart(const SelectedModel<P>&, const D&, const GroupRates&, RelativeMotions&, double) -> StaysApart<P, D>;

/// A collector. It calls `stays_apart` for pairs with a measured distance (see TakesMeasured).
template <class Proof>
class ListedPairs {
 public:
  static constexpr bool ranks = false;
  /// Appends to `pairs`.
  ListedPairs(std::vector<PathPair>& pairs, Proof stays_apart) : pairs_(pairs), stays_apart_(std::move(stays_apart)) {}
  void add(const Hit& hit) { pairs_.push_back({hit.first, hit.second}); }
  void add_measured(const Hit& hit, double error) {
    if (stays_apart_(hit.first, hit.second, hit.distance - error))
      ++proved_;
    else
      add(hit);
  }
  double cutoff() const noexcept { return 0.0; }
  bool done() const noexcept { return false; }

  /// Number of pairs that were proved apart and left out.
  std::uint64_t proved() const noexcept { return proved_; }

 private:
  std::vector<PathPair>& pairs_;
  Proof stays_apart_;
  std::uint64_t proved_ = 0;
};

}  // namespace hinge::detail
