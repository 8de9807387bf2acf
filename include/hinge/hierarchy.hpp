// SPDX-License-Identifier: BSD-3-Clause
// Hierarchy: finds the primitives of an articulated model that come too close at a configuration.
#pragma once

#include <algorithm>
#include <cstddef>
#include <initializer_list>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "hinge/core/error.hpp"
#include "hinge/core/finite.hpp"
#include "hinge/core/id.hpp"
#include "hinge/core/number_text.hpp"
#include "hinge/detail/policy/largest_threshold.hpp"
#include "hinge/detail/query/check_clearance.hpp"
#include "hinge/engine/engine.hpp"
#include "hinge/engine/simd.hpp"
#include "hinge/kinematics/frame.hpp"
#include "hinge/model/model.hpp"
#include "hinge/model/selected_model.hpp"
#include "hinge/model/state.hpp"
#include "hinge/policy/collector.hpp"
#include "hinge/policy/distance_matrix.hpp"
#include "hinge/policy/laws.hpp"
#include "hinge/policy/pair_filter.hpp"
#include "hinge/policy/primitive.hpp"
#include "hinge/query/collectors.hpp"
#include "hinge/query/pair_rules.hpp"
#include "hinge/query/query_options.hpp"

namespace hinge {

/// Collision queries of one model. A pair (i, j) collides when the filter admits it, its distance can change under the
/// selected DOF, and d(i, j) < M(i, j) (BioCD eq. (1)). Touching closed solids (d = 0) also collide. Lengths in the
/// model's unit, angles in rad. Not thread-safe: use one copy per thread. Copies share only the constant model.
template <Primitive P, PairFilter F, DistanceMatrix D, template <class, class, class> class EngineOf = Simd>
requires Engine<EngineOf<P, F, D>, P, F, D>
class Hierarchy {
 public:
  /// Frees every DOF. ModelError: a filter or matrix made for another number of primitives or for other links; an
  /// exclusion list that is unsorted, contains its own primitive or an unknown primitive. Without NDEBUG also a filter
  /// that fails laws::check_refinements.
  Hierarchy(Model<P> model, F filter, D matrix)
      : Hierarchy(model, DofSelection::all(model.tree()), std::move(filter), std::move(matrix)) {}

  /// Frees the selected DOF and keeps the others at their reference value 0. ModelError: also a selection for another
  /// tree.
  Hierarchy(Model<P> model, DofSelection selection, F filter, D matrix)
      : filter_(std::move(filter)),
        matrix_(std::move(matrix)),
        state_(std::make_shared<const SelectedModel<P>>(checked(std::move(model), filter_, matrix_),
                                                        std::move(selection))),
        engine_(state_.model(), filter_, matrix_),
        largest_threshold_(matrix_, state_.model().size()) {}

  // --- State. Invalid input throws ConfigurationError, names the faulty element and keeps the previous state. ---

  /// q: one value per selected DOF, in the selection's order; rad or model length unit. The initial state is all 0.
  void update(std::span<const double> q) { state_.update(q); }
  /// The same for values written out: update({0.0, 3.0}).
  void update(std::initializer_list<double> q) { state_.update(std::span(q.begin(), q.size())); }
  /// poses: one world pose per rigid group, computed by the caller. Group 0 is the world and must be the identity.
  void update_poses(std::span<const Pose> poses) { state_.update_poses(poses); }
  /// placed: world coordinates of every primitive, computed by the caller. Queries then test every admitted pair,
  /// including pairs of constant distance.
  void update_placed(std::span<const P> placed) { state_.update_placed(placed); }

  /// Learns from the current state: engines that can order their work then start yes/no queries with the pairs that
  /// collide most often. Call it at some hundred typical states. Answers do not change. Costs about one query over all
  /// pairs of links.
  void calibrate_pair_order() {
    const QueryOptions options;
    const SelfRules<P, F, D> rules = self_rules(options);
    if constexpr (requires { engine_.calibrate_pair_order(rules); }) engine_.calibrate_pair_order(rules);
  }
  /// The same for yes/no queries against other models: it orders the links of this model. `other` at its current state
  /// is a typical opponent. ModelError: the two distance matrices are incompatible.
  template <PairFilter G = AdmitAll>
  void calibrate_pair_order(const Hierarchy& other, const G& across = {}) {
    with_other(other, across, {}, [&](E& engine, const CrossRules<P, G, D>& rules) {
      if constexpr (requires { engine_.calibrate_pair_order(engine, rules); })
        engine_.calibrate_pair_order(engine, rules);
    });
  }

  // --- Queries at the current state. Invalid options throw ConfigurationError, see self_query. ---

