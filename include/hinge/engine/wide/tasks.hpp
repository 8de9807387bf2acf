// SPDX-License-Identifier: BSD-3-Clause
// Tasks: "one primitive against sixteen", listed first and run in one straight loop.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "hinge/engine/wide/near_masks.hpp"
#include "hinge/simd/gather_bits.hpp"
#include "hinge/simd/lanes.hpp"

namespace hinge {

/// Three arrays: the slot of the one, the block of the sixteen, and where NearMasks says which of them count.
class Tasks {
 public:
  void clear() noexcept { size_ = 0; }
  std::size_t size() const noexcept { return size_; }
  const std::uint32_t* slots() const noexcept { return slot_.data(); }
  const std::uint32_t* blocks() const noexcept { return block_.data(); }
  const std::uint32_t* masks() const noexcept { return mask_.data(); }

  /// The lanes of a block that starts at first_slot, each against `block` under one mask.
  void add(simd::Bits lanes, std::uint32_t first_slot, std::uint32_t block, std::uint32_t mask) {
    make_room();
    std::fill_n(mask_.data() + size_, simd::width, mask);
    push(lanes, first_slot, block);
  }
  /// The same with a row of masks per lane.
  void add_rows(simd::Bits lanes, std::uint32_t first_slot, std::uint32_t block, std::uint32_t first_mask) {
    make_room();
    simd::append_lanes(lanes, first_mask, mask_.data() + size_);
    push(lanes, first_slot, block);
  }

 private:
  void make_room() {
    // Lists are written sixteen at a time, whatever counts.
    if (size_ + simd::width <= slot_.size()) return;
    const std::size_t room = 2 * size_ + 16 * simd::width;
    slot_.resize(room);
    block_.resize(room);
    mask_.resize(room);
  }
  void push(simd::Bits lanes, std::uint32_t first_slot, std::uint32_t block) noexcept {
    std::fill_n(block_.data() + size_, simd::width, block);
    size_ += simd::append_lanes(lanes, first_slot, slot_.data() + size_);
  }

  std::size_t size_ = 0;
  std::vector<std::uint32_t> slot_, block_, mask_;
};

}  // namespace hinge
