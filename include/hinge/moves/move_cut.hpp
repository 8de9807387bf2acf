// SPDX-License-Identifier: BSD-3-Clause
// DofChange and MoveCut: the changes a move is made of, checked, and the parts they cut the tree into.
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
#include "hinge/kinematics/rigid_groups.hpp"
#include "hinge/moves/moving_parts.hpp"

namespace hinge {

struct DofChange {
  std::size_t dof = 0;  ///< position in the selected configuration
  double value = 0.0;   ///< its value after the move: rad or model length unit
};

/// A joint that changes: its place in MovingParts, and its new value.
using JointValue = std::pair<std::uint32_t, double>;

/// Holds what checking and cutting take, so that no move costs an allocation.
class MoveCut {
 public:
  MoveCut(const RigidGroups& groups, std::size_t dof_count)
      : parts_(groups), place_(dof_count, 0), slides_(dof_count, 0), named_at_(dof_count, 0) {
    for (std::size_t g = 1; g < groups.size(); ++g) {
      const RigidGroup& group = groups[id<GroupId>(g)];
      place_[group.dof] = parts_.place(id<GroupId>(g));
      if (group.joint.kind == JointKind::prismatic) slides_[group.dof] = 1;
    }
  }

  bool is_slide(std::size_t dof) const noexcept { return slides_[dof] != 0; }

  /// ConfigurationError: a DOF that does not exist or is named twice, a value that is not finite, a slide beyond
  /// largest_length.
  void check(std::span<const DofChange> changes) {
    ++list_;
    for (const DofChange& change : changes) {
      if (change.dof >= place_.size())
        refuse(change, "the selection has " + std::to_string(place_.size()) + " values, counted from 0");
      if (named_at_[change.dof] == list_) refuse(change, "it is changed twice in one move");
      named_at_[change.dof] = list_;
      if (!is_finite(change.value)) refuse(change, "expected a finite number");
      if (is_slide(change.dof) && !is_length(change.value)) refuse(change, "expected a slide of at most 2^1000");
    }
  }

  /// Each DOF drives one joint.
  void cut(std::span<const DofChange> changes) {
    values_.clear();
    joints_.clear();
    for (const DofChange& change : changes) {
      values_.emplace_back(place_[change.dof], change.value);
      joints_.push_back(place_[change.dof]);
    }
    parts_.cut(joints_);
  }
  /// As cut last.
  const MovingParts& parts() const noexcept { return parts_; }
  std::span<const JointValue> values() const noexcept { return values_; }

 private:
  [[noreturn]] static void refuse(const DofChange& change, const std::string& why) {
    std::string what = "change of configuration value ";
    what += std::to_string(change.dof);
    what += " to ";
    what += std::to_string(change.value);
    throw ConfigurationError(what + ": " + why);
  }

  MovingParts parts_;
  std::vector<std::uint32_t> place_;     // per DOF
  std::vector<std::uint8_t> slides_;     // per DOF
  std::vector<std::uint64_t> named_at_;  // per DOF: the last list that names it
  std::uint64_t list_ = 0;
  std::vector<JointValue> values_;
  std::vector<std::uint32_t> joints_;  // scratch
};

}  // namespace hinge