  /// Returns true when at least one pair collides.
  bool self_collides(const QueryOptions& options = {}) const { return self(AnyHit{}, options).done(); }
  /// Returns all colliding pairs, sorted by (first, second).
  std::vector<Hit> self_collisions(const QueryOptions& options = {}) const { return self_within(0.0, options); }
  /// Returns all pairs with d - M < margin, sorted by (first, second). ConfigurationError: margin is not finite or
  /// negative.
  std::vector<Hit> self_within(double margin, const QueryOptions& options = {}) const {
    listed_.start(checked(margin));
    self_query(listed_, options);
    return listed_.take();
  }
  /// Returns the pair with the smallest d - M (the deepest collision, if any). Returns nullopt when no pair is
  /// admitted.
  std::optional<Hit> self_closest(const QueryOptions& options = {}) const {
    const double most = largest(options.clearance);
    return self(Closest{-(largest_threshold_.within() + (most + most))}, options).hit();
  }

  /// Passes the pairs to a custom collector, in the order of the engine. ConfigurationError: clearances that are not
  /// finite lengths >= 0, not one per rigid group, or an other_clearance (valid only between two models).
  template <Collector C>
  void self_query(C& collector, const QueryOptions& options = {}) const {
    if (!options.other_clearance.empty())
      throw ConfigurationError(
          "other_clearance: expected none in a query of one model, because clearance applies to both "
          "primitives of a pair");
    detail::check_clearance(options.clearance, model().groups()->size());
    engine_.self_query(self_rules(options), collector);
  }

  // --- The same queries against another model. `across` admits pairs (primitive of this, primitive of other). ---
  // ModelError: the two distance matrices are incompatible.

  /// Returns true when at least one pair of primitives of the two models collides.
  template <PairFilter G = AdmitAll>
  bool collides(const Hierarchy& other, const G& across = {}, const QueryOptions& options = {}) const {
    return mutual(AnyHit{}, other, across, options).done();
  }
  /// Returns all colliding pairs, sorted by (first, second).
  template <PairFilter G = AdmitAll>
  std::vector<Hit> collisions(const Hierarchy& other, const G& across = {}, const QueryOptions& options = {}) const {
    return within(other, 0.0, across, options);
  }
  /// Returns all pairs with d - M < margin, sorted by (first, second). ConfigurationError: margin not finite or
  /// negative.
  template <PairFilter G = AdmitAll>
  std::vector<Hit> within(const Hierarchy& other, double margin, const G& across = {},
                          const QueryOptions& options = {}) const {
    listed_.start(checked(margin));
    query(other, listed_, across, options);
    return listed_.take();
  }
  /// Returns the pair with the smallest d - M, or nullopt when no pair is admitted.
  template <PairFilter G = AdmitAll>
  std::optional<Hit> closest(const Hierarchy& other, const G& across = {}, const QueryOptions& options = {}) const {
    const double most = largest(options.clearance) + largest(options.other_clearance);
    return mutual(Closest{-(largest_threshold_.between(other.largest_threshold_) + most)}, other, across, options)
        .hit();
  }

  /// Passes the pairs to a custom collector, in the order of the engine. ConfigurationError: clearances as in
  /// self_query, or a range of groups (valid only in queries of one model).
  template <Collector C, PairFilter G = AdmitAll>
  void query(const Hierarchy& other, C& collector, const G& across = {}, const QueryOptions& options = {}) const {
    if (!options.groups.is_all())
      throw ConfigurationError("groups: expected all groups in a query of two models; a range is for one model");
    detail::check_clearance(options.clearance, model().groups()->size());
    detail::check_clearance(options.other_clearance, other.model().groups()->size());
    check_laws(across, model().model().links(), other.model().model().links());
    with_other(other, across, options,
               [&](E& engine, const CrossRules<P, G, D>& rules) { engine_.query(engine, rules, collector); });
  }

  // --- Constant data, and coordinates at the current state ---

  /// The model under its DOF selection. The reference is valid while a copy of this object lives.
  const SelectedModel<P>& model() const noexcept { return state_.model(); }
  /// Returns the number of selected DOF: the length of q in update().
  std::size_t dof_count() const noexcept { return model().selection().size(); }
  /// Returns the world coordinates of all primitives; queries use the same numbers. The next update changes the span's
  /// contents.
  std::span<const P> placed() const { return state_.place_all(); }
  /// Returns the world coordinates of primitive i, without placing the others.
  P placed(PrimitiveId i) const noexcept {
    return state_.groups_may_deform() ? state_.placed()[index(i)] : state_.alone(i);
  }
  /// Returns the world frame of each rigid group at the last configuration or poses, valid until the next update.
  std::span<const Frame> frames() const noexcept {
    return state_.frames_through(id<GroupId>(model().groups()->size() - 1));
  }
  /// The pair filter.
  const F& filter() const noexcept { return filter_; }
  /// The distance matrix.
  const D& matrix() const noexcept { return matrix_; }
  /// Returns the world pose of a link at the last configuration or poses. ModelError: no such link.
  Pose link_pose(LinkId link) const {
    if (index(link) >= model().model().tree().link_count())
      throw ModelError("link " + std::to_string(index(link)) + ": the model has " +
                       std::to_string(model().model().tree().link_count()) + " links");
    const RigidGroups& groups = *model().groups();
    return state_.pose(groups.group_of(link)) * groups.link_in_group(link);
  }
  /// Returns the pairs that collide at the reference and whose distance cannot change, sorted. Queries at a
  /// configuration do not report them. Costs one query over all pairs of the model.
  std::vector<Hit> constant_contacts() const;

