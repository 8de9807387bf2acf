// SPDX-License-Identifier: BSD-3-Clause
// ListedPairs: the pairs that a segment of a path might bring too close, but for those that are proved apart at once.
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

/// Do two points that are at least this far apart at the middle of a segment keep their threshold in all of it? By what
/// their groups can approach each other by; a lower bound of the distance, model length unit.
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

/// A collector. `stays_apart` is asked for pairs that come with a measured distance.
template <class Proof>
class ListedPairs {
 public:
  static constexpr bool ranks = false;
  /// Adds to `pairs`.
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

  /// How many were left out.
  std::uint64_t proved() const noexcept { return proved_; }

 private:
  std::vector<PathPair>& pairs_;
  Proof stays_apart_;
  std::uint64_t proved_ = 0;
};

}  // namespace hinge::detail
