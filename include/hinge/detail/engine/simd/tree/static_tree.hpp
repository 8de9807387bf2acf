// SPDX-License-Identifier: BSD-3-Clause
// Static sixteen-wide box trees over primitives in their group's frame: TreeBuilder builds them, TreeStore holds them.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "hinge/core/vec3.hpp"
#include "hinge/detail/bounds/float_box.hpp"
#include "hinge/detail/simd/lanes.hpp"

namespace hinge::detail {

/// A box of a tree: lane + 16 * node. Every box is around a node or a leaf.
using BoxId = std::uint32_t;

/// One box, outside a node.
struct TreeBox {
  std::array<float, 3> middle{}, half{};
};

/// At most sixteen boxes, each around a node or a leaf.
struct alignas(64) TreeNode {
  static constexpr std::uint32_t leaf_bit = 0x80000000U;

  std::array<float, 3 * simd::width> middle{};
  std::array<float, 3 * simd::width> half{};  ///< rounded up, inflated by the reach of the contents
  std::array<std::uint32_t, simd::width> child{};
  std::array<float, simd::width> size{};  ///< longest half length of each box
  simd::Bits used = 0;                    ///< lanes that hold boxes
  simd::Bits inner = 0;                   ///< lanes whose box holds a node; the other used lanes hold leaves

  void set(std::size_t lane, const TreeBox& box) noexcept {
    used |= simd::Bits{1} << lane;
    for (std::size_t k = 0; k < 3; ++k) {
      middle[k * simd::width + lane] = box.middle[k];
      half[k * simd::width + lane] = box.half[k];
      size[lane] = std::max(size[lane], box.half[k]);
    }
  }
  void set_child(std::size_t lane, std::uint32_t to) noexcept {
    child[lane] = to;
    if ((to & leaf_bit) == 0) inner |= simd::Bits{1} << lane;
  }
};

/// Input of a tree: the box of a primitive relative to the tree's origin, scaled, rounded outward.
struct BuildItem {
  std::array<float, 3> lower, upper;
  std::uint32_t primitive;

  float twice_middle(std::size_t axis) const noexcept { return lower[axis] + upper[axis]; }
};

/// Nodes and leaves of all trees of one model. Leaf l holds the primitives of slots 16 l .. 16 l + 15.
struct TreeStore {
  simd::AlignedVector<TreeNode> nodes;
  std::vector<std::uint32_t> slots;  ///< primitives; padding repeats the leaf's first primitive
  std::vector<simd::Bits> real;      ///< per leaf: lanes that are not padding

  TreeBox box(BoxId id) const noexcept {
    const TreeNode& node = nodes[id / simd::width];
    const std::size_t lane = id % simd::width;
    TreeBox box;
    for (std::size_t k = 0; k < 3; ++k) {
      box.middle[k] = node.middle[k * simd::width + lane];
      box.half[k] = node.half[k * simd::width + lane];
    }
    return box;
  }
  bool is_leaf(BoxId id) const noexcept { return (child(id) & TreeNode::leaf_bit) != 0; }
  std::uint32_t leaf(BoxId id) const noexcept { return child(id) & ~TreeNode::leaf_bit; }
  std::uint32_t child(BoxId id) const noexcept { return nodes[id / simd::width].child[id % simd::width]; }
  float size(BoxId id) const noexcept { return nodes[id / simd::width].size[id % simd::width]; }
};

/// Builds trees one after the other into a store. A node splits its child of largest surface until it has sixteen
/// children. A split minimises surface times leaves: over sixteen bins along the widest axes, or over all cuts for few
/// leaves. Cuts fall on multiples of sixteen, so leaves are full. O(n log n), no recursion.
class TreeBuilder {
 public:
  struct Tree {
    BoxId root = 0;  ///< the only box of its node
    std::size_t depth = 0;
  };

