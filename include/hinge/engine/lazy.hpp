// SPDX-License-Identifier: BSD-3-Clause
// engine/lazy: the algorithm of BioCD (Ruiz de Angulo, Cortes, Simeon, RSS 2005): two levels of lazily split box trees.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <utility>
#include <vector>

#include "hinge/bounds/aabb.hpp"
#include "hinge/core/id.hpp"
#include "hinge/detail/engine/lazy/lazy_layout.hpp"
#include "hinge/detail/engine/lazy_tree.hpp"
#include "hinge/detail/engine/traversal.hpp"
#include "hinge/detail/query/test_pair.hpp"
#include "hinge/engine/engine.hpp"
#include "hinge/model/state.hpp"
#include "hinge/query/pair_rules.hpp"
#include "hinge/query/query_options.hpp"

namespace hinge {

/// A body is the owner of one low-level tree: a rigid group, or a basic group that spans several rigid groups. After an
/// update, only moved bodies get new boxes, for their leaves and root. A query splits the nodes in between on demand;
/// they are kept until the body moves. Each query rebuilds the upper tree over the roots. One engine per thread.
template <Primitive P, PairFilter F, DistanceMatrix D>
class Lazy {
 public:
  /// `filter` and `matrix` are made for the primitives of `model`.
  Lazy(const SelectedModel<P>& model, const F& filter, D matrix)
      : layout_(std::make_shared<const detail::LazyLayout>(model, filter)),
        matrix_(std::move(matrix)),
        trees_(layout_->body_count()),
        built_(layout_->body_count(), 0) {
    if constexpr (IsPointLike<P>) {
      const std::vector<std::uint8_t> never_collides = zero_thresholds(matrix_, model.size());
      for (std::uint32_t l = 0; l < layout_->leaf_count(); ++l) {
        const auto leaf = layout_->primitives(l);
        never_collides_.push_back(
            std::all_of(leaf.begin(), leaf.end(), [&](PrimitiveId i) { return never_collides[index(i)] != 0; }));
      }
    }
  }

  /// Hands the admitted pairs i < j within the cutoff to `collector` (see Collector), until it is done.
  template <Collector C>
  void self_query(const SelfRules<P, F, D>& rules, C& collector) {
    if (trees_.empty()) return;
    QueryCounts counts;
    refresh(rules.state);
    run_self(collector, rules, counts);
    add(rules.options.counts, counts);
  }

  /// The same for pairs between this model and the model of `other`.
  template <Collector C, PairFilter G>
  requires CrossMatrix<D>
  void query(Lazy& other, const CrossRules<P, G, D>& rules, C& collector) {
    if (trees_.empty() || other.trees_.empty()) return;
    const QueryOptions& options = rules.options;
    QueryCounts counts;
    refresh(rules.first);
    other.refresh(rules.second);
    make_upper(options.clearance);
    other.make_upper(options.other_clearance);
    const auto cutoff = [&] { return collector.cutoff(); };
    // Compatible typed matrices have the same table, so a zero row holds for both models. Of any other matrix only one
    // fact is known: all thresholds within a model are 0. It must hold for both models.
    const bool skip_never_colliding =
        without_margin(collector, options) && other.without_margin(collector, options) &&
        (TypedThresholdMatrix<D> || (never_collides_.front() != 0 && other.never_collides_.front() != 0));
    traverse(
        upper_, other.upper_, stack_, counts, cutoff,
        [&](std::uint32_t a, std::uint32_t b) {
          const double extra = extra_of(a, options.clearance) + other.extra_of(b, options.other_clearance);
          const auto inner = [&] { return collector.cutoff() + extra; };
          return traverse(
              trees_[a], other.trees_[b], stack_, counts, inner,
              [&](auto m, auto n) {
                const auto p = layout_->primitives(layout_->first_leaf(a) + m);
                const auto q = other.layout_->primitives(other.layout_->first_leaf(b) + n);
                counts.pairs_tested += p.size() * q.size();
                for (const PrimitiveId i : p)
                  for (const PrimitiveId j : q) {
                    detail::test_pair(collector, i, j, rules.first.placed()[index(i)], rules.second.placed()[index(j)],
                                      rules.threshold(i, j), [&] { return rules.admits(i, j); });
                    if (collector.done()) return false;
                  }
                return true;
              },
              skip_never_colliding);
        },
        skip_never_colliding);
    add(options.counts, counts);
  }

 private:
  using Rules = SelfRules<P, F, D>;

  static void add(QueryCounts* total, const QueryCounts& counts) noexcept {
    if (total == nullptr) return;
    total->boxes_tested += counts.boxes_tested;
    total->nodes_split += counts.nodes_split;
    total->pairs_tested += counts.pairs_tested;
  }

  /// Renews the leaf boxes and the root of every body that moved since its tree was built.
  void refresh(State<P>& state) {
    for (std::size_t b = 0; b < trees_.size(); ++b) {
      std::uint64_t version = 0;  // Versions only grow, so the sum changes when any of them does.
      for (const GroupId g : layout_->groups(b)) version += state.version(g);
      if (version == built_[b]) continue;
      built_[b] = version;
      for (const GroupId g : layout_->groups(b)) state.place(g);
      trees_[b].reset(boxes_of(b, state), idle_of(b));
    }
  }

  /// BioCD eq. (2)-(4): the box of a leaf holds the bounds of its primitives, each inflated by its reach.
  std::span<const Aabb> boxes_of(std::size_t body, const State<P>& state) {
    boxes_.clear();
    for (std::uint32_t l = layout_->first_leaf(body); l < layout_->first_leaf(body + 1); ++l) {
      Aabb box;
      for (const PrimitiveId i : layout_->primitives(l))
        box.extend(state.placed()[index(i)].bounds().inflated(matrix_.reach(i)));
      boxes_.push_back(box);
    }
    return boxes_;
  }

