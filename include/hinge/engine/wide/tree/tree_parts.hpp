// SPDX-License-Identifier: BSD-3-Clause
// TreeParts: one static tree per link of a rigid group, all in the group's frame, and which of them are tested.
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <numeric>
#include <span>
#include <utility>
#include <vector>

#include "hinge/bounds/aabb.hpp"
#include "hinge/bounds/float_box.hpp"
#include "hinge/core/id.hpp"
#include "hinge/engine/wide/rigid_blocks.hpp"
#include "hinge/engine/wide/tree/earlier_parts.hpp"
#include "hinge/engine/wide/tree/static_tree.hpp"
#include "hinge/kinematics/pose_source.hpp"
#include "hinge/model/selected_model.hpp"
#include "hinge/policy/distance_matrix.hpp"
#include "hinge/policy/pair_filter.hpp"
#include "hinge/policy/primitive.hpp"
#include "hinge/primitive/leaf.hpp"
#include "hinge/primitive/triangle_leaf.hpp"

namespace hinge {

/// The primitives of one link. Lengths in the unit of the trees.
struct TreePart {
  BoxId root = 0;
  std::uint32_t top = 0;  ///< what the root's box holds: a node or a leaf
  TreeBox root_box{};     ///< the same as in its node, all in one place
  float root_size = 0.0F;
  std::uint32_t group = 0;
  LinkId link{};
  float extent = 0.0F;  ///< largest magnitude of a coordinate, without reaches
  float reach = 0.0F;   ///< the largest
  LocalBox box;         ///< in the group's frame, around everything, reaches included
};

/// Sixteen parts' boxes and balls about their middles, relative to their trees' origins.
struct alignas(64) PartRow {
  std::array<float, 3 * simd::width> middle{};
  std::array<float, 3 * simd::width> half{};  ///< reaches included, here and below
  std::array<float, simd::width> radius{};
};

/// Computed once when the DOF are selected; shared by copies of an engine.
template <Primitive P>
struct TreeParts {
  template <PairFilter F, DistanceMatrix D>
  TreeParts(const SelectedModel<P>& model, const F& filter, const D& matrix);

  /// Bits of the parts 16 row ... 16 row + 15 that are tested with part p; only of earlier parts.
  simd::Bits tested_with(std::size_t p, std::size_t row) const noexcept { return tested.get(p, row); }
  std::size_t rows() const noexcept { return (parts.size() + simd::width - 1) / simd::width; }

  const float* leaf(std::uint32_t l) const noexcept { return leaves.data() + std::size_t{l} * Leaf<P>::floats; }
  /// Null where all reaches are 0.
  const float* leaf_reach(std::uint32_t l) const noexcept {
    return reaches.empty() ? nullptr : reaches.data() + std::size_t{l} * simd::width;
  }

  std::vector<TreePart> parts;  ///< by group
  /// Per group: all its parts under one root; only where there are two to sixteen, else the link is the world's.
  std::vector<TreePart> merged;
  simd::AlignedVector<PartRow> part_rows;
  std::vector<Vec3> origin;  ///< per group: of its trees, in its frame
  double scale = 1.0;        ///< power of two that brings the largest group to a size where float products are safe
  Vec3 world_origin = Vec3::Zero();  ///< about where the model is at the reference
  TreeStore store;
  simd::AlignedVector<float> leaves;
  simd::AlignedVector<float> reaches;
  EarlierParts tested;
  double largest_threshold = 0.0;  ///< no pair has a larger one, model unit
  std::size_t depth = 0;           ///< of the deepest tree, merged ones included

