// SPDX-License-Identifier: BSD-3-Clause
// Code shared by the SIMD peers: coordinates in columns, squared float thresholds with an error band, exclusion tests
// for candidates only, decisions in double, and three kinds of answer.
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <memory>
#include <span>
#include <utility>
#include <vector>

#include "lanes.hpp"
#include "peer.hpp"

namespace hinge::bench {

/// dx * dx + dy * dy + dz * dz, summed from left to right: the value that decides.
inline double squared_distance(const double* xyz, std::uint32_t i, std::uint32_t j) {
  const double *a = xyz + 3 * std::size_t{i}, *b = xyz + 3 * std::size_t{j};
  const double dx = a[0] - b[0], dy = a[1] - b[1], dz = a[2] - b[2];
  return dx * dx + dy * dy + dz * dz;
}

// --- Answers: add() takes an admitted pair at any distance and returns whether to stop.
// Pairs with d - M >= margin may be skipped. ---

struct AnyPair {
  static constexpr double margin = 0.0;
  bool found = false;
  bool add(std::uint32_t, std::uint32_t, double squared, double threshold) {
    return found = found || squared < threshold * threshold;
  }
};

struct PairCount {
  static constexpr double margin = 0.0;
  std::size_t count = 0;
  bool add(std::uint32_t, std::uint32_t, double squared, double threshold) {
    count += squared < threshold * threshold ? 1U : 0U;
    return false;
  }
};

/// The caller sorts the list.
struct PairsWithin {
  PairList& out;
  double margin;
  bool add(std::uint32_t i, std::uint32_t j, double squared, double threshold) {
    const double limit = threshold + margin;
    if (squared < limit * limit)
      out.push_back({PrimitiveId{std::min(i, j)}, PrimitiveId{std::max(i, j)}, std::sqrt(squared), threshold});
    return false;
  }
};

/// Accepts only gaps below `margin`, which shrinks to the smallest gap found.
struct ClosestPair {
  double margin;
  bool found = false;
  bool add(std::uint32_t, std::uint32_t, double squared, double threshold) {
    const double gap = std::sqrt(squared) - threshold;
    if (gap < margin) {
      margin = gap;
      found = true;
    }
    return false;
  }
};

/// A test that is cheaper than an exclusion look-up and comes first. 1e-9 angstrom exceeds the rounding of a gap.
inline bool worth_looking_up(double squared, double threshold, double margin) {
  const double limit = threshold + margin + 1e-9;
  return limit > 0.0 && squared < limit * limit;
}

/// Coordinates in columns, padded so that sixteen values can be read at every index.
struct Columns {
  std::vector<float> x, y, z;
  std::vector<std::uint32_t> tag;    // index << 4 | type
  std::vector<std::uint32_t> group;  // rigid group
  std::size_t size = 0;

  void resize(std::size_t n) {
    size = n;
    for (auto* column : {&x, &y, &z}) column->resize(n + lane_count, 1e15f);  // far away, but with a finite square
    for (auto* column : {&tag, &group}) column->resize(n + lane_count, 0u);
  }
  std::uint32_t index(std::size_t k) const { return tag[k] >> 4; }
  std::uint32_t type(std::size_t k) const { return tag[k] & 15u; }
};

/// The point at index `first` of one set of columns against the sixteen from index `block` on of another, with a bit
/// mask of candidates. Packed into one word, because a second store is measurable in inner loops.
struct Task {
  static constexpr std::size_t most_points = std::size_t{1} << 24;
  std::uint64_t word;  // mask << 48 | block << 24 | first

