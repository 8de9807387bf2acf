// SPDX-License-Identifier: BSD-3-Clause
// PathSegments: the queue of path segments still to be proved, first in, first out.
#pragma once

#include <algorithm>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "hinge/core/id.hpp"
#include "hinge/detail/bounds/round.hpp"

namespace hinge::detail {

/// A pair to be proved apart.
struct PathPair {
  PrimitiveId first{}, second{};
  bool stands_for_links = false;  ///< represents all pairs of the two links
};

/// Parameters low .. high of the path. If knows_pairs, all pairs except the listed ones are proved apart in it.
struct PathSegment {
  double low = 0.0, high = 1.0;
  bool knows_pairs = false;
  std::size_t first_pair = 0, end_pair = 0;

  double length() const noexcept { return high - low; }
  double middle() const noexcept { return low + (high - low) / 2; }
  /// Rounded up: every parameter of the segment is within this distance of the middle.
  double half() const noexcept { return next_up(std::max(middle() - low, high - middle())); }
  bool is_whole() const noexcept { return low == 0.0 && high == 1.0; }
};

class PathSegments {
 public:
  /// Resets the queue to the whole path.
  void start() {
    segments_.assign(1, PathSegment{});
    pairs_.clear();
  }

  std::size_t size() const noexcept { return segments_.size(); }
  PathSegment operator[](std::size_t k) const noexcept { return segments_[k]; }
  /// Copies the pairs of a segment that knows them.
  void get_pairs(const PathSegment& segment, std::vector<PathPair>& to) const {
    const auto at = [&](std::size_t k) { return pairs_.begin() + static_cast<std::ptrdiff_t>(k); };
    to.assign(at(segment.first_pair), at(segment.end_pair));
  }

  void push_halves(const PathSegment& segment) {
    segments_.push_back({segment.low, segment.middle()});
    segments_.push_back({segment.middle(), segment.high});
  }

  /// Splits the whole path into `count` equal segments, pushed in order of bisection.
  void push_pieces(std::uint64_t count) {
    const auto push = [&](std::uint64_t k) {
      const auto end = [&](std::uint64_t n) { return static_cast<double>(n) / static_cast<double>(count); };
      segments_.push_back({end(k), end(k + 1)});
    };
    for (std::uint64_t stride = std::bit_ceil(count); stride > 1; stride /= 2)
      for (std::uint64_t k = stride / 2; k < count; k += stride) push(k);
    push(0);
  }

  /// Pushes a segment in which only these pairs are unproved.
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
