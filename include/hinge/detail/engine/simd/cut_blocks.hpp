// SPDX-License-Identifier: BSD-3-Clause
// Cutting primitives into blocks: spatially inside a large rigid group, along the chain across small groups.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "hinge/bounds/aabb.hpp"
#include "hinge/core/id.hpp"
#include "hinge/detail/kinematics/forward_kinematics.hpp"
#include "hinge/detail/simd/lanes.hpp"
#include "hinge/kinematics/rigid_groups.hpp"
#include "hinge/model/selected_model.hpp"
#include "hinge/policy/primitive.hpp"

namespace hinge::detail {

/// The primitives of a layout by rigid group: all primitives of the model except those left out.
class Members {
 public:
  /// left_out: per primitive, nonzero to leave it out; empty: leaves out none.
  template <Primitive P>
  Members(const SelectedModel<P>& model, std::span<const std::uint8_t> left_out) {
    list_.reserve(model.size());
    for (std::size_t g = 0; g < model.groups()->size(); ++g) {
      start_.push_back(list_.size());
      for (const PrimitiveId i : model.primitives_of(id<GroupId>(g)))
        if (left_out.empty() || left_out[index(i)] == 0) list_.push_back(i);
    }
    start_.push_back(list_.size());
  }

  std::span<const PrimitiveId> of(GroupId g) const noexcept {
    return all().subspan(start_[index(g)], start_[index(g) + 1] - start_[index(g)]);
  }
  std::span<const PrimitiveId> all() const noexcept { return list_; }
  /// The box around `points`, one per primitive of the model, of the primitives in this list.
  Aabb around(const std::vector<Vec3>& points) const noexcept {
    Aabb box;
    for (const PrimitiveId i : list_) box.extend(points[index(i)]);
    return box;
  }