  std::span<const std::uint8_t> idle_of(std::size_t body) const noexcept {
    if (never_collides_.empty()) return {};
    return std::span(never_collides_)
        .subspan(layout_->first_leaf(body), layout_->first_leaf(body + 1) - layout_->first_leaf(body));
  }

  /// Returns true when the query asks for collisions only, so that leaves whose thresholds are all 0 can be skipped.
  template <Collector C>
  bool without_margin(const C& collector, const QueryOptions& options) const noexcept {
    return !never_collides_.empty() && asks_collisions(collector) && !options.adds_clearance();
  }

  double extra_of(std::size_t body, std::span<const double> clearance) const noexcept {
    double extra = 0.0;
    for (const GroupId g : layout_->groups(body)) extra = std::max(extra, detail::clearance_of(clearance, g));
    return extra;
  }

  void make_upper(std::span<const double> clearance) {
    boxes_.clear();
    never_colliding_.clear();
    for (std::size_t b = 0; b < trees_.size(); ++b) {
      never_colliding_.push_back(trees_[b].node(0).never_collides);
      const Aabb& root = trees_[b].node(0).box;
      const double extra = extra_of(b, clearance);
      boxes_.push_back(extra > 0.0 ? root.inflated(extra) : root);
    }
    upper_.reset(boxes_, never_colliding_);
  }

  template <Collector C>
  void run_self(C& collector, const Rules& rules, QueryCounts& counts) {
    const QueryOptions& options = rules.options;
    const bool skip_never_colliding = without_margin(collector, options);
    for (std::uint32_t b = 0; b < trees_.size(); ++b) {
      const bool deforms = rules.state.groups_may_deform();
      if (layout_->groups(b).size() > 1 || deforms)
        for (std::uint32_t l = layout_->first_leaf(b); l < layout_->first_leaf(b + 1); ++l)
          if (!(skip_never_colliding && never_collides_[l] != 0) && !test_leaves(l, l, collector, rules, counts))
            return;
      if (deforms && !test_bodies(b, b, collector, rules, counts)) return;
    }
    make_upper(options.clearance);
    traverse(
        upper_, upper_, stack_, counts, [&] { return collector.cutoff(); },
        [&](std::uint32_t a, std::uint32_t b) {
          return !admits_bodies(a, b, rules) || test_bodies(a, b, collector, rules, counts);
        },
        skip_never_colliding);
  }

  /// Returns true if the options admit pairs of the two bodies.
  bool admits_bodies(std::uint32_t a, std::uint32_t b, const Rules& rules) const noexcept {
    if (!rules.options.moved_only && rules.options.groups.is_all()) return true;
    for (const GroupId g : layout_->groups(a))
      for (const GroupId h : layout_->groups(b))
        if (rules.admits_groups(g, h)) return true;
    return false;
  }

  template <Collector C>
  bool test_bodies(std::uint32_t a, std::uint32_t b, C& collector, const Rules& rules, QueryCounts& counts) {
    const double extra = extra_of(a, rules.options.clearance) + extra_of(b, rules.options.clearance);
    const auto cutoff = [&] { return collector.cutoff() + extra; };
    return traverse(
        trees_[a], trees_[b], stack_, counts, cutoff,
        [&](std::uint32_t m, std::uint32_t n) {
          return test_leaves(layout_->first_leaf(a) + m, layout_->first_leaf(b) + n, collector, rules, counts);
        },
        without_margin(collector, rules.options));
  }

  /// Tests every admitted pair between two leaves, or inside one leaf if a == b. Returns false when the collector is
  /// done.
  template <Collector C>
  bool test_leaves(std::uint32_t a, std::uint32_t b, C& collector, const Rules& rules, QueryCounts& counts) {
    const std::span<const P> placed = rules.state.placed();
    const auto test = [&](PrimitiveId i, PrimitiveId j) {
      detail::test_pair(collector, i, j, placed[index(i)], placed[index(j)], rules.threshold(i, j),
                        [&] { return rules.admits(i, j); });
      return !collector.done();
    };
    std::span<const detail::LazyLayout::PrimitivePair> sri;
    if (layout_->lists(std::min(a, b), std::max(a, b), sri)) {
      counts.pairs_tested += sri.size();
      for (const auto& [i, j] : sri)
        if (!test(i, j)) return false;
      return true;
    }
    const auto p = layout_->primitives(a), q = layout_->primitives(b);
    counts.pairs_tested += a == b ? p.size() * (p.size() - 1) / 2 : p.size() * q.size();
    for (std::size_t m = 0; m < p.size(); ++m)
      for (std::size_t n = a == b ? m + 1 : 0; n < q.size(); ++n)
        if (!test(std::min(p[m], q[n]), std::max(p[m], q[n]))) return false;
    return true;
  }

  std::shared_ptr<const detail::LazyLayout> layout_;  // shared by copies
  D matrix_;
  std::vector<detail::LazyTree> trees_;        // per body; its items are the leaves of the body
  std::vector<std::uint64_t> built_;           // per body: sum of the versions that its tree was built from
  std::vector<std::uint8_t> never_collides_;   // per leaf: 1 if all its thresholds are 0; empty unless P is point-like
  detail::LazyTree upper_;                     // its items are the bodies
  std::vector<std::uint8_t> never_colliding_;  // scratch
  std::vector<Aabb> boxes_;                    // scratch
  detail::NodePairs stack_;                    // scratch
};

}  // namespace hinge