  /// Builds a tree over at least one item. Reorders the items.
  Tree build(std::span<BuildItem> items, TreeStore& store) {
    const auto top = static_cast<std::uint32_t>(store.nodes.size());
    store.nodes.emplace_back();
    stack_.assign(1, {items, top, 0, 1});
    place({items, hull(items)}, store, top, 0);
    std::size_t depth = 1;
    while (!stack_.empty()) {
      const Open open = stack_.back();
      stack_.pop_back();
      depth = std::max(depth, open.depth);
      if (open.items.size() <= simd::width) {
        store.nodes[open.node].set_child(open.lane, TreeNode::leaf_bit | add_leaf(open.items, store));
        continue;
      }
      const auto node = static_cast<std::uint32_t>(store.nodes.size());
      store.nodes.emplace_back();
      store.nodes[open.node].set_child(open.lane, node);
      split(open.items);
      for (std::size_t lane = 0; lane < parts_.size(); ++lane) place(parts_[lane], store, node, lane);
      for (std::size_t lane = parts_.size(); lane-- > 0;)
        stack_.push_back({parts_[lane].items, node, static_cast<std::uint32_t>(lane), open.depth + 1});
    }
    return {static_cast<BoxId>(top * simd::width), depth};
  }

 private:
  struct Part {
    std::span<BuildItem> items;
    FloatBox box;
  };
  struct Open {
    std::span<BuildItem> items;
    std::uint32_t node, lane;
    std::size_t depth;
  };
  static constexpr std::size_t bins = 16;
  static constexpr std::size_t few = 8 * simd::width;  // up to this many primitives, every cut is tried

  static void extend(FloatBox& box, const BuildItem& item) noexcept {
    for (std::size_t k = 0; k < 3; ++k) {
      box.lower[k] = std::min(box.lower[k], item.lower[k]);
      box.upper[k] = std::max(box.upper[k], item.upper[k]);
    }
  }
  static FloatBox hull(std::span<const BuildItem> items) noexcept {
    FloatBox box;
    for (const BuildItem& item : items) extend(box, item);
    return box;
  }
  static float surface(const FloatBox& box) noexcept {
    const float x = box.upper[0] - box.lower[0], y = box.upper[1] - box.lower[1], z = box.upper[2] - box.lower[2];
    return x * y + y * z + z * x;
  }
  static float cost(const FloatBox& box, std::size_t n) noexcept {
    const std::size_t leaves = (n + simd::width - 1) / simd::width;
    return n == 0 ? 0.0F : surface(box) * static_cast<float>(leaves);
  }

  static void place(const Part& part, TreeStore& store, std::uint32_t n, std::size_t lane) noexcept {
    TreeBox box;
    for (std::size_t k = 0; k < 3; ++k) {
      const float low = part.box.lower[k], high = part.box.upper[k];
      box.middle[k] = low / 2 + high / 2;
      // One rounding of the difference and one of the middle.
      box.half[k] = std::max(high - box.middle[k], box.middle[k] - low) * (1.0F + 0x1p-22F);
    }
    store.nodes[n].set(lane, box);
  }

  static std::uint32_t add_leaf(std::span<const BuildItem> items, TreeStore& store) {
    const auto leaf = static_cast<std::uint32_t>(store.real.size());
    for (const BuildItem& item : items) store.slots.push_back(item.primitive);
    for (std::size_t k = items.size(); k < simd::width; ++k) store.slots.push_back(items.front().primitive);
    store.real.push_back((simd::Bits{1} << items.size()) - 1);
    return leaf;
  }

  /// Splits the items into parts_, at most sixteen.
  void split(std::span<BuildItem> items) {
    parts_.assign(1, {items, hull(items)});
    while (parts_.size() < simd::width) {
      std::size_t largest = parts_.size();
      float most = -1.0F;
      for (std::size_t p = 0; p < parts_.size(); ++p) {
        const float area = surface(parts_[p].box);
        if (parts_[p].items.size() <= simd::width || area < most) continue;
        // All surfaces are 0 if the items lie on a line or in a point: take the largest set.
        if (area == most && parts_[p].items.size() <= parts_[largest].items.size()) continue;
        most = area;
        largest = p;
      }
      if (largest == parts_.size()) return;
      const std::span<BuildItem> all = parts_[largest].items;
      const std::size_t cut = all.size() <= few ? try_every_cut(all) : best_bin(parts_[largest]);
      parts_[largest] = {all.first(cut), hull(all.first(cut))};
      parts_.push_back({all.subspan(cut), hull(all.subspan(cut))});
    }
  }

  static auto along(std::size_t axis) noexcept {
    // Break ties by index: the tree does not depend on the order of the items.
    return [axis](const BuildItem& a, const BuildItem& b) {
      const float x = a.twice_middle(axis), y = b.twice_middle(axis);
      return x != y ? x < y : a.primitive < b.primitive;
    };
  }

