// SPDX-License-Identifier: BSD-3-Clause
// SelectedModel: a model seen through one DOF selection: rigid groups, and the pairs whose distance cannot change.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <utility>
#include <vector>

#include "hinge/core/id.hpp"
#include "hinge/kinematics/dof_selection.hpp"
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
  /// Groups other than its own in whose frame the primitive does not move either: it lies on the axis between.
  std::span<const GroupId> also_fixed_in(PrimitiveId i) const noexcept {
    return std::span(also_fixed_in_).subspan(also_start_[index(i)], also_start_[index(i) + 1] - also_start_[index(i)]);
  }

  /// Can the distance of i and j never change under this selection? So it is when both are fixed in one group's frame.
  [[gnu::always_inline]] bool constant(PrimitiveId i, PrimitiveId j) const noexcept {
    // Nearly every pair that is asked for has no group in common.
    return (fixed_in_bits_[index(i)] & fixed_in_bits_[index(j)]) != 0 && share_a_group(i, j);
  }

 private:
  void find_axis_primitives();
  [[gnu::noinline]] bool share_a_group(PrimitiveId i, PrimitiveId j) const noexcept {
    const GroupId gi = group_of(i), gj = group_of(j);
    if (gi == gj) return true;
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
    fixed_in_bits_.push_back(bits);
  }
}

template <Primitive P>
void SelectedModel<P>::find_axis_primitives() {
  also_start_.assign(size() + 1, 0);
  if constexpr (HasAxisInvariance<P>) {
    std::vector<std::vector<GroupId>> children(groups_->size());
    for (std::size_t g = 1; g < groups_->size(); ++g)
      children[index((*groups_)[id<GroupId>(g)].parent)].push_back(id<GroupId>(g));
    struct Stop {
      GroupId group;
      P primitive;  // in that group's frame
    };
    std::vector<Stop> stops;
    for (std::size_t i = 0; i < size(); ++i) {
      // Walk from the primitive's own group across every axis it lies on.
      stops.assign(1, {group_of_[i], primitives_[i]});
      for (std::size_t s = 0; s < stops.size(); ++s) {
        const Stop here = stops[s];
        const auto unseen = [&](GroupId g) {
          return std::none_of(stops.begin(), stops.end(), [g](const Stop& other) { return other.group == g; });
        };
        const RigidGroup& group = (*groups_)[here.group];
        if (group.joint.kind == JointKind::revolute && unseen(group.parent) &&
            here.primitive.fixed_on_axis(group.joint.point, group.joint.axis))
          stops.push_back({group.parent, here.primitive.placed(group.joint.origin)});
        for (const GroupId c : children[index(here.group)]) {
          const Joint& joint = (*groups_)[c].joint;
          if (joint.kind != JointKind::revolute || !unseen(c)) continue;
          const Pose back = joint.origin.inverse();
          const P there = joint.origin == Pose{} ? here.primitive : here.primitive.placed(back);
          if (there.fixed_on_axis(joint.point, joint.axis)) stops.push_back({c, there});
        }
      }
      for (std::size_t s = 1; s < stops.size(); ++s) also_fixed_in_.push_back(stops[s].group);
      also_start_[i + 1] = also_fixed_in_.size();
    }
  }
}

}  // namespace hinge
