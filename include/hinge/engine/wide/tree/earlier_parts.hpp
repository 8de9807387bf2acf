// SPDX-License-Identifier: BSD-3-Clause
// EarlierParts: which earlier parts each part is tested with, in memory that grows with what is left out.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "hinge/simd/lanes.hpp"

namespace hinge {

/// Sixteen parts to a row. Rows in which a part leaves nothing out are not kept.
class EarlierParts {
 public:
  /// The next part is tested with those before part `end`, but for what is left out after this.
  void add(std::size_t end) {
    end_.push_back(static_cast<std::uint32_t>(end));
    first_run_.push_back(static_cast<std::uint32_t>(runs_.size()));
  }
  /// The part added last is not tested with part q; in increasing order.
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

  /// Bits of the parts 16 row ... 16 row + 15 that part p is tested with.
  simd::Bits get(std::size_t p, std::size_t row) const noexcept {
    simd::Bits bits = before(end_[p], row);
    for (std::uint32_t r = first_run_[p]; r < first_run_[p + 1]; ++r) {
      const std::size_t k = row - runs_[r].first;  // wraps for rows before the run
      if (k < runs_[r].count) bits &= bits_[runs_[r].start + k];
    }
    return bits;
  }

  std::size_t bytes() const noexcept {
    return runs_.size() * sizeof(Run) + bits_.size() * sizeof(std::uint16_t) +
           (first_run_.size() + end_.size()) * sizeof(std::uint32_t);
  }

 private:
  /// Rows next to each other of which some leave parts out.
  struct Run {
    std::uint32_t first, count;  ///< rows
    std::uint32_t start;         ///< in bits_
  };
  /// Rows that are kept although they leave nothing out, so that a robot's link has one run: as many bytes as a run.
  static constexpr std::uint32_t longest_gap = 8;

  /// All parts before `end`.
  static simd::Bits before(std::size_t end, std::size_t row) noexcept {
    const std::size_t first = row * simd::width;
    if (end >= first + simd::width) return simd::all_bits;
    return end > first ? (simd::Bits{1} << (end - first)) - 1 : 0;
  }

  std::vector<std::uint32_t> end_;           // per part
  std::vector<std::uint32_t> first_run_{0};  // per part, and one more
  std::vector<Run> runs_;
  std::vector<std::uint16_t> bits_;
};

}  // namespace hinge
