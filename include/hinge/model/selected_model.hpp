// SPDX-License-Identifier: BSD-3-Clause
// SelectedModel: a model seen through one DOF selection: rigid groups, and the pairs whose distance cannot change.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <map>
#include <memory>
#include <span>
#include <utility>
#include <vector>

#include "hinge/bounds/aabb.hpp"
#include "hinge/core/id.hpp"
#include "hinge/detail/model/axis_grid.hpp"
#include "hinge/kinematics/dof_selection.hpp"
#include "hinge/kinematics/joint.hpp"
#include "hinge/kinematics/rigid_groups.hpp"
#include "hinge/model/model.hpp"
#include "hinge/policy/primitive.hpp"

namespace hinge {

/// Computed once when the DOF are selected. Memory: O(primitives + groups).
template <Primitive P>
class SelectedModel {
 public:
  SelectedModel(Model<P> model, DofSelection selection);

  const Model<P>& model() const noexcept { return model_; }
  const DofSelection& selection() const noexcept { return selection_; }
  const std::shared_ptr<const RigidGroups>& groups() const noexcept { return groups_; }
  std::size_t size() const noexcept { return primitives_.size(); }

  /// In the frame of their rigid group.
  std::span<const P> primitives() const noexcept { return primitives_; }
  GroupId group_of(PrimitiveId i) const noexcept { return group_of_[index(i)]; }
  std::span<const PrimitiveId> primitives_of(GroupId group) const noexcept {
    return std::span(by_group_).subspan(group_start_[index(group)],
                                        group_start_[index(group) + 1] - group_start_[index(group)]);
  }
  /// Groups other than its own in whose frame the primitive does not move either: it lies on the axis between. Empty
  /// for primitives on the axes of more than most_listed groups; constant() knows about them as well.
  std::span<const GroupId> also_fixed_in(PrimitiveId i) const noexcept {
    return std::span(also_fixed_in_).subspan(also_start_[index(i)], also_start_[index(i) + 1] - also_start_[index(i)]);
  }

  /// Can the distance of i and j never change under this selection? So it is when both are fixed in one group's frame.
  [[gnu::always_inline]] bool constant(PrimitiveId i, PrimitiveId j) const noexcept {
    // Nearly every pair that is asked for has no group in common.
    return (fixed_in_bits_[index(i)] & fixed_in_bits_[index(j)]) != 0 && share_a_group(i, j);
  }

  /// On a line of joints every primitive is fixed in every group: lists of them would fill the memory. Longer ones are
  /// walked when asked for; proteins and robots have at most four.
  static constexpr std::size_t most_listed = 64;

 private:
  void find_axis_primitives();
  detail::AxisGrid grid_of(GroupId group, std::span<const GroupId> children) const;
  /// Takes a primitive of a group's frame to the frame of its parent, or child, if it lies on the axis between.
  bool cross_to_parent(P& primitive, GroupId group) const noexcept;
  bool cross_to_child(P& primitive, GroupId child) const noexcept;
  bool meet_on_the_way(PrimitiveId i, PrimitiveId j) const noexcept;
  bool unlisted(PrimitiveId i) const noexcept { return std::binary_search(unlisted_.begin(), unlisted_.end(), i); }
  [[gnu::noinline]] bool share_a_group(PrimitiveId i, PrimitiveId j) const noexcept {
    const GroupId gi = group_of(i), gj = group_of(j);
    if (gi == gj) return true;
    if (!unlisted_.empty() && (unlisted(i) || unlisted(j))) return meet_on_the_way(i, j);
    const auto more_i = also_fixed_in(i), more_j = also_fixed_in(j);
    for (const GroupId g : more_i)
      if (g == gj || std::find(more_j.begin(), more_j.end(), g) != more_j.end()) return true;
    return std::find(more_j.begin(), more_j.end(), gi) != more_j.end();
  }