 private:
  using E = EngineOf<P, F, D>;

  static Model<P> checked(Model<P> model, const F& filter, const D& matrix) {
    const auto check = [&](const auto& policy, const char* what) {
      if constexpr (KnowsSize<std::remove_cvref_t<decltype(policy)>>)
        if (const std::size_t n = policy.size(); n != model.size())
          throw ModelError(std::string(what) + " made for " + std::to_string(n) + " primitives, the model has " +
                           std::to_string(model.size()));
    };
    check(filter, "pair filter");
    check(matrix, "distance matrix");
    if constexpr (KnowsLinks<F>)
      if (const std::span<const LinkId> a = filter.links(), b = model.links();
          !std::equal(a.begin(), a.end(), b.begin(), b.end()))
        throw ModelError("pair filter made for primitives on different links, expected the links of the model");
    if constexpr (ListsExclusions<F>)
      for (std::size_t i = 0; i < model.size(); ++i) check_exclusions(i, filter.excluded(id<PrimitiveId>(i)), model);
    check_laws(filter, model.links());
    return model;
  }
  /// In debug builds: throws ModelError when the refinements of a filter contradict its admits.
  template <class G, class... Links>
  static void check_laws([[maybe_unused]] const G& filter, [[maybe_unused]] const Links&... links) {
#ifndef NDEBUG
    if (const laws::Violations broken = laws::check_refinements(filter, links...); !broken.empty())
      throw ModelError("pair filter: " + broken.front());
#endif
  }
  static void check_exclusions(std::size_t i, std::span<const PrimitiveId> excluded, const Model<P>& model) {
    for (std::size_t k = 0; k < excluded.size(); ++k) {
      const std::size_t j = index(excluded[k]);
      const char* flaw = j >= model.size()                           ? "which does not exist"
                         : j == i                                    ? "itself"
                         : k > 0 && !(excluded[k - 1] < excluded[k]) ? "out of order"
                                                                     : nullptr;
      if (flaw != nullptr)
        throw ModelError("pair filter: primitive " + std::to_string(i) + " is excluded with primitive " +
                         std::to_string(j) + ", " + flaw);
    }
  }
  static double checked(double margin) {
    if (!is_length(margin) || margin < 0.0)
      throw ConfigurationError("margin " + number_text(margin) + ": expected a finite length >= 0");
    return margin;
  }
  static double largest(std::span<const double> clearance) noexcept {
    return clearance.empty() ? 0.0 : std::max(0.0, *std::max_element(clearance.begin(), clearance.end()));
  }

  SelfRules<P, F, D> self_rules(const QueryOptions& options) const noexcept {
    return {state_, filter_, matrix_, options};
  }
  /// Calls visit(engine of the other model, rules).
  template <class G, class Visit>
  void with_other(const Hierarchy& other, const G& across, const QueryOptions& options, const Visit& visit) const {
    static_assert(CrossEngine<E, P, F, D, G>, "this engine or distance matrix cannot answer between two models");
    if (!matrix_.compatible(other.matrix_)) throw ModelError("the two models use different distance matrices");
    if (this == &other)
      return with_other(Hierarchy(other), across, options, visit);  // engines use memory on both sides
    visit(other.engine_, CrossRules<P, G, D>{state_, other.state_, across, matrix_, other.matrix_, options});
  }

  template <Collector C>
  C self(C collector, const QueryOptions& options) const {
    self_query(collector, options);
    return collector;
  }
  template <Collector C, PairFilter G>
  C mutual(C collector, const Hierarchy& other, const G& across, const QueryOptions& options) const {
    query(other, collector, across, options);
    return collector;
  }

  F filter_;
  D matrix_;
  mutable State<P> state_;     // queries compute what they need of the state
  mutable E engine_;           // scratch
  mutable HitsWithin listed_;  // keeps the memory of the longest list
  detail::LargestThreshold<D> largest_threshold_;
};

template <Primitive P, PairFilter F, DistanceMatrix D, template <class, class, class> class EngineOf>
requires Engine<EngineOf<P, F, D>, P, F, D> std::vector<Hit> Hierarchy<P, F, D, EngineOf>::constant_contacts()
const {
  Hierarchy at_reference(*this);
  at_reference.update(std::vector<double>(dof_count(), 0.0));
  const auto placed = at_reference.placed();
  at_reference.update_placed(std::vector<P>(placed.begin(), placed.end()));
  std::vector<Hit> contacts = at_reference.self_collisions();
  std::erase_if(contacts, [&](const Hit& hit) { return !model().constant(hit.first, hit.second); });
  return contacts;
}

/// Deduces the types of a hierarchy with the SIMD engine and all DOF free.
template <Primitive P, PairFilter F, DistanceMatrix D>
Hierarchy(Model<P>, F, D) -> Hierarchy<P, F, D>;
/// Deduces the types of a hierarchy with the SIMD engine and some DOF free.
template <Primitive P, PairFilter F, DistanceMatrix D>
Hierarchy(Model<P>, DofSelection, F, D) -> Hierarchy<P, F, D>;

}  // namespace hinge
