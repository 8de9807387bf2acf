// SPDX-License-Identifier: BSD-3-Clause
// LazyTree: a binary tree of boxes over items, split on demand (BioCD section IV). It knows boxes only.
#pragma once

#include <algorithm>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <numeric>
#include <span>
#include <vector>

#include "hinge/bounds/aabb.hpp"
#include "hinge/detail/core/assert.hpp"

namespace hinge::detail {

/// Items are numbered 0 .. n-1. reset() computes the root only; split() creates the nodes below. The same boxes always
/// give the same tree. No recursion; depth is at most 3 ceil(log2 n) + 9.
class LazyTree {
 public:
  struct Node {
    Aabb box;
    std::uint32_t begin = 0;  ///< first item in order()
    std::uint32_t end = 0;    ///< one past the last item in order()
    std::uint32_t left = 0;   ///< children are left and left + 1; 0 until the node is split
    std::uint32_t depth = 0;
    bool never_collides = false;  ///< true if all its items never collide
    bool is_leaf() const noexcept { return end - begin == 1; }
    std::uint32_t size() const noexcept { return end - begin; }
  };

  /// Replaces the tree by the root of these boxes (at least one). never_collides: nonzero for items that queries
  /// without a margin may skip; empty means no item. Both are copied.
  void reset(std::span<const Aabb> boxes, std::span<const std::uint8_t> never_collides = {});

  const Node& node(std::uint32_t k) const noexcept { return nodes_[k]; }
  std::size_t node_count() const noexcept { return nodes_.size(); }
  /// The item of a leaf.
  std::uint32_t item(const Node& leaf) const noexcept { return order_[leaf.begin]; }
  std::span<const std::uint32_t> order() const noexcept { return order_; }

  /// Creates the children of an inner node unless they exist. Returns true if it created them.
  bool split(std::uint32_t k) {
    if (nodes_[k].left != 0) return false;
    make_children(k);
    return true;
  }

 private:
  void make_children(std::uint32_t k);
  /// Computes the box of a node, and its never_collides flag.
  void join_items(Node& node) const noexcept {
    node.never_collides = !never_collides_.empty();
    for (std::uint32_t i = node.begin; i < node.end; ++i) {
      node.box.extend(boxes_[order_[i]]);
      node.never_collides = node.never_collides && never_collides_[order_[i]] != 0;
    }
  }
  /// Reorders the node's range of items. Returns the number of items that go to the left child.
  std::uint32_t partition(const Node& node);

  std::vector<Aabb> boxes_;
  std::vector<std::uint8_t> never_collides_;
  std::vector<std::uint32_t> order_;
  std::vector<Node> nodes_;
  std::uint32_t midpoint_depth_ = 0;
};

inline void LazyTree::reset(std::span<const Aabb> boxes, std::span<const std::uint8_t> never_collides) {
  HINGE_ASSERT(never_collides.empty() || never_collides.size() == boxes.size());
  HINGE_ASSERT(!boxes.empty());
  boxes_.assign(boxes.begin(), boxes.end());
  never_collides_.assign(never_collides.begin(), never_collides.end());
  order_.resize(boxes.size());
  std::iota(order_.begin(), order_.end(), 0U);
  Node root;
  root.end = static_cast<std::uint32_t>(boxes_.size());
  join_items(root);
  nodes_.clear();
  nodes_.push_back(root);
  // The midpoint rule can give one-sided splits at every level if the input is clustered or coincident. Natural input
  // stays within log2 n + 6 levels. Below 2 log2 n + 8 levels, the median rule halves the rest.
  midpoint_depth_ = 2 * static_cast<std::uint32_t>(std::bit_width(boxes_.size() - 1)) + 8;
}

inline std::uint32_t LazyTree::partition(const Node& node) {
  // BioCD Fig. 6: split the widest axis at its middle value (max + min) / 2, items by their centre. An item longer than
  // half the node goes alone to the left.
  const int axis = node.box.widest_axis();
  const auto first = order_.begin() + node.begin, last = order_.begin() + node.end;
  if (node.depth <= midpoint_depth_) {
    const double half = node.box.length(axis) / 2;
    const auto longer = std::find_if(first, last, [&](std::uint32_t i) { return boxes_[i].length(axis) > half; });
    if (longer != last) {
      std::iter_swap(first, longer);
      return 1;
    }
    const double middle = node.box.middle(axis);
    const auto border = std::partition(first, last, [&](std::uint32_t i) { return boxes_[i].middle(axis) <= middle; });
    if (border != first && border != last) return static_cast<std::uint32_t>(border - first);
  }
  const auto median = first + node.size() / 2;
  std::nth_element(first, median, last, [&](std::uint32_t i, std::uint32_t j) {
    const double a = boxes_[i].middle(axis), b = boxes_[j].middle(axis);
    return a < b || (a == b && i < j);
  });
  return node.size() / 2;
}

inline void LazyTree::make_children(std::uint32_t k) {
  const Node node = nodes_[k];
  HINGE_ASSERT(!node.is_leaf());
  const std::uint32_t border = node.begin + partition(node);
  Node left, right;
  left.begin = node.begin;
  left.end = right.begin = border;
  right.end = node.end;
  left.depth = right.depth = node.depth + 1;
  join_items(left);
  join_items(right);
  nodes_[k].left = static_cast<std::uint32_t>(nodes_.size());
  nodes_.push_back(left);
  nodes_.push_back(right);
}

/// Returns true if every built node is the hull of its items' boxes and keeps the depth bound, and if children
/// partition their parent's items.
inline bool check_well_formed(const LazyTree& tree, std::span<const Aabb> boxes) {
  const auto levels = static_cast<std::uint32_t>(std::bit_width(boxes.size() - 1));
  for (std::uint32_t k = 0; k < tree.node_count(); ++k) {
    const LazyTree::Node& node = tree.node(k);
    if (node.begin >= node.end || node.depth > 3 * levels + 9) return false;
    Aabb box;
    for (std::uint32_t i = node.begin; i < node.end; ++i) box.extend(boxes[tree.order()[i]]);
    if (!node.box.contains(box) || !box.contains(node.box)) return false;
    if (node.left == 0) continue;
    const LazyTree::Node &left = tree.node(node.left), &right = tree.node(node.left + 1);
    if (left.begin != node.begin || left.end != right.begin || right.end != node.end) return false;
  }
  return true;
}

}  // namespace hinge::detail
