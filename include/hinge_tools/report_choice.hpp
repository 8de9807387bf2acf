// SPDX-License-Identifier: BSD-3-Clause
// ReportChoice: which of many conformations a report shows.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <string>
#include <tuple>
#include <vector>

#include "hinge_tools/report_page.hpp"

namespace hinge::tool {

/// Chooses the conformations with the most colliding pairs, and counts the pairs of all for a chart. Of two with the
/// same number the earlier one is chosen.
class ReportChoice {
 public:
  /// A chosen conformation.
  struct Shown {
    std::size_t place = 0;    ///< its place among the offered ones, from 0
    std::uint64_t index = 0;  ///< its index in the run
  };

  static constexpr std::size_t usual = 50;                                     ///< conformations to choose
  static constexpr std::size_t all = std::numeric_limits<std::size_t>::max();  ///< chooses every conformation

  /// counts_pairs: false if only yes or no is known. most: number of conformations to choose.
  explicit ReportChoice(bool counts_pairs, std::size_t most = usual) : counts_pairs_(counts_pairs), most_(most) {}

  /// Takes the next conformation into account. pairs: number of colliding pairs.
  void offer(std::uint64_t index, bool collides, std::size_t pairs) {
    if (offered_ == 0) first_ = index;
    if (offered_ < most_charted) {
      collides_.push_back(collides ? 1 : 0);
      pairs_.push_back(
          static_cast<std::uint32_t>(std::min<std::size_t>(pairs, std::numeric_limits<std::uint32_t>::max())));
    }
    const Ranked next{std::max<std::size_t>(pairs, collides ? 1 : 0), offered_++, index};
    if (best_.size() == most_) {
      if (!before(next, best_.front())) return;
      std::ranges::pop_heap(best_, before);
      best_.pop_back();
    }
    best_.push_back(next);
    std::ranges::push_heap(best_, before);
  }

  /// The chosen ones, in the order of the run.
  std::vector<Shown> shown() const {
    std::vector<Shown> list;
    for (const Ranked& one : best_) list.push_back({one.place, one.index});
    std::ranges::sort(list, {}, &Shown::place);
    return list;
  }

  /// Adds the members first_number, all_frames, frames_left_out and frames_text. numbers_from: the number that people
  /// give to index 0.
  template <class Json>
  void describe(Json& data, std::uint64_t numbers_from) const {
    data["first_number"] = first_ + numbers_from;
    data["all_frames"] = Json();
    if (offered_ <= most_charted) {
      data["all_frames"] = {{"count", offered_}, {"collides", packed(collides_)}};
      data["all_frames"]["pairs"] = counts_pairs_ ? Json(packed(pairs_)) : Json();
    }
    data["frames_left_out"] = offered_ - best_.size();
    data["frames_text"] = offered_ == best_.size()
                              ? std::string()
                              : "the " + std::to_string(most_) +
                                    (counts_pairs_ ? " with the most colliding pairs" : " that collide first");
  }

 private:
  static constexpr std::size_t most_charted = 200000;  // about 1.3 MB of the file
  struct Ranked {
    std::size_t pairs = 0, place = 0;
    std::uint64_t index = 0;
  };
  /// Also the order of the heap, whose front is the one to drop first.
  static bool before(const Ranked& a, const Ranked& b) {
    return std::tuple(b.pairs, a.place) < std::tuple(a.pairs, b.place);
  }

  bool counts_pairs_;
  std::size_t most_, offered_ = 0;
  std::uint64_t first_ = 0;  // index of the first one
  std::vector<Ranked> best_;
  std::vector<std::uint8_t> collides_;
  std::vector<std::uint32_t> pairs_;
};

}  // namespace hinge::tool
