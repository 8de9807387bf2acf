// SPDX-License-Identifier: BSD-3-Clause
// LearnedOrder: the order in which a yes/no query tries pairs of tree parts, learned from sample states.
#pragma once

#include <algorithm>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <numeric>
#include <vector>

namespace hinge::detail {

/// Items are numbered from 0. The items with the most collisions per test come first. The sample states should be
/// similar to later queries. There is no order until add() was called.
class LearnedOrder {
 public:
  explicit LearnedOrder(std::size_t things) : things_(things) {}

  bool is_learned() const noexcept { return !tally_.empty(); }

  /// Records one test of an item: whether it collided, and how many tests it took.
  void add(std::size_t thing, bool collides, std::uint64_t tests) {
    if (tally_.empty()) tally_.resize(things_);
    Tally& tally = tally_[thing];
    tally.hits += collides ? 1.0F : 0.0F;
    tally.tests += static_cast<float>(tests);
    tally.looks += 1.0F;
    at_.clear();
  }

  /// Clears all marks. Allocates in the first call after add().
  void start() {
    if (at_.empty()) settle();
    std::fill(marks_.begin(), marks_.end(), 0U);
  }
  void mark(std::size_t thing) noexcept { marks_[rank_[thing] / 64] |= std::uint64_t{1} << rank_[thing] % 64; }
  /// Calls visit(item) -> bool for all marked items, until it returns false: first for the item where the call before
  /// ended, then in order. Marks are bits by rank: no sorting.
  template <class Visit>
  void each(const Visit& visit) {
    std::uint64_t& latest = marks_[last_ / 64];
    const std::uint64_t bit = std::uint64_t{1} << last_ % 64;
    if ((latest & bit) != 0) {
      latest &= ~bit;
      if (!visit(at_[last_])) return;
    }
    for (std::size_t w = 0; w < marks_.size(); ++w)
      for (std::uint64_t word = marks_[w]; word != 0; word &= word - 1) {
        const std::size_t rank = 64 * w + static_cast<std::size_t>(std::countr_zero(word));
        if (visit(at_[rank])) continue;
        last_ = rank;
        return;
      }
  }

 private:
  struct Tally {
    float hits = 0.0F, tests = 0.0F, looks = 0.0F;
    // A trial costs about ten tests before its first test. Every item gets half a hit in advance, so that items that
    // never collided are ordered by cost.
    float weight() const noexcept {
      constexpr float per_look = 10.0F, granted = 0.5F;
      const float seen = std::max(looks, 1.0F);
      return (hits + granted) / (seen + 1.0F) / (per_look + tests / seen);
    }
  };

  void settle() {
    std::vector<float> weight(things_);
    for (std::size_t k = 0; k < things_; ++k) weight[k] = tally_[k].weight();
    at_.resize(things_);
    std::iota(at_.begin(), at_.end(), 0U);
    std::stable_sort(at_.begin(), at_.end(), [&](std::uint32_t x, std::uint32_t y) { return weight[x] > weight[y]; });
    rank_.resize(things_);
    for (std::uint32_t r = 0; r < things_; ++r) rank_[at_[r]] = r;
    marks_.resize((things_ + 63) / 64);
  }

  std::size_t things_;
  std::size_t last_ = 0;  // rank of the item where the last each() ended
  std::vector<Tally> tally_;
  std::vector<std::uint32_t> rank_, at_;  // rank per item, item per rank; at_ is empty when the order is outdated
  std::vector<std::uint64_t> marks_;      // by rank
};

}  // namespace hinge::detail
