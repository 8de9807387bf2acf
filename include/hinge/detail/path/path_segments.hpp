// SPDX-License-Identifier: BSD-3-Clause
// PathSegments: the stretches of a path that are still to be proved, first in, first out.
#pragma once

#include <algorithm>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "hinge/core/id.hpp"
#include "hinge/detail/bounds/round.hpp"

namespace hinge::detail {

struct PathPair {
  PrimitiveId first{}, second{};
  bool stands_for_links = false;  ///< for every pair of their two links
};

/// Parameters of the path. Either nothing is known of the segment, or all but some pairs are proved apart in it.
struct PathSegment {
  double low = 0.0, high = 1.0;
  bool knows_pairs = false;
  std::size_t first_pair = 0, end_pair = 0;

  double length() const noexcept { return high - low; }
  double middle() const noexcept { return low + (high - low) / 2; }
  /// Rounded up: whatever is in the segment is no farther from its middle.
  double half() const noexcept { return next_up(std::max(middle() - low, high - middle())); }
  bool is_whole() const noexcept { return low == 0.0 && high == 1.0; }
};

class PathSegments {
 public:
  /// Only the whole path is left.
  void start() {
    segments_.assign(1, PathSegment{});
    pairs_.clear();
  }

  std::size_t size() const noexcept { return segments_.size(); }
  PathSegment operator[](std::size_t k) const noexcept { return segments_[k]; }
  /// Copies the pairs that are left of a segment that knows them.
  void get_pairs(const PathSegment& segment, std::vector<PathPair>& to) const {
    const auto at = [&](std::size_t k) { return pairs_.begin() + static_cast<std::ptrdiff_t>(k); };
    to.assign(at(segment.first_pair), at(segment.end_pair));
  }

  void push_halves(const PathSegment& segment) {
    segments_.push_back({segment.low, segment.middle()});
    segments_.push_back({segment.middle(), segment.high});
  }

  /// The whole path in `count` equal pieces; those in the middle of what is not looked at first.
  void push_pieces(std::uint64_t count) {
    const auto push = [&](std::uint64_t k) {
      const auto end = [&](std::uint64_t n) { return static_cast<double>(n) / static_cast<double>(count); };
      segments_.push_back({end(k), end(k + 1)});
    };
    for (std::uint64_t stride = std::bit_ceil(count); stride > 1; stride /= 2)
      for (std::uint64_t k = stride / 2; k < count; k += stride) push(k);
    push(0);
  }

  /// What is left to prove of these pairs.
  void push(double low, double high, const std::vector<PathPair>& pairs) {
    if (pairs.empty()) return;
    segments_.push_back({low, high, true, pairs_.size(), pairs_.size() + pairs.size()});
    pairs_.insert(pairs_.end(), pairs.begin(), pairs.end());
  }

 private:
  std::vector<PathSegment> segments_;
  std::vector<PathPair> pairs_;
};

}  // namespace hinge::detail
