// SPDX-License-Identifier: BSD-3-Clause
// MoveCut: validates the changes of a move, and cuts the tree of rigid groups at the changed joints.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "hinge/core/error.hpp"
#include "hinge/core/finite.hpp"
#include "hinge/core/id.hpp"
#include "hinge/core/number_text.hpp"
#include "hinge/detail/moves/moving_parts.hpp"
#include "hinge/kinematics/rigid_groups.hpp"
#include "hinge/moves/dof_change.hpp"

namespace hinge::detail {

/// A changed joint: its place in MovingParts and its new value.
using JointValue = std::pair<std::uint32_t, double>;

/// Owns the scratch memory, so that a move does not allocate.
class MoveCut {
 public:
  MoveCut(const RigidGroups& groups, std::size_t dof_count) : parts_(groups), dofs_(dof_count) {
    for (std::size_t g = 1; g < groups.size(); ++g) {
      const RigidGroup& group = groups[id<GroupId>(g)];
      dofs_[group.dof].place = parts_.place(id<GroupId>(g));
      dofs_[group.dof].slides = group.joint.kind == JointKind::prismatic;
    }
  }

  bool is_slide(std::size_t dof) const noexcept { return dofs_[dof].slides; }

  /// Throws ConfigurationError if a DOF does not exist or is listed twice, if a value is not finite, or if a slide is
  /// longer than largest_length.
  void check(std::span<const DofChange> changes) {
    ++list_;
    for (const DofChange& change : changes) {
      if (change.dof >= dofs_.size())
        refuse(change, "expected a number below " + std::to_string(dofs_.size()) + ", the number of selected DOF");
      Dof& dof = dofs_[change.dof];
      if (dof.named_at == list_) refuse(change, "expected one change of this value per move, found two");
      dof.named_at = list_;
      if (!is_finite(change.value)) refuse(change, "expected a finite number");
      if (dof.slides && !is_length(change.value)) refuse(change, "expected a displacement of at most 2^1000");
    }
  }

  /// Cuts the tree at the changed joints. Each DOF drives one joint.
  void cut(std::span<const DofChange> changes) {
    values_.clear();
    joints_.clear();
    for (const DofChange& change : changes) values_.emplace_back(dofs_[change.dof].place, change.value);
    std::sort(values_.begin(), values_.end());
    for (const auto& [place, value] : values_) joints_.push_back(place);
    parts_.cut(joints_);
  }
  /// The parts of the last cut. Part k + 1 moves with joint k.
  const MovingParts& parts() const noexcept { return parts_; }
  /// The changed joints of the last cut, sorted by place.
  std::span<const JointValue> values() const noexcept { return values_; }

 private:
  [[noreturn]] static void refuse(const DofChange& change, const std::string& why) {
    std::string what = "change of configuration value ";
    what += std::to_string(change.dof);
    what += " to ";
    what += number_text(change.value);
    throw ConfigurationError(what + ": " + why);
  }

  struct Dof {
    std::uint64_t named_at = 0;  // the last list that contains it
    std::uint32_t place = 0;
    bool slides = false;
  };

  MovingParts parts_;
  std::vector<Dof> dofs_;
  std::uint64_t list_ = 0;
  std::vector<JointValue> values_;
  std::vector<std::uint32_t> joints_;  // scratch
};

}  // namespace hinge::detail
