// SPDX-License-Identifier: BSD-3-Clause
// DofSelection: the degrees of freedom (DOF) that change between queries. All others keep their reference value 0.
#pragma once

#include <algorithm>
#include <cstddef>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "hinge/core/error.hpp"
#include "hinge/core/id.hpp"
#include "hinge/kinematics/kinematic_tree.hpp"

namespace hinge {

/// A sorted set of DOF of one tree. A configuration under a selection has size() values, in increasing DofId order.
class DofSelection {
 public:
  /// Selects every DOF of the tree.
  static DofSelection all(const KinematicTree& tree) {
    std::vector<DofId> free;
    for (std::size_t k = 0; k < tree.dof_count(); ++k) free.push_back(id<DofId>(k));
    return {tree, std::move(free)};
  }

  /// free: the selected DOF, in any order. ModelError: a DOF that the tree does not have, or a duplicate.
  DofSelection(const KinematicTree& tree, std::vector<DofId> free) : free_(std::move(free)) {
    std::sort(free_.begin(), free_.end());
    for (std::size_t k = 0; k < free_.size(); ++k) {
      if (index(free_[k]) >= tree.dof_count())
        throw ModelError("selected DOF " + std::to_string(index(free_[k])) + ": the tree has " +
                         std::to_string(tree.dof_count()) + " DOF");
      if (k > 0 && free_[k] == free_[k - 1])
        throw ModelError("selected DOF " + std::to_string(index(free_[k])) + " is selected twice");
    }
  }

  /// Returns the number of selected DOF.
  std::size_t size() const noexcept { return free_.size(); }
  /// Returns the selected DOF in increasing order, valid while this object lives.
  std::span<const DofId> dofs() const noexcept { return free_; }

 private:
  std::vector<DofId> free_;
};

}  // namespace hinge