  Model<P> model_;
  DofSelection selection_;
  std::shared_ptr<const RigidGroups> groups_;
  std::vector<P> primitives_;
  std::vector<GroupId> group_of_;
  std::vector<PrimitiveId> by_group_;
  std::vector<std::size_t> group_start_;
  std::vector<GroupId> also_fixed_in_;
  std::vector<std::size_t> also_start_;
  std::vector<PrimitiveId> unlisted_;         // sorted: those in more groups than are listed
  std::vector<std::uint64_t> fixed_in_bits_;  // per primitive: the groups it is fixed in, modulo 64
};

template <Primitive P>
SelectedModel<P>::SelectedModel(Model<P> model, DofSelection selection)
    : model_(std::move(model)),
      selection_(std::move(selection)),
      groups_(std::make_shared<const RigidGroups>(model_.tree(), selection_)) {
  const std::size_t n = model_.size();
  primitives_.reserve(n);
  group_of_.reserve(n);
  group_start_.assign(groups_->size() + 1, 0);
  for (std::size_t i = 0; i < n; ++i) {
    const LinkId link = model_.links()[i];
    const Pose& offset = groups_->link_in_group(link);
    // The identity is skipped so that coordinates keep their bits, negative zeros included.
    primitives_.push_back(offset == Pose{} ? model_.primitives()[i] : model_.primitives()[i].placed(offset));
    group_of_.push_back(groups_->group_of(link));
    ++group_start_[index(group_of_.back()) + 1];
  }
  for (std::size_t g = 0; g < groups_->size(); ++g) group_start_[g + 1] += group_start_[g];
  by_group_.resize(n);
  std::vector<std::size_t> next(group_start_.begin(), group_start_.end() - 1);
  for (std::size_t i = 0; i < n; ++i) by_group_[next[index(group_of_[i])]++] = id<PrimitiveId>(i);
  find_axis_primitives();
  const auto bit = [](GroupId g) { return std::uint64_t{1} << index(g) % 64; };
  for (std::size_t i = 0; i < n; ++i) {
    std::uint64_t bits = bit(group_of_[i]);
    for (const GroupId g : also_fixed_in(id<PrimitiveId>(i))) bits |= bit(g);
    if (unlisted(id<PrimitiveId>(i))) bits = ~std::uint64_t{0};
    fixed_in_bits_.push_back(bits);
  }
}

template <Primitive P>
bool SelectedModel<P>::cross_to_parent(P& primitive, GroupId group) const noexcept {
  if constexpr (HasAxisInvariance<P>) {
    const Joint& joint = (*groups_)[group].joint;
    if (joint.kind != JointKind::revolute || !primitive.fixed_on_axis(joint.point, joint.axis)) return false;
    primitive = primitive.placed(joint.origin);
    return true;
  }
  return false;
}

template <Primitive P>
bool SelectedModel<P>::cross_to_child(P& primitive, GroupId child) const noexcept {
  if constexpr (HasAxisInvariance<P>) {
    const Joint& joint = (*groups_)[child].joint;
    if (joint.kind != JointKind::revolute) return false;
    if (!(joint.origin == Pose{})) primitive = primitive.placed(joint.origin.inverse());
    return primitive.fixed_on_axis(joint.point, joint.axis);
  }
  return false;
}

/// Around the group's own primitives and those of its children, which may lie on the axes between.
template <Primitive P>
detail::AxisGrid SelectedModel<P>::grid_of(GroupId group, std::span<const GroupId> children) const {
  Aabb box;
  std::vector<detail::AxisGrid::Line> axes;
  for (const PrimitiveId i : primitives_of(group)) box.extend(primitives_[index(i)].bounds());
  for (const GroupId c : children) {
    const Joint& joint = (*groups_)[c].joint;
    axes.push_back({joint.origin * joint.point, product(joint.origin.rotation, joint.axis)});
    for (const PrimitiveId i : primitives_of(c)) box.extend(primitives_[index(i)].placed(joint.origin).bounds());
  }
  return {axes, box};
}

template <Primitive P>
void SelectedModel<P>::find_axis_primitives() {
  also_start_.assign(size() + 1, 0);
  if constexpr (HasAxisInvariance<P>) {
    std::vector<std::vector<GroupId>> children(groups_->size());  // that turn
    for (std::size_t g = 1; g < groups_->size(); ++g)
      if (const RigidGroup& group = (*groups_)[id<GroupId>(g)]; group.joint.kind == JointKind::revolute)
        children[index(group.parent)].push_back(id<GroupId>(g));
    std::map<GroupId, detail::AxisGrid> grids;
    for (std::size_t g = 0; g < groups_->size(); ++g)
      if (children[g].size() > most_listed) grids.emplace(id<GroupId>(g), grid_of(id<GroupId>(g), children[g]));
    struct Stop {
      GroupId group;
      P primitive;  // in that group's frame
    };
    std::vector<Stop> stops;
    for (std::size_t i = 0; i < size(); ++i) {
      // Walk from the primitive's own group across every axis it lies on.
      stops.assign(1, {group_of_[i], primitives_[i]});
      const auto unseen = [&](GroupId g) {
        return std::none_of(stops.begin(), stops.end(), [g](const Stop& other) { return other.group == g; });
      };
      for (std::size_t s = 0; s < stops.size() && stops.size() <= most_listed; ++s) {
        const Stop here = stops[s];
        const GroupId parent = (*groups_)[here.group].parent;
        if (P there = here.primitive; unseen(parent) && cross_to_parent(there, here.group))
          stops.push_back({parent, there});
        const std::vector<GroupId>& below = children[index(here.group)];
        const auto try_child = [&](std::size_t k) {
          if (P there = here.primitive;
              stops.size() <= most_listed && unseen(below[k]) && cross_to_child(there, below[k]))
            stops.push_back({below[k], there});
        };
        const auto grid = grids.find(here.group);
        if (grid == grids.end() || !grid->second.visit_near(here.primitive.bounds(), try_child))
          for (std::size_t k = 0; k < below.size() && stops.size() <= most_listed; ++k) try_child(k);
      }
      if (stops.size() > most_listed)
        unlisted_.push_back(id<PrimitiveId>(i));
      else
        for (std::size_t s = 1; s < stops.size(); ++s) also_fixed_in_.push_back(stops[s].group);
      also_start_[i + 1] = also_fixed_in_.size();
    }
  }
}

template <Primitive P>
bool SelectedModel<P>::meet_on_the_way(PrimitiveId i, PrimitiveId j) const noexcept {
  // The groups a primitive is fixed in hang together, and groups form a tree: two primitives that share a group share
  // one on the way between their own. Both go up to where their ways join; one that got there goes on to the other.
  struct Walk {
    GroupId at, reached;  // `reached` is the last group the primitive is fixed in
    P primitive;
    bool stuck = false;
    std::vector<GroupId> way{};
  };
  Walk a{group_of(i), group_of(i), primitives_[index(i)]}, b{group_of(j), group_of(j), primitives_[index(j)]};
  while (a.at != b.at) {
    Walk& later = a.at < b.at ? b : a;  // parents come first
    later.way.push_back(later.at);
    later.stuck = later.stuck || !cross_to_parent(later.primitive, later.at);
    later.at = (*groups_)[later.at].parent;
    if (!later.stuck) later.reached = later.at;
    if (a.stuck && b.stuck) return false;
  }
  Walk& walker = a.stuck ? b : a;
  const Walk& other = a.stuck ? a : b;
  for (std::size_t k = other.way.size(); walker.at != other.reached; --k) {
    walker.at = other.way[k - 1];
    if (!cross_to_child(walker.primitive, walker.at)) return false;
  }
  return true;
}

}  // namespace hinge
