// SPDX-License-Identifier: BSD-3-Clause
// Engine: the interface that Hierarchy needs from a collision engine. An engine is made once for a model with its DOF
// selection, then updated and queried many times. It holds all scratch memory, so one engine belongs to one thread.
#pragma once

#include <concepts>
#include <memory>

#include "hinge/model/placement.hpp"
#include "hinge/model/selected_model.hpp"
#include "hinge/policy/distance_matrix.hpp"
#include "hinge/policy/pair_filter.hpp"
#include "hinge/policy/primitive.hpp"
#include "hinge/query/collectors.hpp"
#include "hinge/query/query_options.hpp"

namespace hinge {

/// E answers queries about primitives P under filter F and matrix D. In every mode, every engine gives the same answers
/// as engine/brute. Configurations, poses and coordinates reach the engine through placement() only.
template <class E, class P, class F, class D>
concept Engine = std::copyable<E> && Primitive<P> && PairFilter<F> && DistanceMatrix<D> &&
    std::constructible_from<E, std::shared_ptr<const SelectedModel<P>>, F, D> &&
    requires(E& engine, const E& constant, AnyHit& any, HitsWithin& within, Closest& closest,
             const QueryOptions& options) {
  { engine.placement() }
  noexcept->std::same_as<Placement<P>&>;
  { constant.placement() }
  noexcept->std::same_as<const Placement<P>&>;
  engine.self_query(any, options);
  engine.self_query(within, options);
  engine.self_query(closest, options);
};

/// An engine that also answers queries between two models of the same kind. The filter G admits (primitive of this,
/// primitive of other).
template <class E, class P, class F, class D, class G>
concept CrossEngine = Engine<E, P, F, D> && CrossMatrix<D> && PairFilter<G> &&
    requires(E& engine, E& other, Closest& closest, const G& across, const QueryOptions& options) {
  engine.query(other, across, closest, options);
};

}  // namespace hinge
