// SPDX-License-Identifier: BSD-3-Clause
// engine/brute: tests every admitted pair one by one. Every other engine is tested against it.
#pragma once

#include <cstddef>
#include <memory>
#include <utility>

#include "hinge/core/id.hpp"
#include "hinge/detail/query/pair_rules.hpp"
#include "hinge/detail/query/test_pair.hpp"
#include "hinge/engine/engine.hpp"
#include "hinge/model/placement.hpp"
#include "hinge/query/query_options.hpp"

namespace hinge {

/// The reference engine: O(n^2) pairs in a query of one model, O(n m) in a query of two. One per thread.
template <Primitive P, PairFilter F, DistanceMatrix D>
class Brute {
 public:
  /// `filter` and `matrix` are made for the primitives of `model`; both are copied.
  Brute(std::shared_ptr<const SelectedModel<P>> model, F filter, D matrix)
      : placement_(std::move(model)), filter_(std::move(filter)), matrix_(std::move(matrix)) {}

  /// The world coordinates that queries use. Valid for the life of the engine.
  Placement<P>& placement() noexcept { return placement_; }
  const Placement<P>& placement() const noexcept { return placement_; }

  /// Hands the admitted pairs i < j within the cutoff to `collector` (see Collector), until it is done.
  template <Collector C>
  void self_query(C& collector, const QueryOptions& options) {
    place_all();
    const detail::SelfRules<P, F, D> rules{placement_, filter_, matrix_, options};
    const std::size_t n = placement_.placed().size();
    for (std::size_t i = 0; i < n; ++i)
      for (std::size_t j = i + 1; j < n; ++j)
        if (!test(collector, rules, placement_.placed()[i], placement_.placed()[j], i, j)) return;
  }

  /// The same for pairs between this model and `other`. `across` admits (primitive of this, primitive of other).
  template <Collector C, PairFilter G>
  requires CrossMatrix<D>
  void query(Brute& other, const G& across, C& collector, const QueryOptions& options) {
    place_all();
    other.place_all();
    const detail::CrossRules<P, G, D> rules{placement_, other.placement_, across, matrix_, other.matrix_, options};
    const auto mine = placement_.placed(), theirs = other.placement_.placed();
    for (std::size_t i = 0; i < mine.size(); ++i)
      for (std::size_t j = 0; j < theirs.size(); ++j)
        if (!test(collector, rules, mine[i], theirs[j], i, j)) return;
  }

 private:
  void place_all() noexcept {
    for (std::size_t g = 0; g < placement_.model().groups()->size(); ++g) placement_.place(id<GroupId>(g));
  }

  /// Returns false when the collector is done.
  template <Collector C, class Rules>
  static bool test(C& collector, const Rules& rules, const P& p, const P& q, std::size_t i, std::size_t j) {
    const auto a = id<PrimitiveId>(i), b = id<PrimitiveId>(j);
    if (rules.options.counts != nullptr) ++rules.options.counts->pairs_tested;
    detail::test_pair(collector, a, b, p, q, rules.threshold(a, b), [&] { return rules.admits(a, b); });
    return !collector.done();
  }

  Placement<P> placement_;
  F filter_;
  D matrix_;
};

}  // namespace hinge
