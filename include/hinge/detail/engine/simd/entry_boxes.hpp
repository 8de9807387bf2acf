// SPDX-License-Identifier: BSD-3-Clause
// EntryBoxes: the boxes of all entries in rows of sixteen, levels of boxes above them, and the sweep through all
// levels.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "hinge/detail/bounds/float_box.hpp"
#include "hinge/detail/simd/gather_bits.hpp"
#include "hinge/query/query_options.hpp"

namespace hinge::detail {

/// A mask of the entries that a sweep of EntryBoxes may return.
class ShownEntries {
 public:
  explicit ShownEntries(std::size_t entries) : entries_(entries) {
    do {
      entries = (entries + simd::width - 1) / simd::width;
      lanes_.emplace_back(entries);
    } while (entries > simd::width);
    show_all();
  }
  void show_all() noexcept {
    std::size_t entries = entries_;
    for (std::vector<simd::Bits>& level : lanes_) {
      std::fill(level.begin(), level.end(), simd::all_bits);
      if (entries % simd::width != 0) level.back() = (simd::Bits{1} << entries % simd::width) - 1;
      entries = level.size();
    }
  }
  void hide(std::size_t begin, std::size_t end) noexcept {
    for (std::vector<simd::Bits>& level : lanes_) {
      if (begin == end) return;
      const std::size_t first = begin / simd::width, last = (end - 1) / simd::width;
      for (std::size_t row = first; row <= last; ++row) {
        const std::size_t from = row == first ? begin % simd::width : 0;
        const std::size_t to = row == last ? (end - 1) % simd::width + 1 : simd::width;
        level[row] &= ~(((simd::Bits{1} << (to - from)) - 1) << from);
      }
      // Continue with the rows that became empty: all rows between, and possibly the first and last row.
      begin = level[first] == 0 ? first : first + 1;
      end = level[last] == 0 ? last + 1 : last;
      if (begin > end) return;
    }
  }
  /// Mask of a row: at level 0 the shown entries, above it the rows with a shown entry.
  simd::Bits lanes(std::size_t level, std::size_t row) const noexcept { return lanes_[level][row]; }

 private:
  std::size_t entries_;
  std::vector<std::vector<simd::Bits>> lanes_;  // per level; level 0 is that of the entries
};

/// Entries are updated in order, and a sweep tests the entries before a given one. More than sixteen rows have a level
/// of boxes above them, recursively. An upper box is used only after all entries below it are closed.
class EntryBoxes {
 public:
  explicit EntryBoxes(std::size_t entries) : entries_(entries), found_(entries + simd::width) {
    std::size_t rows = entries;
    do {
      rows = (rows + simd::width - 1) / simd::width;
      levels_.emplace_back(rows);
    } while (rows > simd::width);
    rows_.resize(levels_.front().size() + simd::width);
    next_rows_.resize(rows_.size());
  }

  std::size_t rows() const noexcept { return levels_.front().size(); }
  BoxRow& row(std::size_t r) noexcept { return levels_.front()[r]; }
  FloatBox get(std::size_t u) const noexcept { return levels_.front()[u / simd::width].get(u % simd::width); }
  void set(std::size_t u, const FloatBox& box) noexcept { levels_.front()[u / simd::width].set(u % simd::width, box); }

  /// Marks the entries up to u as up to date. Call it in increasing order.
  void close(std::size_t u) noexcept {
    std::size_t lane = u;
    for (std::size_t l = 0; l + 1 < levels_.size(); ++l) {
      if (lane % simd::width != simd::width - 1 && u + 1 != entries_) return;
      const std::size_t row = lane / simd::width;
      levels_[l + 1][row / simd::width].set(row % simd::width, levels_[l][row].hull());
      lane = row;
    }
  }

  /// Updates the boxes above the row of entry u. Call it once per row whose entries were set out of order.
  void cover(std::size_t u) noexcept {
    for (std::size_t l = 0; l + 1 < levels_.size(); ++l) {
      u /= simd::width;
      levels_[l + 1][u / simd::width].set(u % simd::width, levels_[l][u].hull());
    }
  }

  /// Returns the entries before `end` whose boxes overlap `box`, in order. Valid until the next sweep.
  std::span<const std::uint32_t> sweep(const FloatBox& box, std::size_t end, QueryCounts& counts) noexcept {
    const BoxLanes probe(box);
    const std::size_t top = levels_.size() - 1;
    // Rows of the top level that lie wholly before the end: sixteen at most.
    std::span<const std::uint32_t> rows(first_rows.data(), end >> (shift * (top + 1)));
    for (std::size_t l = top; l > 0; --l) {
      rows = through(l, end, probe, rows, next_rows_.data(), counts);
      rows_.swap(next_rows_);
    }
    return through(0, end, probe, rows, found_.data(), counts);
  }
  /// The same for shown entries. The boxes above all rows must be up to date (see cover()).
  std::span<const std::uint32_t> sweep(const FloatBox& box, const ShownEntries& shown, QueryCounts& counts) noexcept {
    const BoxLanes probe(box);
    std::span<const std::uint32_t> rows(first_rows.data(), levels_.back().size());
    for (std::size_t l = levels_.size(); l-- > 0;) {
      std::vector<std::uint32_t>& to = l == 0 ? found_ : next_rows_;
      std::size_t n = 0;
      for (const std::uint32_t r : rows)
        n += simd::append_lanes(overlapping(levels_[l][r], probe) & shown.lanes(l, r),
                                r * static_cast<std::uint32_t>(simd::width), to.data() + n);
      counts.boxes_tested += rows.size();
      rows = {to.data(), n};
      if (l > 0) rows_.swap(next_rows_);
    }
    return rows;
  }

 private:
  static constexpr std::size_t shift = 4;
  static constexpr std::array<std::uint32_t, simd::width> first_rows = {0, 1, 2,  3,  4,  5,  6,  7,
                                                                        8, 9, 10, 11, 12, 13, 14, 15};
  static_assert(std::size_t{1} << shift == simd::width);

  /// Tests the given complete rows of a level, and the row that contains the end. Returns the overlapping lanes.
  [[gnu::always_inline]] std::span<const std::uint32_t> through(std::size_t l, std::size_t end, const BoxLanes& probe,
                                                                std::span<const std::uint32_t> rows, std::uint32_t* to,
                                                                QueryCounts& counts) const noexcept {
    const std::vector<BoxRow>& level = levels_[l];
    std::size_t n = 0;
    for (const std::uint32_t r : rows)
      n += simd::append_lanes(overlapping(level[r], probe), r * static_cast<std::uint32_t>(simd::width), to + n);
    const std::size_t lanes = end >> (shift * l), rest = lanes % simd::width;
    counts.boxes_tested += rows.size() + (rest != 0);
    if (rest != 0)
      n += simd::append_lanes(overlapping(level[lanes / simd::width], probe) & ((simd::Bits{1} << rest) - 1),
                              static_cast<std::uint32_t>(lanes - rest), to + n);
    return {to, n};
  }

  std::size_t entries_;
  std::vector<std::vector<BoxRow>> levels_;  // per level; level 0 is that of the entries
  std::vector<std::uint32_t> found_, rows_, next_rows_;
};

}  // namespace hinge::detail
