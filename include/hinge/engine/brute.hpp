// SPDX-License-Identifier: BSD-3-Clause
// engine/brute: tests every admitted pair one by one. Every other engine is tested against it.
#pragma once

#include <cstddef>
#include <span>

#include "hinge/core/id.hpp"
#include "hinge/engine/engine.hpp"
#include "hinge/model/selected_model.hpp"
#include "hinge/policy/collector.hpp"
#include "hinge/query/pair_rules.hpp"

namespace hinge {

/// The reference engine: O(n^2) pairs in a query of one model, O(n m) in a query of two. It needs no preparation.
template <Primitive P, PairFilter F, DistanceMatrix D>
struct Brute {
  /// Prepares nothing: the arguments are those of every engine.
  Brute(const SelectedModel<P>&, const F&, const D&) {}

  /// Hands the admitted pairs i < j within the cutoff to `collector` (see Collector), until it is done.
  template <Collector C>
  void self_query(const SelfRules<P, F, D>& rules, C& collector) {
    const std::span<const P> placed = rules.state.place_all();
    for (std::size_t i = 0; i < placed.size(); ++i)
      for (std::size_t j = i + 1; j < placed.size(); ++j) {
        rules.test(collector, id<PrimitiveId>(i), id<PrimitiveId>(j), placed[i], placed[j]);
        if (collector.done()) return;
      }
  }

  /// The same for pairs between two models: i of the first, j of the second.
  template <Collector C, PairFilter G>
  requires CrossMatrix<D>
  void query(Brute&, const CrossRules<P, G, D>& rules, C& collector) {
    const std::span<const P> mine = rules.first.place_all(), theirs = rules.second.place_all();
    for (std::size_t i = 0; i < mine.size(); ++i)
      for (std::size_t j = 0; j < theirs.size(); ++j) {
        rules.test(collector, id<PrimitiveId>(i), id<PrimitiveId>(j), mine[i], theirs[j]);
        if (collector.done()) return;
      }
  }
};

}  // namespace hinge
