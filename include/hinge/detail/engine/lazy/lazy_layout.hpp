// SPDX-License-Identifier: BSD-3-Clause
// LazyLayout: the constant data of engine/lazy for one selection of DOF: leaves, bodies, and lists of short-range
// pairs.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <map>
#include <span>
#include <tuple>
#include <utility>
#include <vector>

#include "hinge/core/id.hpp"
#include "hinge/model/selected_model.hpp"
#include "hinge/policy/pair_filter.hpp"
#include "hinge/policy/primitive.hpp"

namespace hinge::detail {

/// Leaves are the basic groups of BioCD section III. A body is the owner of one low-level tree. It is either a rigid
/// group with all basic groups that lie wholly in it, or one basic group that spans several rigid groups (such as a
/// side chain with free torsions); this body has one leaf. Two leaves are near if the filter lists an excluded pair
/// between them. The other, admitted pairs of near leaves form their SRI list (short-range interactions). Large leaves
/// have no list: it would need too much memory.
class LazyLayout {
 public:
  using PrimitivePair = std::pair<PrimitiveId, PrimitiveId>;

  template <Primitive P, PairFilter F>
  LazyLayout(const SelectedModel<P>& model, const F& filter) {
    make_bodies(model);
    if constexpr (ListsExclusions<F>) make_sri_lists(filter);
  }

  std::size_t body_count() const noexcept { return body_leaf_.size() - 1; }
  std::size_t leaf_count() const noexcept { return leaf_start_.size() - 1; }
  /// The leaves of a body are first_leaf(body) .. first_leaf(body + 1) - 1.
  std::uint32_t first_leaf(std::size_t body) const noexcept { return body_leaf_[body]; }
  /// The rigid groups of a body: one, or several for an articulated basic group.
  std::span<const GroupId> groups(std::size_t body) const noexcept {
    return std::span(groups_).subspan(group_start_[body], group_start_[body + 1] - group_start_[body]);
  }
  std::span<const PrimitiveId> primitives(std::uint32_t leaf) const noexcept {
    return std::span(primitives_).subspan(leaf_start_[leaf], leaf_start_[leaf + 1] - leaf_start_[leaf]);
  }
  /// Requires a <= b. Sets `pairs` to the SRI list of the two leaves. Returns false if they have none: test all their
  /// pairs.
  bool lists(std::uint32_t a, std::uint32_t b, std::span<const PrimitivePair>& pairs) const noexcept {
    if (near_start_.empty()) return false;
    const auto end = near_.begin() + static_cast<std::ptrdiff_t>(near_start_[a + 1]);
    const auto found = std::lower_bound(near_.begin() + static_cast<std::ptrdiff_t>(near_start_[a]), end, b,
                                        [](const Near& near, std::uint32_t leaf) { return near.leaf < leaf; });
    if (found == end || found->leaf != b) return false;
    pairs = std::span(sri_).subspan(found->begin, found->end - found->begin);
    return true;
  }

 private:
  struct Near {
    std::uint32_t leaf;
    std::size_t begin, end;  // in sri_
  };
  /// Number of pairs of two leaves up to which an SRI list is made: 32 x 32. The largest basic group of a protein has
  /// 14.
  static constexpr std::size_t longest_list = 1024;

  template <Primitive P>
  void make_bodies(const SelectedModel<P>& model);
  template <ListsExclusions F>
  void make_sri_lists(const F& filter);

  std::vector<std::uint32_t> body_leaf_;
  std::vector<std::size_t> group_start_;
  std::vector<GroupId> groups_;
  std::vector<std::size_t> leaf_start_;
  std::vector<PrimitiveId> primitives_;
  std::vector<std::size_t> near_start_;
  std::vector<Near> near_;
  std::vector<PrimitivePair> sri_;
};

template <Primitive P>
void LazyLayout::make_bodies(const SelectedModel<P>& model) {
  // Collect primitives by basic group. A basic group is a leaf of its rigid group's body, or a body of its own.
  std::map<std::uint32_t, std::vector<PrimitiveId>> basic;
  for (std::size_t i = 0; i < model.size(); ++i) basic[model.model().basic_groups()[i]].push_back(id<PrimitiveId>(i));
  struct Leaf {
    std::vector<GroupId> groups;
    PrimitiveId front;
    const std::vector<PrimitiveId>* primitives;
  };
  std::vector<Leaf> leaves;
  for (const auto& [label, primitives] : basic) {
    Leaf leaf{{}, primitives.front(), &primitives};
    for (const PrimitiveId i : primitives) leaf.groups.push_back(model.group_of(i));
    std::sort(leaf.groups.begin(), leaf.groups.end());
    leaf.groups.erase(std::unique(leaf.groups.begin(), leaf.groups.end()), leaf.groups.end());
    leaves.push_back(std::move(leaf));
  }
  const auto articulated = [](const Leaf& leaf) { return leaf.groups.size() > 1; };
  std::sort(leaves.begin(), leaves.end(), [&](const Leaf& a, const Leaf& b) {
    return std::tuple(articulated(a), articulated(a) ? GroupId{} : a.groups.front(), a.front) <
           std::tuple(articulated(b), articulated(b) ? GroupId{} : b.groups.front(), b.front);
  });
  leaf_start_.assign(1, 0);
  group_start_.assign(1, 0);
  for (std::size_t l = 0; l < leaves.size(); ++l) {
    const Leaf& leaf = leaves[l];
    const bool joins = l > 0 && !articulated(leaf) && leaf.groups == leaves[l - 1].groups;
    if (!joins) {
      body_leaf_.push_back(static_cast<std::uint32_t>(l));
      groups_.insert(groups_.end(), leaf.groups.begin(), leaf.groups.end());
      group_start_.push_back(groups_.size());
    }
    primitives_.insert(primitives_.end(), leaf.primitives->begin(), leaf.primitives->end());
    leaf_start_.push_back(primitives_.size());
  }
  body_leaf_.push_back(static_cast<std::uint32_t>(leaves.size()));
}

template <ListsExclusions F>
void LazyLayout::make_sri_lists(const F& filter) {
  std::vector<std::uint32_t> leaf_of(primitives_.size());
  for (std::uint32_t l = 0; l < leaf_count(); ++l)
    for (const PrimitiveId i : primitives(l)) leaf_of[index(i)] = l;
  near_start_.assign(1, 0);
  std::vector<std::uint32_t> neighbours;
  for (std::uint32_t a = 0; a < leaf_count(); ++a) {
    neighbours.clear();
    for (const PrimitiveId i : primitives(a))
      for (const PrimitiveId j : std::span<const PrimitiveId>(filter.excluded(i)))
        if (leaf_of[index(j)] >= a) neighbours.push_back(leaf_of[index(j)]);
    std::sort(neighbours.begin(), neighbours.end());
    neighbours.erase(std::unique(neighbours.begin(), neighbours.end()), neighbours.end());
    for (const std::uint32_t b : neighbours) {
      if (primitives(a).size() * primitives(b).size() > longest_list) continue;
      const std::size_t begin = sri_.size();
      for (const PrimitiveId i : primitives(a))
        for (const PrimitiveId j : primitives(b))
          if ((a != b || i < j) && filter.admits(i, j)) sri_.emplace_back(std::min(i, j), std::max(i, j));
      near_.push_back({b, begin, sri_.size()});
    }
    near_start_.push_back(near_.size());
  }
}

}  // namespace hinge::detail
