// SPDX-License-Identifier: BSD-3-Clause
// PairOrder: which pairs of parts a yes/no query tries first.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace hinge {

/// Learned from states that are like those to come: the pairs that collide most often for the work it takes to find out
/// come first. Until something is learned there is no order.
class PairOrder {
 public:
  explicit PairOrder(std::size_t parts) : parts_(parts) {}

  bool is_learned() const noexcept { return !weight_.empty(); }

  /// One look at parts p and q: did they collide, and how many tests did it take?
  void add(std::size_t p, std::size_t q, bool collides, std::uint64_t tests) {
    if (tally_.empty()) tally_.resize(parts_ * parts_);
    Tally& tally = tally_[place(p, q)];
    tally.hits += collides ? 1.0F : 0.0F;
    tally.tests += static_cast<float>(tests);
    tally.looks += 1.0F;
  }

  /// Makes the order of all that was added.
  void settle() {
    weight_.assign(tally_.size(), 0.0F);
    // A look costs about as much as ten tests before the first is made. Half a hit is granted to each pair, so that
    // what was never seen to collide is still ordered by what it costs.
    constexpr float per_look = 10.0F, granted = 0.5F;
    for (std::size_t k = 0; k < tally_.size(); ++k) {
      const float looks = std::max(tally_[k].looks, 1.0F);
      weight_[k] = (tally_[k].hits + granted) / (looks + 1.0F) / (per_look + tally_[k].tests / looks);
    }
  }

  float weight(std::size_t p, std::size_t q) const noexcept { return weight_[place(p, q)]; }

 private:
  struct Tally {
    float hits = 0.0F, tests = 0.0F, looks = 0.0F;
  };
  std::size_t place(std::size_t p, std::size_t q) const noexcept { return std::min(p, q) * parts_ + std::max(p, q); }

  std::size_t parts_;
  std::vector<Tally> tally_;
  std::vector<float> weight_;
};

}  // namespace hinge
