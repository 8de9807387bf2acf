// SPDX-License-Identifier: BSD-3-Clause
// MovingParts: a move of D joints cuts the tree of rigid groups into D + 1 parts, each moving as one rigid body.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "hinge/core/id.hpp"
#include "hinge/detail/engine/simd/cut_blocks.hpp"
#include "hinge/detail/simd/lanes.hpp"
#include "hinge/kinematics/rigid_groups.hpp"

namespace hinge::detail {

/// Places number the groups in depth-first order, so a subtree is a range of places. A part is the range below its
/// joint, without the ranges of changed joints below it.
class MovingParts {
 public:
  explicit MovingParts(const RigidGroups& groups)
      : group_(chain_order(groups)), place_(groups.size()), parent_(groups.size()), end_(groups.size()), parts_(1) {
    const auto count = static_cast<std::uint32_t>(groups.size());
    for (std::uint32_t p = 0; p < count; ++p) place_[index(group_[p])] = p;
    for (std::uint32_t p = 0; p < count; ++p) {
      parent_[p] = place_[index(groups[group_[p]].parent)];
      end_[p] = p + 1;
    }
    for (std::uint32_t p = count; p-- > 1;) end_[parent_[p]] = std::max(end_[parent_[p]], end_[p]);
  }

  std::uint32_t size() const noexcept { return static_cast<std::uint32_t>(group_.size()); }
  GroupId group(std::uint32_t place) const noexcept { return group_[place]; }
  std::uint32_t place(GroupId group) const noexcept { return place_[index(group)]; }
  /// The parent of the world, place 0, is the world.
  std::uint32_t parent(std::uint32_t place) const noexcept { return parent_[place]; }
  /// One past the last place of the subtree.
  std::uint32_t end(std::uint32_t place) const noexcept { return end_[place]; }

  /// The places begin .. end - 1 belong to one part.
  struct Stretch {
    std::uint32_t begin, end, part;
    /// Mask of the sixteen given places that lie in the range.
    [[gnu::always_inline]] simd::Bits lanes(const std::uint32_t* places) const noexcept {
      using Places = simd::Lanes<std::uint32_t, simd::width>;
      const Places place(places);
      return less_equal(Places(begin), place) & less(place, Places(end));
    }
  };
  /// A part moves with the joint at place `joint`. `parent` is the part above this joint. `top` is the place of the
  /// highest changed joint above or at `joint`.
  struct Part {
    std::uint32_t joint = 0, parent = 0, top = 0;
  };

  /// Cuts the tree at the places of changed joints: sorted, without place 0. Joint k moves part k + 1.
  void cut(std::span<const std::uint32_t> changed) {
    stretches_.clear();
    parts_.resize(1);
    open_.clear();
    std::uint32_t at = 0;
    const auto close = [&](std::uint32_t up_to) {
      while (!open_.empty() && end_[parts_[open_.back()].joint] <= up_to) {
        add({at, end_[parts_[open_.back()].joint], open_.back()});
        at = end_[parts_[open_.back()].joint];
        open_.pop_back();
      }
    };
    for (const std::uint32_t joint : changed) {
      close(joint);
      if (!open_.empty()) add({at, joint, open_.back()});
      at = joint;
      const std::uint32_t parent = open_.empty() ? 0 : open_.back();
      open_.push_back(static_cast<std::uint32_t>(parts_.size()));
      parts_.push_back({joint, parent, parent == 0 ? joint : parts_[parent].top});
    }
    close(size());
  }

  /// The ranges of all moving parts, in order of places.
  std::span<const Stretch> stretches() const noexcept { return stretches_; }
  /// Part 0 does not move. Every other part comes after its parent.
  std::span<const Part> parts() const noexcept { return parts_; }
  /// The part of the last cut that contains a place.
  std::uint32_t part_of(std::uint32_t place) const noexcept {
    const auto after = std::upper_bound(stretches_.begin(), stretches_.end(), place,
                                        [](std::uint32_t p, const Stretch& s) { return p < s.begin; });
    return after != stretches_.begin() && place < (after - 1)->end ? (after - 1)->part : 0;
  }
  std::uint32_t part_of(GroupId group) const noexcept { return part_of(place(group)); }

 private:
  void add(const Stretch& stretch) {
    if (stretch.begin < stretch.end) stretches_.push_back(stretch);
  }

  std::vector<GroupId> group_;        // per place
  std::vector<std::uint32_t> place_;  // per group
  std::vector<std::uint32_t> parent_, end_;
  std::vector<Part> parts_;
  std::vector<Stretch> stretches_;
  std::vector<std::uint32_t> open_;  // scratch: nested parts around a place, the innermost last
};

}  // namespace hinge::detail
