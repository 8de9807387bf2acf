// SPDX-License-Identifier: BSD-3-Clause
// PlacedTrees: the frames and world boxes of the trees in the present state.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <utility>
#include <vector>

#include "hinge/core/id.hpp"
#include "hinge/detail/bounds/float_box.hpp"
#include "hinge/detail/engine/simd/float_transform.hpp"
#include "hinge/detail/engine/simd/tree/placed_parts.hpp"
#include "hinge/detail/engine/simd/tree/placed_row.hpp"
#include "hinge/detail/engine/simd/tree/relative_transform.hpp"
#include "hinge/detail/engine/simd/tree/tree_parts.hpp"
#include "hinge/detail/simd/lanes.hpp"
#include "hinge/model/state.hpp"

namespace hinge::detail {

/// Copies share the parts; each copy has its own state.
template <Primitive P>
class PlacedTrees {
 public:
  explicit PlacedTrees(std::shared_ptr<const TreeParts<P>> parts)
      : parts_(std::move(parts)),
        frames_(parts_->origin.size()),
        float_frames_(frames_.size()),
        frame_at_(frames_.size(), 0),
        changed_at_(frames_.size(), 0),
        links_(parts_->links),
        merged_(parts_->alike),
        world_origin_(parts_->world_origin) {}

  const TreeParts<P>& parts() const noexcept { return *parts_; }
  const std::shared_ptr<const TreeParts<P>>& shared_parts() const noexcept { return parts_; }
  const TreeFrame& frame(std::uint32_t group) const noexcept { return frames_[group]; }
  const Vec3& world_origin() const noexcept { return world_origin_; }

  /// Updates the frames.
  void refresh(State<P>& state) noexcept {
    if (update_ == state.update_number()) return;
    const bool few = state.few_moved();
    update_ = state.update_number();
    for (const TreePart& part : parts_->merged().parts) {
      const std::uint32_t group = part.group;
      if (frame_at_[group] == update_) continue;
      const auto g = id<GroupId>(group);
      // Group 0 is the world.
      const bool current = frame_at_[group] != 0 && (group == 0 || (few && state.version(g) <= frame_at_[group]));
      frame_at_[group] = update_;
      if (current) continue;
      changed_at_[group] = update_;
      place(group, state.frame(g));
    }
  }
  /// The tree parts of single links, as of the last refresh().
  PlacedParts& links() noexcept {
    links_.refresh(float_frames_, changed_at_, update_);
    return links_;
  }
  /// The same for merged tree parts.
  PlacedParts& merged() noexcept {
    if (parts_->alike.parts.empty()) return links();
    merged_.refresh(float_frames_, changed_at_, update_);
    return merged_;
  }

  /// World box of tree part p, reaches included, relative to `origin`, in this model's tree unit.
  FloatBox world_box(std::size_t p, State<P>& state, const Vec3& origin) const noexcept {
    // Relative error of rotation, sums and rounding.
    constexpr float rounding = 8 * 0x1p-24F;
    const TreePart& part = parts_->links.parts[p];
    const FloatBox box = FloatTransform(state.frame(id<GroupId>(part.group)), origin, parts_->scale)(part.box);
    const float size = box.extent();
    return sane(box.grown(size < 0x1p100F ? size * rounding : 0.0F));
  }

 private:
  void place(std::uint32_t group, const Frame& frame) noexcept {
    // Construct in place: assignment would read memory wider than the previous stores and stall.
    std::construct_at(&frames_[group], frame, parts_->origin[group]);
    float* to = float_frames_[group].data();
    for (std::size_t k = 0; k < 3; ++k) simd::Double4(frame.column.data() + 4 * k).store_rounded(to + 4 * k);
    ((simd::Double4(frames_[group].middle.data()) -
      simd::Double4::of(world_origin_[0], world_origin_[1], world_origin_[2], 0.0)) *
     simd::Double4(parts_->scale))
        .store_rounded(to + 12);
  }

  std::shared_ptr<const TreeParts<P>> parts_;
  std::vector<TreeFrame> frames_;
  std::vector<PlacedRow::FloatFrame> float_frames_;
  std::vector<std::uint64_t> frame_at_;    // per group: the update of its frame; 0: never placed
  std::vector<std::uint64_t> changed_at_;  // per group: the update that last changed its frame
  PlacedParts links_, merged_;
  Vec3 world_origin_;
  std::uint64_t update_ = 0;
};

}  // namespace hinge::detail