  static Task make(std::size_t first, std::size_t block, std::uint32_t mask) {
    return {std::uint64_t{mask} << 48 | std::uint64_t{block} << 24 | first};
  }
  std::size_t first() const { return word & (most_points - 1); }
  std::size_t block() const { return word >> 24 & (most_points - 1); }
  std::uint32_t mask() const { return static_cast<std::uint32_t>(word >> 48); }
};

/// A growing list of tasks.
class TaskList {
 public:
  /// Calls mask_of(i) for i = first .. last - 1 and keeps nonzero masks, without a branch.
  template <class MaskOf>
  void add(std::size_t first, std::size_t last, std::size_t block, const MaskOf& mask_of) {
    reserve(last - first);
    Task* out = tasks_.data() + count_;
    for (std::size_t i = first; i < last; ++i) {
      const std::uint32_t mask = mask_of(i);
      *out = Task::make(i, block, mask);
      out += mask != 0;
    }
    count_ = static_cast<std::size_t>(out - tasks_.data());
  }
  /// The same for the bits set in `which`; bit 0 is index `first`.
  template <class MaskOf>
  void add_lanes(std::size_t first, std::uint32_t which, std::size_t block, const MaskOf& mask_of) {
    reserve(lane_count);
    Task* out = tasks_.data() + count_;
    for (; which != 0; which &= which - 1) {
      const std::size_t i = first + static_cast<std::size_t>(std::countr_zero(which));
      const std::uint32_t mask = mask_of(i);
      *out = Task::make(i, block, mask);
      out += mask != 0;
    }
    count_ = static_cast<std::size_t>(out - tasks_.data());
  }
  std::size_t size() const { return count_; }
  std::span<const Task> tasks() const { return {tasks_.data(), count_}; }
  void clear() { count_ = 0; }

 private:
  /// Leaves room for one more element: a mask is written before it is known to be kept.
  void reserve(std::size_t more) {
    if (count_ + more >= tasks_.size()) tasks_.resize(2 * (count_ + more) + 1);
  }

  std::vector<Task> tasks_ = std::vector<Task>(1024);
  std::size_t count_ = 0;
};

/// Thresholds and exclusions of one input.
class PairRules {
 public:
  explicit PairRules(std::shared_ptr<const PeerInput> input)
      : input_(std::move(input)), window_(4 * input_->n), beyond_(input_->n) {
    for (std::uint32_t i = 0; i < input_->n; ++i) {
      forbid(i, i);
      for (const std::uint32_t j : input_->excluded[i]) forbid(i, j);
    }
    for (const double m : input_->table) highest_ = std::max(highest_, m);
  }

  const PeerInput& input() const { return *input_; }
  /// Largest threshold M, angstrom.
  double highest() const { return highest_; }
  /// No pair with a larger float distance is closer than M + margin.
  float cutoff() const { return cutoff_; }
  /// Sixteen squared thresholds of one type against all types, inflated by the error band.
  const float* row(std::uint32_t type) const { return rows_[type].data(); }

  /// Sets thresholds M + margin for float coordinates of magnitude at most `extent`. Coordinates are rounded once or
  /// twice and differences once, each by at most 2^-24 of it; the factor 8 also covers sqrt(3) and the squaring.
  void set_margin(double margin, double extent) {
    const std::size_t types = input_->type_count;
    const auto limit = [&](double m) {
      const double reach = m + margin;
      if (!(reach > 0.0)) return 0.0;
      return reach + 8.0 * unit * (extent + reach);
    };
    for (std::size_t a = 0; a < types; ++a)
      for (std::size_t b = 0; b < types; ++b) {
        const double grown = limit(input_->table[a * types + b]);
        rows_[a][b] = static_cast<float>(grown * grown * (1.0 + 4.0 * unit));
      }
    cutoff_ = static_cast<float>(limit(highest_) * (1.0 + 4.0 * unit));
  }

  /// Passes the admitted candidates to the answer. Returns true when the answer needs no more pairs.
  template <class Answer>
  bool settle(const double* xyz, const Columns& a, const Columns& b, std::span<const Task> tasks,
              Answer& answer) const {
    for (const Task& task : tasks) {
      const std::uint32_t i = a.index(task.first());
      std::uint32_t mask = allowed(i, a.group[task.first()], b, task.block(), task.mask());
      for (; mask != 0; mask &= mask - 1) {
        const std::uint32_t j = b.index(task.block() + static_cast<std::uint32_t>(std::countr_zero(mask)));
        if (beyond_[i] && excluded_beyond(i, j)) continue;
        if (answer.add(i, j, squared_distance(xyz, i, j), input_->threshold(i, j))) return true;
      }
    }
    return false;
  }

