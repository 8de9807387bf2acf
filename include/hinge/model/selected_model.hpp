// SPDX-License-Identifier: BSD-3-Clause
// SelectedModel: a model under one DOF selection, with its rigid groups and its pairs of constant distance.
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

/// Constant data, computed once per selection; memory O(primitives + groups). Safe to share between threads. Returned
/// spans and references are valid while the object lives.
template <Primitive P>
class SelectedModel {
 public:
  /// ModelError: a selection for another tree.
  SelectedModel(Model<P> model, DofSelection selection);

  /// Returns the model.
  const Model<P>& model() const noexcept { return model_; }
  /// Returns the DOF selection.
  const DofSelection& selection() const noexcept { return selection_; }
  /// Returns the rigid groups.
  const std::shared_ptr<const RigidGroups>& groups() const noexcept { return groups_; }
  /// Returns the number of primitives.
  std::size_t size() const noexcept { return primitives_.size(); }

  /// Returns the primitives in the frames of their rigid groups, size() values.
  std::span<const P> primitives() const noexcept { return primitives_; }
  /// Returns the rigid group of primitive i.
  GroupId group_of(PrimitiveId i) const noexcept { return group_of_[index(i)]; }
  /// Returns the primitives of a group in increasing order.
  std::span<const PrimitiveId> primitives_of(GroupId group) const noexcept {
    return std::span(by_group_).subspan(group_start_[index(group)],
                                        group_start_[index(group) + 1] - group_start_[index(group)]);
  }
  /// Returns further groups in whose frames primitive i does not move, because it lies on the joint axes between them
  /// and its own group. The list is empty when there are more than most_listed groups; constant() still handles this
  /// case.
  std::span<const GroupId> also_fixed_in(PrimitiveId i) const noexcept {
    return std::span(also_fixed_in_).subspan(also_start_[index(i)], also_start_[index(i) + 1] - also_start_[index(i)]);
  }

  /// Returns true when the distance of i and j cannot change under this selection: both are fixed in the frame of one
  /// group.
  [[gnu::always_inline]] bool constant(PrimitiveId i, PrimitiveId j) const noexcept {
    // Most pairs have no common group, and the bit sets show it.
    return (fixed_in_bits_[index(i)] & fixed_in_bits_[index(j)]) != 0 && share_a_group(i, j);
  }

  /// Limit on the length of a primitive's list of groups. On a chain of joints with one common axis every primitive is
  /// fixed in every group, so full lists would exhaust memory. Longer lists are replaced by a walk on demand. Proteins
  /// and robots need at most four entries.
  static constexpr std::size_t most_listed = 64;

 private:
  void find_axis_primitives();
  detail::AxisGrid grid_of(GroupId group, std::span<const GroupId> children) const;
  /// Transforms a primitive from the frame of a group to the frame of its parent (or child) when it lies on the joint
  /// axis between them; otherwise returns false.
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
  std::vector<PrimitiveId> unlisted_;         // sorted: primitives with more than most_listed groups
  std::vector<std::uint64_t> fixed_in_bits_;  // per primitive: bit (g modulo 64) for each group g that it is fixed in
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
    // Skip the identity: multiplication would change the sign of negative zeros.
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

/// Builds a grid of the children's joint axes. Its box contains the primitives of the group and of its children, since
/// both may lie on these axes.
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
    std::vector<std::vector<GroupId>> children(groups_->size());  // revolute children only
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
      // Breadth-first walk from the primitive's own group across every axis that the primitive lies on.
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
        // Returns false when the list is full.
        const auto try_child = [&](std::size_t k) {
          if (P there = here.primitive; unseen(below[k]) && cross_to_child(there, below[k]))
            stops.push_back({below[k], there});
          return stops.size() <= most_listed;
        };
        const auto grid = grids.find(here.group);
        if (grid == grids.end() || !grid->second.visit_near(here.primitive.bounds(), try_child))
          for (std::size_t k = 0; k < below.size(); ++k)
            if (!try_child(k)) break;
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
  // The groups in which a primitive is fixed form a connected subtree. Two primitives with a common group therefore
  // share one on the path between their own groups. Both walk up to the lowest common ancestor. A primitive that is
  // still fixed there continues down towards the other.
  struct Walk {
    GroupId at, reached;  // `reached`: last group on the path in which the primitive is fixed
    P primitive;
    bool stuck = false;
    std::vector<GroupId> way{};
  };
  Walk a{group_of(i), group_of(i), primitives_[index(i)]}, b{group_of(j), group_of(j), primitives_[index(j)]};
  while (a.at != b.at) {
    Walk& later = a.at < b.at ? b : a;  // parents have smaller indices
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
