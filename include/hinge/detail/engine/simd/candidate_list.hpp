// SPDX-License-Identifier: BSD-3-Clause
// CandidateList: candidates "one primitive against a block of sixteen", listed first and tested in one loop.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "hinge/detail/simd/gather_bits.hpp"
#include "hinge/detail/simd/lanes.hpp"

namespace hinge::detail {

/// A candidate is a position of floats of the single primitive, a position of floats of the block, and a mask of lanes.
class CandidateList {
 public:
  /// A candidate that floats did not rule out, with the remaining lanes.
  struct Left {
    std::uint32_t candidate;
    simd::Bits lanes;
  };
  /// A candidate whose lanes were tested one by one: its two positions of floats, with the lanes that are near.
  struct Near {
    std::uint32_t one, sixteen;
    simd::Bits lanes;
  };

  void clear() noexcept { size_ = 0; }
  std::size_t size() const noexcept { return size_; }
  const std::uint32_t* ones() const noexcept { return one_.data(); }
  const std::uint32_t* sixteens() const noexcept { return sixteen_.data(); }
  const simd::Bits* masks() const noexcept { return mask_.data(); }
  /// Scratch with room for all candidates and one more.
  Left* left() noexcept { return left_.data(); }
  /// Scratch for a batch of candidates.
  std::array<Near, 64>& near() noexcept { return near_; }
  /// Stores whether many candidates remained: a prediction for the next run.
  void set_left(std::size_t count) noexcept { many_left_ = 16 * count > size_; }
  bool many_left() const noexcept { return many_left_; }

  /// Adds the `lanes` of the block at position first_one, each against the block at position `sixteen`, with one mask.
  [[gnu::always_inline]] void add(simd::Bits lanes, std::uint32_t first_one, std::uint32_t sixteen, simd::Bits mask) {
    make_room();
    std::fill_n(mask_.data() + size_, simd::width, mask);
    push(lanes, first_one, sixteen);
  }
  /// The same with one mask per lane.
  [[gnu::always_inline]] void add_rows(simd::Bits lanes, std::uint32_t first_one, std::uint32_t sixteen,
                                       const simd::Bits* masks) {
    make_room();
    simd::append_chosen(lanes, masks, mask_.data() + size_);
    push(lanes, first_one, sixteen);
  }

 private:
  [[gnu::always_inline]] void make_room() {
    // append_lanes always writes sixteen values.
    if (size_ + simd::width > one_.size()) [[unlikely]]
      grow();
  }
  [[gnu::noinline]] void grow() {
    const std::size_t room = 2 * size_ + 16 * simd::width;
    one_.resize(room);
    sixteen_.resize(room);
    mask_.resize(room);
    left_.resize(room + 1);
  }
  [[gnu::always_inline]] void push(simd::Bits lanes, std::uint32_t first_one, std::uint32_t sixteen) noexcept {
    std::fill_n(sixteen_.data() + size_, simd::width, sixteen);
    size_ += simd::append_lanes(lanes, first_one, one_.data() + size_);
  }

  std::size_t size_ = 0;
  bool many_left_ = false;
  std::vector<std::uint32_t> one_, sixteen_;
  std::vector<simd::Bits> mask_;
  std::vector<Left> left_;
  std::array<Near, 64> near_{};
};

}  // namespace hinge::detail