 private:
  static constexpr double unit = 0x1p-24;  // half a unit in the last place of a float near 1
  static constexpr std::uint32_t window_reach =
      64;  // exclusions with j - i in -64 .. 63 are bits, others need a search
  static constexpr std::uint32_t width = 2 * window_reach;

  void forbid(std::uint32_t i, std::uint32_t j) {
    const std::uint32_t delta = j - i + window_reach;  // a negative value wraps around to a large one
    if (delta < width)
      window_[4 * std::size_t{i} + delta / 32] |= 1u << delta % 32;
    else
      beyond_[i] = 1;
  }
  bool excluded_beyond(std::uint32_t i, std::uint32_t j) const {
    return std::binary_search(input_->excluded[i].begin(), input_->excluded[i].end(), j);
  }
  /// Keeps the bits of points that are in another group and not excluded by the window.
  std::uint32_t allowed(std::uint32_t i, std::uint32_t group, const Columns& b, std::size_t block,
                        std::uint32_t mask) const {
    const std::uint32_t* window = window_.data() + 4 * std::size_t{i};
#if defined(__AVX512F__)
    const __m512i tag = _mm512_loadu_si512(b.tag.data() + block);
    const __m512i delta = _mm512_sub_epi32(_mm512_maskz_srli_epi32(every_lane, tag, 4),
                                           _mm512_set1_epi32(static_cast<int>(i - window_reach)));
    const __mmask16 near = _mm512_cmplt_epu32_mask(delta, _mm512_set1_epi32(width));
    const __m512i words = _mm512_maskz_permutexvar_epi32(near, _mm512_maskz_srli_epi32(every_lane, delta, 5),
                                                         _mm512_maskz_loadu_epi32(0xf, window));
    const __mmask16 excluded =
        _mm512_test_epi32_mask(_mm512_maskz_rorv_epi32(every_lane, words, delta), _mm512_set1_epi32(1));
    const __mmask16 same =
        _mm512_cmpeq_epi32_mask(_mm512_loadu_si512(b.group.data() + block), _mm512_set1_epi32(static_cast<int>(group)));
    return mask & ~static_cast<std::uint32_t>(excluded | same);
#else
    std::uint32_t left = 0;
    for (; mask != 0; mask &= mask - 1) {
      const std::size_t k = block + static_cast<std::uint32_t>(std::countr_zero(mask));
      const std::uint32_t delta = b.index(k) - i + window_reach;
      const bool excluded = delta < width && (window[delta / 32] >> delta % 32 & 1u);
      if (!excluded && b.group[k] != group) left |= mask & -mask;
    }
    return left;
#endif
  }

  std::shared_ptr<const PeerInput> input_;
  std::vector<std::uint32_t> window_;  // 128 bits per point
  std::vector<char> beyond_;           // whether it has exclusions outside the window
  double highest_ = 0.0;
  float cutoff_ = 0.0f;
  alignas(64) std::array<std::array<float, lane_count>, lane_count> rows_{};
};

/// First margin of closest(): slightly above the last answer, so that thresholds are tight and a second search is
/// rare.
inline double first_guess(double last) { return std::max(last, 0.0) + 0.1; }

/// Calls search(margin) with growing margins until it finds a pair or the margin reaches `everything`, which no gap
/// exceeds. Returns the smallest gap, or infinity without a pair.
template <class Search>
double grow_until_found(double last, double everything, const Search& search) {
  for (double margin = first_guess(last);; margin = 2.0 * margin + 1.0) {
    const ClosestPair found = search(std::min(margin, everything));
    if (found.found) return found.margin;
    if (margin >= everything) return std::numeric_limits<double>::infinity();
  }
}

}  // namespace hinge::bench
