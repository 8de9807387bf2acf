// SPDX-License-Identifier: BSD-3-Clause
// Engine: the interface that Hierarchy needs from a collision engine. An engine is a function of the rules of a query,
// which hold the state, and of a collector. It is prepared once for a model, its DOF selection, filter and matrix.
#pragma once

#include <concepts>

#include "hinge/model/selected_model.hpp"
#include "hinge/policy/distance_matrix.hpp"
#include "hinge/policy/pair_filter.hpp"
#include "hinge/policy/primitive.hpp"
#include "hinge/query/collectors.hpp"
#include "hinge/query/pair_rules.hpp"

namespace hinge {

/// E answers queries about primitives P under filter F and matrix D. In every mode, every engine gives the same answers
/// as engine/brute. The constructor sees the model, filter and matrix of all later queries. The engine may keep scratch
/// memory and what it computed from a state: State::version() says whether that is still current. One engine
/// belongs to one thread and to one State.
template <class E, class P, class F, class D>
concept Engine = std::copyable<E> && Primitive<P> && PairFilter<F> && DistanceMatrix<D> && std::constructible_from < E,
        const SelectedModel<P>
&, const F&,
    const D& >
        &&requires(E& engine, const SelfRules<P, F, D>& rules, AnyHit& any, HitsWithin& within, Closest& closest) {
  engine.self_query(rules, any);
  engine.self_query(rules, within);
  engine.self_query(rules, closest);
};

/// An engine that also answers queries between two models of the same kind. The filter G admits (primitive of this,
/// primitive of other).
template <class E, class P, class F, class D, class G>
concept CrossEngine = Engine<E, P, F, D> && CrossMatrix<D> && PairFilter<G> &&
    requires(E& engine, E& other, const CrossRules<P, G, D>& rules, Closest& closest) {
  engine.query(other, rules, closest);
};

}  // namespace hinge