 private:
  std::vector<PrimitiveId> list_;
  std::vector<std::size_t> start_;  // per group
};

/// The middle of every primitive's bounds in the world frame, with all joints at their reference.
template <Primitive P>
std::vector<Vec3> middles_at_reference(const SelectedModel<P>& model) {
  ForwardKinematics reference(model.groups(), model.selection().size());
  std::vector<Vec3> middles(model.size());
  for (std::size_t g = 0; g < model.groups()->size(); ++g) {
    const Pose pose = reference.pose(id<GroupId>(g));
    for (const PrimitiveId i : model.primitives_of(id<GroupId>(g))) {
      const Aabb box = model.primitives()[index(i)].placed(pose).bounds();
      for (int k = 0; k < 3; ++k) middles[index(i)][k] = box.middle(k);
    }
  }
  return middles;
}

/// Groups in depth-first order, smaller subtrees first: side branches come before the chain continues.
inline std::vector<GroupId> chain_order(const RigidGroups& groups) {
  const std::size_t n = groups.size();
  std::vector<std::size_t> subtree(n, 1);
  std::vector<std::vector<std::size_t>> children(n);
  for (std::size_t g = n; g-- > 1;) {
    const std::size_t parent = index(groups[id<GroupId>(g)].parent);
    subtree[parent] += subtree[g];
    children[parent].push_back(g);
  }
  std::vector<GroupId> order;
  std::vector<std::size_t> stack{0};
  while (!stack.empty()) {
    const std::size_t g = stack.back();
    stack.pop_back();
    order.push_back(id<GroupId>(g));
    // Children are in reverse order; the largest subtree goes to the bottom of the stack.
    std::stable_sort(children[g].begin(), children[g].end(),
                     [&](std::size_t a, std::size_t b) { return subtree[a] > subtree[b]; });
    stack.insert(stack.end(), children[g].begin(), children[g].end());
  }
  return order;
}

/// Blocks of at most sixteen primitives, about equally full, by median cuts across the widest axis. If there are enough
/// blocks, cuts fall on multiples of 16, 256, ... blocks, so that runs of this length are compact too. O(n log n), no
/// recursion.
inline std::vector<std::vector<std::uint32_t>> cut_spatially(std::span<const PrimitiveId> primitives,
                                                             const std::vector<Vec3>& middles) {
  std::vector<std::uint32_t> items;
  items.reserve(primitives.size());
  for (const PrimitiveId i : primitives) items.push_back(static_cast<std::uint32_t>(index(i)));
  std::vector<std::vector<std::uint32_t>> blocks;
  struct Range {
    std::size_t begin, end, blocks;
  };
  std::vector<Range> stack{{0, items.size(), (items.size() + simd::width - 1) / simd::width}};
  while (!stack.empty()) {
    const Range r = stack.back();
    stack.pop_back();
    if (r.blocks == 1) {
      blocks.emplace_back(items.begin() + static_cast<std::ptrdiff_t>(r.begin),
                          items.begin() + static_cast<std::ptrdiff_t>(r.end));
      continue;
    }
    Aabb box;
    for (std::size_t k = r.begin; k < r.end; ++k) box.extend(middles[items[k]]);
    const int axis = box.widest_axis();
    std::size_t run = 1;
    while (run * simd::width < r.blocks) run *= simd::width;
    const std::size_t left = std::max<std::size_t>(1, (r.blocks / 2 + run / 2) / run) * run;
    const std::size_t cut = r.begin + (r.end - r.begin) * left / r.blocks;
    const auto at = [&](std::size_t k) { return items.begin() + static_cast<std::ptrdiff_t>(k); };
    // Break ties by index, so that coincident primitives can be cut.
    std::nth_element(at(r.begin), at(cut), at(r.end), [&](std::uint32_t a, std::uint32_t b) {
      return std::pair(middles[a][axis], a) < std::pair(middles[b][axis], b);
    });
    stack.push_back({cut, r.end, r.blocks - left});
    stack.push_back({r.begin, cut, left});
  }
  return blocks;
}

/// Fills blocks with the primitives of small groups in chain order.
class ChainFiller {
 public:
  template <class IsLarge>
  ChainFiller(const std::vector<Vec3>& middles, const Members& members, const RigidGroups& groups,
              const IsLarge& is_large)
      : middles_(middles), chain_of_(groups.size()) {
    for (std::size_t g = 1; g < groups.size(); ++g) {
      const GroupId parent = groups[id<GroupId>(g)].parent;
      chain_of_[g] = is_large(parent) ? g : chain_of_[index(parent)];
    }
    if (members.all().empty()) return;
    const Aabb all = members.around(middles);
    double volume = 1.0;
    for (int k = 0; k < 3; ++k) volume *= all.length(k);
    // 1.5 times the side of the cube that sixteen primitives fill on average.
    compact_ = 1.5 * std::cbrt(volume / static_cast<double>(members.all().size()) * static_cast<double>(simd::width));
  }

  void add(GroupId group, std::span<const PrimitiveId> primitives) {
    if (primitives.empty()) return;
    const std::size_t chain = chain_of_[index(group)];
    Aabb joined = box_;
    for (const PrimitiveId i : primitives) joined.extend(middles_[index(i)]);
    const double size = joined.length(joined.widest_axis());
    if (chain != chain_ && !(size <= compact_)) close();
    chain_ = chain;
    for (const PrimitiveId i : primitives) {
      if (open_.size() == simd::width) close();
      open_.push_back(static_cast<std::uint32_t>(index(i)));
      box_.extend(middles_[index(i)]);
    }
  }

  std::vector<std::vector<std::uint32_t>> take() {
    close();
    return std::move(blocks_);
  }

 private:
  void close() {
    if (!open_.empty()) blocks_.push_back(std::move(open_));
    open_.clear();
    box_ = Aabb{};
  }

  const std::vector<Vec3>& middles_;
  std::vector<std::size_t> chain_of_;  // per group: the topmost group reached through small groups
  double compact_ = 0.0;
  std::size_t chain_ = 0;
  Aabb box_;
  std::vector<std::uint32_t> open_;
  std::vector<std::vector<std::uint32_t>> blocks_;
};

}  // namespace hinge::detail
