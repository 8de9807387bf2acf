// SPDX-License-Identifier: BSD-3-Clause
// TreeParts: one static tree per link of each rigid group, in the group's frame, and the pairs of them that are tested.
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
#include "hinge/core/id.hpp"
#include "hinge/detail/bounds/float_box.hpp"
#include "hinge/detail/engine/simd/tree/merge_parts.hpp"
#include "hinge/detail/engine/simd/tree/part_set.hpp"
#include "hinge/detail/engine/simd/tree/static_tree.hpp"
#include "hinge/detail/kinematics/forward_kinematics.hpp"
#include "hinge/detail/primitive/triangle_leaf.hpp"
#include "hinge/model/selected_model.hpp"
#include "hinge/policy/distance_matrix.hpp"
#include "hinge/policy/pair_filter.hpp"
#include "hinge/policy/primitive.hpp"

namespace hinge::detail {

/// Computed once when the DOF are selected; shared by copies of an engine. Lengths in tree units unless stated
/// otherwise.
template <Primitive P>
struct TreeParts {
  template <PairFilter F, DistanceMatrix D>
  TreeParts(const SelectedModel<P>& model, const F& filter, const D& matrix);

  /// The tree parts for queries that need not distinguish links.
  const PartSet& merged() const noexcept { return alike.parts.empty() ? links : alike; }

  const float* leaf(std::uint32_t l) const noexcept { return leaves.data() + std::size_t{l} * TriangleLeaf::floats; }
  /// Null if all reaches are 0.
  const float* leaf_reach(std::uint32_t l) const noexcept {
    return reaches.empty() ? nullptr : reaches.data() + std::size_t{l} * simd::width;
  }

  PartSet links;  ///< one tree part per link and group
  PartSet alike;  ///< links of a group with the same partners are merged into one tree part; empty if none are merged
  /// Per group: all its links under one root, if it has 2 to 16 links; otherwise the root size is 0.
  std::vector<TreePart> whole;
  std::vector<Vec3> origin;  ///< per group: origin of its trees, in the group's frame, model unit
  double scale = 1.0;        ///< power of two that brings the largest group to a size where float products are safe
  Vec3 world_origin = Vec3::Zero();  ///< middle of the model at the reference, world frame
  TreeStore store;
  simd::AlignedVector<float> leaves;
  simd::AlignedVector<float> reaches;
  double largest_threshold = 0.0;  ///< upper bound of all thresholds, model unit
  std::size_t depth = 0;           ///< depth of the deepest tree, merged trees included

 private:
  void add_link(const TreePart& part, const Aabb& box, std::span<const BuildItem> items, const Vec3& o);
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
  // Tree parts of one group are consecutive and never tested with each other.
  const std::vector<TreePart>& parts = links.parts;
  for (std::size_t p = 0, group = 0; p < parts.size(); ++p) {
    if (parts[group].group != parts[p].group) group = p;
    links.tested.add(group);
    if constexpr (AdmitsLinks<F>)
      for (std::size_t q = 0; q < group; ++q)
        if (!filter.admits(parts[q].link, parts[p].link)) links.tested.leave_out(q);
  }
  whole.resize(model.groups()->size());
  std::vector<std::uint32_t> members;
  for (std::size_t first = 0, last = 0; first < parts.size(); first = last) {
    while (last < parts.size() && parts[last].group == parts[first].group) ++last;
    if (last - first < 2 || last - first > simd::width) continue;
    members.resize(last - first);
    std::iota(members.begin(), members.end(), static_cast<std::uint32_t>(first));
    whole[parts[first].group] = merge_parts(parts, members, store);
  }
  alike = merge_alike(links, store);
}

template <Primitive P>
void TreeParts<P>::measure(const SelectedModel<P>& model, const std::vector<Aabb>& boxes) {
  const std::size_t groups = model.groups()->size();
  ForwardKinematics reference(model.groups(), model.selection().size());
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
void TreeParts<P>::add_link(const TreePart& part, const Aabb& box, std::span<const BuildItem> items, const Vec3& o) {
  TreeBox rounded;
  double squared = 0.0;
  std::array<double, 3> middle{};
  for (std::size_t k = 0; k < 3; ++k) {
    const auto axis = static_cast<Eigen::Index>(k);
    rounded.middle[k] = static_cast<float>((box.middle(static_cast<int>(k)) - o[axis]) * scale);
    middle[k] = widened(rounded.middle[k]);
    double half = 0.0;
    for (const BuildItem& item : items)
      half = std::max(
          {half, static_cast<double>(item.upper[k]) - middle[k], middle[k] - static_cast<double>(item.lower[k])});
    rounded.half[k] = float_above(half);
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
  links.add(part, rounded, float_above(std::sqrt(squared) * (1 + 0x1p-40)));
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
  // Next float outward, after the rounding of subtraction and scaling in double.
  const auto above = [](double x) { return float_above(x + std::abs(x) * 0x1p-50); };
  std::vector<BuildItem> items;
  std::vector<float> reach;
  // A positive reach must stay positive, or no gap would be below 0.
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
    Aabb box;
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
      box.extend(r > 0.0 ? boxes[i].inflated(matrix.reach(id<PrimitiveId>(i))) : boxes[i]);
      items.push_back(item);
    }
    const std::size_t leaf = store.real.size();
    const TreeBuilder::Tree tree = builder.build(items, store);
    part.root = tree.root;
    part.top = store.child(tree.root);
    part.root_box = store.box(tree.root);
    part.root_size = store.size(tree.root);
    depth = std::max(depth, tree.depth + 1);
    for (int k = 0; k < 3; ++k) {
      const auto axis = static_cast<std::size_t>(k);
      part.box.middle[axis] = box.middle(k);
      part.box.half[axis] =
          above(std::max(box.upper[k] - box.middle(k), box.middle(k) - box.lower[k]) * scale * (1 + 0x1p-50));
    }
    leaves.resize(store.real.size() * TriangleLeaf::floats);
    for (std::size_t slot = leaf * simd::width; slot < store.slots.size(); ++slot) {
      const std::uint32_t i = store.slots[slot];
      TriangleLeaf::set(leaves.data() + slot / simd::width * TriangleLeaf::floats, slot % simd::width,
                        model.primitives()[i], o, scale);
      reach.push_back(above(scaled_reach(id<PrimitiveId>(i))));
    }
    add_link(part, box, items, o);
    first = last;
  }
  if (std::any_of(reach.begin(), reach.end(), [](float r) { return r > 0.0F; }))
    reaches.assign(reach.begin(), reach.end());
}

}  // namespace hinge::detail
