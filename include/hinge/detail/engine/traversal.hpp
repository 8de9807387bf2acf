// SPDX-License-Identifier: BSD-3-Clause
// traverse: the descent through one or two lazy trees (BioCD Fig. 7), with an explicit stack.
#pragma once

#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

#include "hinge/bounds/aabb.hpp"
#include "hinge/detail/engine/lazy_tree.hpp"
#include "hinge/query/query_options.hpp"

namespace hinge::detail {

/// Pairs of node numbers still to be tested. The vector keeps its memory between queries.
using NodePairs = std::vector<std::pair<std::uint32_t, std::uint32_t>>;

/// Returns true if the contents of two boxes (inflated by reach) may have d - M <= cutoff.
inline bool reaches(const Aabb& a, const Aabb& b, double cutoff) noexcept {
  return cutoff == 0.0 ? overlap(a, b) : separation(a, b) <= cutoff;
}

/// Calls visit(item of a, item of b) -> bool for every pair of leaves whose boxes may hold a wanted pair. Stops and
/// returns false when visit returns false. cutoff() may shrink during the descent. If a and b are the same tree, every
/// unordered pair of different leaves is visited once. skip_never_colliding: skips pairs in which an item never
/// collides.
template <class Cutoff, class Visit>
bool traverse(LazyTree& a, LazyTree& b, NodePairs& stack, QueryCounts& counts, const Cutoff& cutoff, const Visit& visit,
              bool skip_never_colliding = false) {
  const bool self = &a == &b;
  const auto push = [&](std::uint32_t m, std::uint32_t n) {
    if (skip_never_colliding && (a.node(m).never_collides || b.node(n).never_collides)) return;
    ++counts.boxes_tested;
    if (reaches(a.node(m).box, b.node(n).box, cutoff())) stack.emplace_back(m, n);
  };
  const auto split = [&](LazyTree& tree, std::uint32_t k) {
    if (tree.split(k)) ++counts.nodes_split;
    return tree.node(k).left;
  };
  const std::size_t floor = stack.size();  // entries below belong to an outer descent in progress
  if (self)
    stack.emplace_back(0, 0);
  else
    push(0, 0);
  while (stack.size() > floor) {
    const auto [m, n] = stack.back();
    stack.pop_back();
    if (self && m == n) {
      if (a.node(m).is_leaf() || (skip_never_colliding && a.node(m).never_collides)) continue;
      const std::uint32_t left = split(a, m);
      stack.emplace_back(left, left);
      stack.emplace_back(left + 1, left + 1);
      push(left, left + 1);
      continue;
    }
    const LazyTree::Node& p = a.node(m);
    const LazyTree::Node& q = b.node(n);
    if (p.is_leaf() && q.is_leaf()) {
      if (!reaches(p.box, q.box, cutoff())) continue;  // the cutoff may have shrunk since the push
      if (!visit(a.item(p), b.item(q))) {
        stack.resize(floor);
        return false;
      }
    } else if (q.is_leaf() || (!p.is_leaf() && p.size() >= q.size())) {
      const std::uint32_t left = split(a, m);
      push(left, n);
      push(left + 1, n);
    } else {
      const std::uint32_t left = split(b, n);
      push(m, left);
      push(m, left + 1);
    }
  }
  return true;
}

}  // namespace hinge::detail