 private:
  void set_row(std::size_t p, const Aabb& whole, std::span<const BuildItem> items, const Vec3& o);
  void merge(std::size_t first, std::size_t last);
  void measure(const SelectedModel<P>& model, const std::vector<Aabb>& boxes);
  template <DistanceMatrix D>
  void build(const SelectedModel<P>& model, const D& matrix, const std::vector<Aabb>& boxes);
};

template <Primitive P>
template <PairFilter F, DistanceMatrix D>
TreeParts<P>::TreeParts(const SelectedModel<P>& model, const F& filter, const D& matrix) {
  std::vector<Aabb> boxes(model.size());
  for (std::size_t i = 0; i < model.size(); ++i) boxes[i] = model.primitives()[i].bounds();
  measure(model, boxes);
  build(model, matrix, boxes);
  merged.resize(model.groups()->size());
  for (std::size_t first = 0, last = 0; first < parts.size(); first = last) {
    while (last < parts.size() && parts[last].group == parts[first].group) ++last;
    if (last - first >= 2 && last - first <= simd::width) merge(first, last);
  }
  // Parts of one group stand together.
  for (std::size_t p = 0, group = 0; p < parts.size(); ++p) {
    if (parts[group].group != parts[p].group) group = p;
    tested.add(group);
    if constexpr (AdmitsLinks<F>)
      for (std::size_t q = 0; q < group; ++q)
        if (!filter.admits(parts[q].link, parts[p].link)) tested.leave_out(q);
  }
}

template <Primitive P>
void TreeParts<P>::measure(const SelectedModel<P>& model, const std::vector<Aabb>& boxes) {
  const std::size_t groups = model.groups()->size();
  PoseSource reference(model.groups(), model.selection().size());
  double size = 0.0;
  Aabb all;
  for (std::size_t g = 0; g < groups; ++g) {
    Aabb box;
    for (const PrimitiveId i : model.primitives_of(id<GroupId>(g))) box.extend(boxes[index(i)]);
    origin.emplace_back(Vec3::Zero());
    if (box.is_empty()) continue;
    for (int k = 0; k < 3; ++k) {
      origin[g][k] = box.middle(k);
      size = std::max(size, box.length(k));
    }
    all.extend(reference.pose(id<GroupId>(g)) * origin[g]);
  }
  for (int k = 0; k < 3 && !all.is_empty(); ++k) world_origin[k] = all.middle(k);
  int exponent = 0;
  if (size > 0.0) std::frexp(size, &exponent);
  scale = size > 0.0 ? std::ldexp(1.0, std::clamp(6 - exponent, -1000, 1000)) : 1.0;
}

template <Primitive P>
void TreeParts<P>::set_row(std::size_t p, const Aabb& whole, std::span<const BuildItem> items, const Vec3& o) {
  if (p % simd::width == 0) part_rows.emplace_back();
  PartRow& row = part_rows.back();
  const std::size_t lane = p % simd::width;
  double squared = 0.0;
  std::array<double, 3> middle{};
  for (std::size_t k = 0; k < 3; ++k) {
    const auto axis = static_cast<Eigen::Index>(k);
    const auto rounded = static_cast<float>((whole.middle(static_cast<int>(k)) - o[axis]) * scale);
    middle[k] = static_cast<double>(rounded);
    double half = 0.0;
    for (const BuildItem& item : items)
      half = std::max(
          {half, static_cast<double>(item.upper[k]) - middle[k], middle[k] - static_cast<double>(item.lower[k])});
    row.middle[k * simd::width + lane] = rounded;
    row.half[k * simd::width + lane] = float_above(half);
  }
  // Each primitive lies in the ball around its box.
  for (const BuildItem& item : items) {
    double square = 0.0;
    for (std::size_t k = 0; k < 3; ++k) {
      const double far =
          std::max(static_cast<double>(item.upper[k]) - middle[k], middle[k] - static_cast<double>(item.lower[k]));
      square += far * far;
    }
    squared = std::max(squared, square);
  }
  row.radius[lane] = float_above(std::sqrt(squared) * (1 + 0x1p-40));
}

template <Primitive P>
void TreeParts<P>::merge(std::size_t first, std::size_t last) {
  TreePart& whole = merged[parts[first].group];
  whole = parts[first];
  const auto node = static_cast<std::uint32_t>(store.nodes.size());
  whole.root = static_cast<BoxId>((node + 1) * simd::width);
  whole.top = node;
  TreeNode all, top;
  std::array<double, 3> lower, upper;
  lower.fill(std::numeric_limits<double>::infinity());
  upper.fill(-std::numeric_limits<double>::infinity());
  for (std::size_t p = first; p < last; ++p) {
    const TreePart& part = parts[p];
    all.set(p - first, part.root_box);
    all.set_child(p - first, part.top);
    for (std::size_t k = 0; k < 3; ++k) {
      const auto middle = static_cast<double>(part.root_box.middle[k]),
                 half = static_cast<double>(part.root_box.half[k]);
      lower[k] = std::min(lower[k], middle - half);
      upper[k] = std::max(upper[k], middle + half);
    }
    whole.extent = std::max(whole.extent, part.extent);
    whole.reach = std::max(whole.reach, part.reach);
  }
  for (std::size_t k = 0; k < 3; ++k) {
    whole.root_box.middle[k] = static_cast<float>((lower[k] + upper[k]) / 2);
    const auto middle = static_cast<double>(whole.root_box.middle[k]);
    whole.root_box.half[k] = float_above(std::max(upper[k] - middle, middle - lower[k]) * (1 + 0x1p-50));
  }
  top.set(0, whole.root_box);
  top.set_child(0, node);
  whole.root_size = top.size[0];
  store.nodes.push_back(all);
  store.nodes.push_back(top);
}

template <Primitive P>
template <DistanceMatrix D>
void TreeParts<P>::build(const SelectedModel<P>& model, const D& matrix, const std::vector<Aabb>& boxes) {
  std::vector<std::uint32_t> order(model.size());
  std::iota(order.begin(), order.end(), 0U);
  const auto key = [&](std::uint32_t i) {
    return std::pair(model.group_of(id<PrimitiveId>(i)), model.model().links()[i]);
  };
  std::stable_sort(order.begin(), order.end(), [&](std::uint32_t i, std::uint32_t j) { return key(i) < key(j); });
  // A float, its neighbour's distance outward, and what subtracting and scaling in double lose.
  const auto above = [](double x) { return float_above(x + std::abs(x) * 0x1p-50); };
  std::vector<BuildItem> items;
  std::vector<float> reach;
  // A reach above 0 stays so: without it no gap would be below 0.
  const auto scaled_reach = [&](PrimitiveId i) {
    constexpr double smallest = std::numeric_limits<float>::denorm_min();
    const double length = matrix.reach(i);
    return length > 0.0 ? std::max(length * scale, smallest) : 0.0;
  };
  TreeBuilder builder;
  for (std::size_t first = 0; first < order.size();) {
    std::size_t last = first;
    items.clear();
    TreePart part;
    part.group = static_cast<std::uint32_t>(index(key(order[first]).first));
    part.link = key(order[first]).second;
    const Vec3& o = origin[part.group];
    Aabb whole;
    for (; last < order.size() && key(order[last]) == key(order[first]); ++last) {
      const std::uint32_t i = order[last];
      const double r = scaled_reach(id<PrimitiveId>(i));
      BuildItem item{{}, {}, i};
      for (int k = 0; k < 3; ++k) {
        const auto axis = static_cast<std::size_t>(k);
        const double low = (boxes[i].lower[k] - o[k]) * scale, high = (boxes[i].upper[k] - o[k]) * scale;
        part.extent = std::max({part.extent, above(-low), above(high)});
        item.lower[axis] = -above(r - low);
        item.upper[axis] = above(high + r);
      }
      part.reach = std::max(part.reach, above(r));
      largest_threshold = std::max(largest_threshold, 2 * matrix.reach(id<PrimitiveId>(i)));
      whole.extend(r > 0.0 ? boxes[i].inflated(matrix.reach(id<PrimitiveId>(i))) : boxes[i]);
      items.push_back(item);
    }
    set_row(parts.size(), whole, items, o);
    const std::size_t leaf = store.real.size();
    const TreeBuilder::Tree tree = builder.build(items, store);
    part.root = tree.root;
    part.top = store.child(tree.root);
    part.root_box = store.box(tree.root);
    part.root_size = store.size(tree.root);
    depth = std::max(depth, tree.depth + 1);
    for (int k = 0; k < 3; ++k) {
      const auto axis = static_cast<std::size_t>(k);
      part.box.middle[axis] = whole.middle(k);
      part.box.half[axis] =
          above(std::max(whole.upper[k] - whole.middle(k), whole.middle(k) - whole.lower[k]) * scale * (1 + 0x1p-50));
    }
    leaves.resize(store.real.size() * Leaf<P>::floats);
    for (std::size_t slot = leaf * simd::width; slot < store.slots.size(); ++slot) {
      const std::uint32_t i = store.slots[slot];
      Leaf<P>::set(leaves.data() + slot / simd::width * Leaf<P>::floats, slot % simd::width, model.primitives()[i], o,
                   scale);
      reach.push_back(above(scaled_reach(id<PrimitiveId>(i))));
    }
    parts.push_back(part);
    first = last;
  }
  if (std::any_of(reach.begin(), reach.end(), [](float r) { return r > 0.0F; }))
    reaches.assign(reach.begin(), reach.end());
}

}  // namespace hinge
