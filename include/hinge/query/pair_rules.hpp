// SPDX-License-Identifier: BSD-3-Clause
// SelfRules and CrossRules: one query of an engine: the state, the thresholds and the admission of its pairs.
#pragma once

#include "hinge/core/id.hpp"
#include "hinge/detail/query/pair_threshold.hpp"
#include "hinge/detail/query/test_pair.hpp"
#include "hinge/model/state.hpp"
#include "hinge/policy/collector.hpp"
#include "hinge/policy/distance_matrix.hpp"
#include "hinge/policy/pair_filter.hpp"
#include "hinge/policy/primitive.hpp"
#include "hinge/query/query_options.hpp"

namespace hinge {
/// A query of pairs inside one model. A view that is valid during the query.
template <Primitive P, PairFilter F, DistanceMatrix D>
struct SelfRules {
  State<P>& state;              ///< world coordinates of the model
  const F& filter;              ///< of the model
  const D& matrix;              ///< of the model
  const QueryOptions& options;  ///< valid for the model
  /// True when admits() depends on the filter and the model alone, which is the usual case.
  bool plain = state.follows_joints() && !options.moved_only && options.groups.is_all();

  /// Returns the extra clearance of a primitive's group. It is added to the thresholds of its pairs.
  double clearance(PrimitiveId i) const noexcept {
    return detail::clearance_of(options.clearance, state.model().group_of(i));
  }
  /// Returns the threshold of a pair, extra clearances included: a double or a RadiusSum.
  auto threshold(PrimitiveId i, PrimitiveId j) const noexcept {
    const auto m = detail::threshold_of(matrix, i, j);
    return options.clearance.empty() ? m : m + (clearance(i) + clearance(j));
  }
  /// Returns true when the options admit the pairs of two groups: the range of groups holds them and, in moved-only
  /// queries, the groups moved relative to each other.
  bool admits_groups(GroupId g, GroupId h) const noexcept {
    return options.groups.holds_larger(g, h) && (!options.moved_only || state.moved_apart(g, h));
  }
  /// Returns true when the filter admits the pair, its distance is not constant, and the options admit its groups.
  bool admits(PrimitiveId i, PrimitiveId j) const noexcept {
    const auto& model = state.model();
    if (!filter.admits(i, j)) return false;
    if (plain) return !model.constant(i, j);
    return !state.constant(i, j) && admits_groups(model.group_of(i), model.group_of(j));
  }
  /// Passes the pair i < j of primitives p and q, in world coordinates, to the collector if it counts and lies within
  /// the cutoff. The engines of the library decide pairs by the same function, detail::test_pair.
  template <Collector C>
  void test(C& collector, PrimitiveId i, PrimitiveId j, const P& p, const P& q) const {
    if (options.counts != nullptr) ++options.counts->pairs_tested;
    detail::test_pair(collector, i, j, p, q, threshold(i, j), [&] { return admits(i, j); });
  }
};

/// A query of pairs of two models: i of the first, j of the second. A view that is valid during the query.
template <Primitive P, PairFilter F, CrossMatrix D>
struct CrossRules {
  State<P>& first;              ///< world coordinates of the first model
  State<P>& second;             ///< world coordinates of the second model
  const F& filter;              ///< admits (primitive of the first, primitive of the second)
  const D& first_matrix;        ///< of the first model
  const D& second_matrix;       ///< of the second model; the two are compatible
  const QueryOptions& options;  ///< valid for both models

  /// Returns the threshold of a pair, extra clearances included: a double or a RadiusSum.
  auto threshold(PrimitiveId i, PrimitiveId j) const noexcept {
    return detail::threshold_of(first_matrix, i, second_matrix, j) +
           (detail::clearance_of(options.clearance, first.model().group_of(i)) +
            detail::clearance_of(options.other_clearance, second.model().group_of(j)));
  }
  /// Returns true when the filter admits the pair and, in moved-only queries, either group moved.
  bool admits(PrimitiveId i, PrimitiveId j) const noexcept {
    return filter.admits(i, j) &&
           (!options.moved_only || first.moved(first.model().group_of(i)) || second.moved(second.model().group_of(j)));
  }
  /// The same as SelfRules::test.
  template <Collector C>
  void test(C& collector, PrimitiveId i, PrimitiveId j, const P& p, const P& q) const {
    if (options.counts != nullptr) ++options.counts->pairs_tested;
    detail::test_pair(collector, i, j, p, q, threshold(i, j), [&] { return admits(i, j); });
  }
};

}  // namespace hinge
