// SPDX-License-Identifier: BSD-3-Clause
// make_queries: builds a model of one kind of primitive and a hierarchy with the wanted engine.
#pragma once

#include <functional>
#include <memory>
#include <type_traits>
#include <utility>

#include "core_queries.hpp"
#include "hinge/core/error.hpp"
#include "hinge/engine/brute.hpp"
#include "hinge/engine/lazy.hpp"
#include "hinge/engine/simd.hpp"
#include "hinge/hierarchy.hpp"
#include "hinge/path/certified_path.hpp"
#include "hinge/path/check_sampled.hpp"

namespace hinge::python {

template <class Certified>
PathProver prover_of(std::shared_ptr<Certified> certified) {
  PathProver prover;
  prover.check = [certified](std::span<const double> from, std::span<const double> to, double smallest_step,
                             const std::function<void()>& between) {
    return certified->check(from, to, smallest_step, between);
  };
  prover.clone = [certified] { return prover_of(std::make_shared<Certified>(*certified)); };
  return prover;
}

/// Every engine proves the same, so all provers use one.
template <class P, template <class, class, class> class EngineOf>
PathProver prover_for(const Hierarchy<P, TableFilter, TypedThresholds, EngineOf>& h) {
  using Proving = Hierarchy<P, TableFilter, TypedThresholds, Simd>;
  using Certified = CertifiedPath<P, TableFilter, TypedThresholds, Simd>;
  if constexpr (std::is_same_v<Proving, std::remove_cvref_t<decltype(h)>>)
    return prover_of(std::make_shared<Certified>(h));
  else
    return prover_of(
        std::make_shared<Certified>(Proving(h.model().model(), h.model().selection(), h.filter(), h.matrix())));
}

template <class H>
CoreQueries queries_of(std::shared_ptr<H> h) {
  CoreQueries queries;
  queries.update = [h](std::span<const double> q) { h->update(q); };
  queries.collides = [h] { return h->self_collides(); };
  queries.within = [h](double margin) { return h->self_within(margin); };
  queries.closest = [h] { return h->self_closest(); };
  queries.link_pose = [h](LinkId link) { return h->link_pose(link); };
  queries.constant_contacts = [h] { return h->constant_contacts(); };
  queries.dof = h->dof_count();
  queries.links = h->model().model().tree().link_count();
  queries.sample_path = [h](std::span<const double> from, std::span<const double> to, double resolution,
                            const std::function<void()>& between) {
    return check_sampled(*h, from, to, resolution, between);
  };
  queries.make_prover = [h] { return prover_for(*h); };
  queries.collides_with = [h](const CoreQueries& other, const CrossTable& across) {
    return h->collides(*static_cast<const H*>(other.hierarchy.get()), across);
  };
  queries.within_of = [h](const CoreQueries& other, const CrossTable& across, double margin) {
    return h->within(*static_cast<const H*>(other.hierarchy.get()), margin, across);
  };
  queries.closest_of = [h](const CoreQueries& other, const CrossTable& across) {
    return h->closest(*static_cast<const H*>(other.hierarchy.get()), across);
  };
  queries.hierarchy = h;
  queries.kind = &typeid(H);
  queries.clone = [h] { return queries_of(std::make_shared<H>(*h)); };
  return queries;
}

/// make_primitive(k): primitive k of the description.
template <class P, class MakePrimitive>
CoreQueries make_queries(const CoreDescription& from, const TableFilter& filter, const TypedThresholds& thresholds,
                         const MakePrimitive& make_primitive) {
  ModelBuilder<P> build;
  for (std::size_t k = 0; k < from.joints.size(); ++k) build.add_link(from.parents[k], from.joints[k]);
  for (std::size_t k = 0; k < from.link_of.size(); ++k) build.add_primitive(from.link_of[k], make_primitive(k));
  const Model<P> model = build.finish();
  const DofSelection selection(model.tree(), from.free);
  const auto with = [&]<template <class, class, class> class EngineOf>() {
    using H = Hierarchy<P, TableFilter, TypedThresholds, EngineOf>;
    return queries_of(std::make_shared<H>(model, selection, filter, thresholds));
  };
  if (from.engine == "simd") return with.template operator()<Simd>();
  if (from.engine == "lazy") return with.template operator()<Lazy>();
  if (from.engine == "brute") return with.template operator()<Brute>();
  throw ModelError("engine '" + from.engine + "': expected simd, lazy or brute");
}

/// Three numbers as a vector.
inline Vec3 vector_at(const std::vector<double>& numbers, std::size_t k) {
  return {numbers[3 * k], numbers[3 * k + 1], numbers[3 * k + 2]};
}

}  // namespace hinge::python