  /// Sorts along each axis and tries all cuts at multiples of sixteen. Leaves the items partitioned at the best cut.
  static std::size_t try_every_cut(std::span<BuildItem> items) noexcept {
    std::size_t best_axis = 0, best_cut = simd::width;
    float least = std::numeric_limits<float>::infinity();
    std::array<FloatBox, few / simd::width + 1> after;
    std::size_t sorted = 3;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      std::sort(items.begin(), items.end(), along(axis));
      sorted = axis;
      const std::size_t leaves = (items.size() + simd::width - 1) / simd::width;
      after[leaves] = FloatBox{};
      for (std::size_t l = leaves; l-- > 0;) {
        after[l] = after[l + 1];
        for (std::size_t k = l * simd::width; k < std::min(items.size(), (l + 1) * simd::width); ++k)
          extend(after[l], items[k]);
      }
      FloatBox before;
      for (std::size_t l = 1; l < leaves; ++l) {
        const std::size_t at = l * simd::width;
        for (std::size_t k = at - simd::width; k < at; ++k) extend(before, items[k]);
        const float c = cost(before, at) + cost(after[l], items.size() - at);
        if (c < least) {
          least = c;
          best_axis = axis;
          best_cut = at;
        }
      }
    }
    if (best_axis != sorted) std::nth_element(items.begin(), at(items, best_cut), items.end(), along(best_axis));
    return best_cut;
  }
  static std::span<BuildItem>::iterator at(std::span<BuildItem> items, std::size_t k) noexcept {
    return items.begin() + static_cast<std::ptrdiff_t>(k);
  }

  static std::size_t best_bin(const Part& part) noexcept {
    const std::span<BuildItem> items = part.items;
    FloatBox middles;  // of twice the middles
    for (const BuildItem& item : items)
      for (std::size_t k = 0; k < 3; ++k) {
        middles.lower[k] = std::min(middles.lower[k], item.twice_middle(k));
        middles.upper[k] = std::max(middles.upper[k], item.twice_middle(k));
      }
    std::size_t best_axis = 0, best_count = items.size() / 2;
    float least = std::numeric_limits<float>::infinity();
    for (std::size_t k = 1; k < 3; ++k)
      if (middles.upper[k] - middles.lower[k] > middles.upper[best_axis] - middles.lower[best_axis]) best_axis = k;
    const float widest = middles.upper[best_axis] - middles.lower[best_axis];
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const float low = middles.lower[axis], width = middles.upper[axis] - low;
      // Skip short axes.
      if (!(width > widest / 4) || !(width > 0.0F)) continue;
      const float per_unit = static_cast<float>(bins) / width;
      if (!std::isfinite(per_unit)) continue;
      std::array<std::size_t, bins> count{};
      std::array<FloatBox, bins> box;
      for (const BuildItem& item : items) {
        const auto b = std::min(bins - 1, static_cast<std::size_t>((item.twice_middle(axis) - low) * per_unit));
        ++count[b];
        extend(box[b], item);
      }
      std::array<FloatBox, bins> after = box;
      for (std::size_t b = bins - 1; b-- > 0;) after[b].extend(after[b + 1]);
      FloatBox before;
      std::size_t n = 0;
      for (std::size_t b = 0; b + 1 < bins; ++b) {
        before.extend(box[b]);
        n += count[b];
        if (n == 0 || n == items.size()) continue;
        const float c = cost(before, n) + cost(after[b + 1], items.size() - n);
        if (c < least) {
          least = c;
          best_axis = axis;
          best_count = n;
        }
      }
    }
    // Each side gets at least a sixteenth of the leaves, so that no input makes building quadratic.
    const std::size_t leaves = (items.size() + simd::width - 1) / simd::width, least_leaves = leaves / 16 + 1;
    const std::size_t cut =
        std::clamp((best_count + simd::width / 2) / simd::width, least_leaves, leaves - least_leaves) * simd::width;
    std::nth_element(items.begin(), at(items, cut), items.end(), along(best_axis));
    return cut;
  }

  std::vector<Part> parts_;
  std::vector<Open> stack_;
};

}  // namespace hinge::detail
