// SPDX-License-Identifier: BSD-3-Clause
// AdmittedPairs: the earlier tree parts that each tree part is tested with; memory grows with the exclusions only.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "hinge/detail/simd/lanes.hpp"

namespace hinge::detail {

/// Bit masks with sixteen parts per row. Rows without exclusions are mostly not stored.
class AdmittedPairs {
 public:
  /// Adds the next part. It is tested with all parts before `end`, except those given to leave_out() next.
  void add(std::size_t end) {
    end_.push_back(static_cast<std::uint32_t>(end));
    first_run_.push_back(static_cast<std::uint32_t>(runs_.size()));
  }
  /// Excludes part q for the part added last. Call it with increasing q.
  void leave_out(std::size_t q) {
    const auto row = static_cast<std::uint32_t>(q / simd::width);
    const bool none = first_run_[end_.size() - 1] == runs_.size();
    if (none || row >= runs_.back().first + runs_.back().count + longest_gap)
      runs_.push_back({row, 0, static_cast<std::uint32_t>(bits_.size())});
    Run& run = runs_.back();
    for (; run.first + run.count <= row; ++run.count) bits_.push_back(simd::all_bits);
    bits_.back() = static_cast<std::uint16_t>(bits_.back() & ~(1U << q % simd::width));
    first_run_.back() = static_cast<std::uint32_t>(runs_.size());
  }

  /// The mask of one part.
  class Row;
  Row of(std::size_t p) const noexcept;
  /// Mask of the parts 16 row .. 16 row + 15 that part p is tested with.
  simd::Bits get(std::size_t p, std::size_t row) const noexcept;

  std::size_t bytes() const noexcept {
    return runs_.size() * sizeof(Run) + bits_.size() * sizeof(std::uint16_t) +
           (first_run_.size() + end_.size()) * sizeof(std::uint32_t);
  }

 private:
  /// Consecutive stored rows.
  struct Run {
    std::uint32_t first, count;  ///< rows
    std::uint32_t start;         ///< in bits_
  };
  /// Up to this many rows without exclusions are stored to keep one run: they need as much memory as another run.
  static constexpr std::uint32_t longest_gap = 8;

  std::vector<std::uint32_t> end_;           // per part
  std::vector<std::uint32_t> first_run_{0};  // per part, and one past the last
  std::vector<Run> runs_;
  std::vector<std::uint16_t> bits_;
};

class AdmittedPairs::Row {
 public:
  Row(const AdmittedPairs& all, std::size_t p) noexcept
      : end_(all.end_[p]),
        first_(all.runs_.data() + all.first_run_[p]),
        last_(all.runs_.data() + all.first_run_[p + 1]),
        bits_(all.bits_.data()) {}

  /// Mask of the parts 16 row .. 16 row + 15.
  [[gnu::always_inline]] simd::Bits get(std::size_t row) const noexcept {
    simd::Bits bits = before(row);
    for (const Run* run = first_; run != last_; ++run) {
      const std::size_t k = row - run->first;  // wraps to a large number for rows before the run
      if (k < run->count) bits &= bits_[run->start + k];
    }
    return bits;
  }

 private:
  /// Mask of the parts before the end.
  simd::Bits before(std::size_t row) const noexcept {
    const std::size_t first = row * simd::width;
    if (end_ >= first + simd::width) return simd::all_bits;
    return end_ > first ? (simd::Bits{1} << (end_ - first)) - 1 : 0;
  }

  std::size_t end_;
  const Run *first_, *last_;
  const std::uint16_t* bits_;
};

inline AdmittedPairs::Row AdmittedPairs::of(std::size_t p) const noexcept { return {*this, p}; }
inline simd::Bits AdmittedPairs::get(std::size_t p, std::size_t row) const noexcept { return of(p).get(row); }

}  // namespace hinge::detail
