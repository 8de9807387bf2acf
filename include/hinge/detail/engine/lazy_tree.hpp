// SPDX-License-Identifier: BSD-3-Clause
// LazyTree: a binary tree of boxes over items, split on demand (BioCD section IV). Knows boxes only.
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

/// Items are numbered 0 .. n-1; reset() computes the root only, everything below comes with split(). The same boxes
/// give the same tree whatever was there before. Nothing recurses; depth is at most 3 ceil(log2 n) + 9.
class LazyTree {
 public:
  struct Node {
    Aabb box;
    std::uint32_t begin = 0;  ///< range of items in order()
    std::uint32_t end = 0;
    std::uint32_t left = 0;  ///< children are left and left + 1; 0 while not split
    std::uint32_t depth = 0;
    bool never_collides = false;  ///< all its items are
    bool is_leaf() const noexcept { return end - begin == 1; }
    std::uint32_t size() const noexcept { return end - begin; }
  };

  /// Drops the tree and makes the root of these boxes; at least one. never_collides: items, not 0, that queries without
  /// a margin may pass over; empty: none. Both are copied.
  void reset(std::span<const Aabb> boxes, std::span<const std::uint8_t> never_collides = {});

  const Node& node(std::uint32_t k) const noexcept { return nodes_[k]; }
  std::size_t node_count() const noexcept { return nodes_.size(); }
  /// The item of a leaf.
  std::uint32_t item(const Node& leaf) const noexcept { return order_[leaf.begin]; }
  std::span<const std::uint32_t> order() const noexcept { return order_; }

  /// Makes the children of a node that is no leaf, if it has none yet; true when it made them.
  bool split(std::uint32_t k) {
    if (nodes_[k].left != 0) return false;
    make_children(k);
    return true;
  }

 private:
  void make_children(std::uint32_t k);
  /// Fills in the box of a node, and whether it is never_collides.
  void join_items(Node& node) const noexcept {
    node.never_collides = !never_collides_.empty();
    for (std::uint32_t i = node.begin; i < node.end; ++i) {
      node.box.extend(boxes_[order_[i]]);
      node.never_collides = node.never_collides && never_collides_[order_[i]] != 0;
    }
  }
  /// Number of items that go left, after reordering the node's range.
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
  // The midpoint rule can be one-sided on clustered or coincident input, level after level. Natural input stays within
  // log2 n + 6 levels; beyond twice that plus a margin the median takes over and halves the rest.
  midpoint_depth_ = 2 * static_cast<std::uint32_t>(std::bit_width(boxes_.size() - 1)) + 8;
}

inline std::uint32_t LazyTree::partition(const Node& node) {
  // BioCD Fig. 6: widest dimension, middle value (max + min) / 2, boxes by centre; a box longer than half the node goes
  // alone to the left.
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

/// Does every built node hold its items' boxes, within the depth bound, and do children share out their parent's items?
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
