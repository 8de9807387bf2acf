// SPDX-License-Identifier: BSD-3-Clause
// AxisGrid: finds the lines that may pass through a small box, without a test of every line.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numeric>
#include <span>
#include <vector>

#include "hinge/bounds/aabb.hpp"
#include "hinge/core/finite.hpp"
#include "hinge/core/vec3.hpp"

namespace hinge::detail {

/// Stores n lines in a grid of about n cubic cells; each line passes through about n^(1/3) cells.
class AxisGrid {
 public:
  struct Line {
    Vec3 point;
    Vec3 direction;  ///< unit length
  };

  /// box: contains all boxes of later visit_near calls.
  AxisGrid(std::span<const Line> lines, const Aabb& box) : box_(box) {
    double scale = 0.0;
    for (int k = 0; k < 3; ++k) {
      scale = std::max({scale, std::abs(box.lower[k]), std::abs(box.upper[k])});
      for (const Line& line : lines) scale = std::max(scale, std::abs(line.point[k]));
    }
    margin_ = scale * 0x1p-40;  // far above the rounding error of coordinates
    if (box.is_empty() || !is_length(scale)) return;
    edge_ = std::max(box.length(box.widest_axis()) / std::cbrt(static_cast<double>(lines.size())), 4 * margin_);
    if (!(edge_ > 0.0)) return;
    for (std::size_t k = 0; k < 3; ++k)
      count_[k] = 1 + static_cast<std::ptrdiff_t>(box.length(static_cast<int>(k)) / edge_);
    start_.assign(static_cast<std::size_t>(count_[0] * count_[1] * count_[2]) + 1, 0);
    for (const Line& line : lines) for_each_cell(line, [&](std::size_t cell) { ++start_[cell + 1]; });
    std::partial_sum(start_.begin(), start_.end(), start_.begin());
    lines_.resize(start_.back());
    std::vector<std::size_t> next = start_;
    for (std::size_t l = 0; l < lines.size(); ++l)
      for_each_cell(lines[l], [&](std::size_t cell) { lines_[next[cell]++] = static_cast<std::uint32_t>(l); });
  }

  /// Calls visit(line index) for every line that meets the box, and for some others, until it returns false; an index
  /// may repeat. Returns false without any call when the box is not inside the grid's box or spans too many cells: any
  /// line may then meet it.
  template <class Visit>
  bool visit_near(const Aabb& box, const Visit& visit) const {
    constexpr std::ptrdiff_t most_cells = 27;
    if (start_.empty() || !box_.contains(box)) return false;
    const std::array<Range, 3> r{cells(0, box.lower[0], box.upper[0]), cells(1, box.lower[1], box.upper[1]),
                                 cells(2, box.lower[2], box.upper[2])};
    if (r[0].size() * r[1].size() * r[2].size() > most_cells) return false;
    for (std::ptrdiff_t x = r[0].first; x <= r[0].last; ++x)
      for (std::ptrdiff_t y = r[1].first; y <= r[1].last; ++y)
        for (std::ptrdiff_t z = r[2].first; z <= r[2].last; ++z)
          for (std::size_t k = start_[cell(x, y, z)]; k < start_[cell(x, y, z) + 1]; ++k)
            if (!visit(lines_[k])) return true;
    return true;
  }

 private:
  struct Range {
    std::ptrdiff_t first, last;
    std::ptrdiff_t size() const noexcept { return std::max<std::ptrdiff_t>(last - first + 1, 0); }
  };

  std::size_t cell(std::ptrdiff_t x, std::ptrdiff_t y, std::ptrdiff_t z) const noexcept {
    return static_cast<std::size_t>((x * count_[1] + y) * count_[2] + z);
  }

  /// Returns the cells along axis k that [low, high] comes near to; an empty range when it lies outside.
  Range cells(int k, double low, double high) const noexcept {
    if (!(high >= box_.lower[k] - 2 * margin_) || !(low <= box_.upper[k] + 2 * margin_)) return {0, -1};
    const auto last = static_cast<double>(count_[static_cast<std::size_t>(k)] - 1);
    const auto place = [&](double x) {
      return static_cast<std::ptrdiff_t>(std::clamp(std::floor((x - box_.lower[k]) / edge_), 0.0, last));
    };
    return {place(low - margin_), place(high + margin_)};
  }

  /// Visits the cells that a line may pass through, slab by slab along the largest component of its direction.
  template <class Visit>
  void for_each_cell(const Line& line, const Visit& visit) const {
    int m = 0;
    for (int k = 1; k < 3; ++k)
      if (std::abs(line.direction[k]) > std::abs(line.direction[m])) m = k;
    const int u = (m + 1) % 3, v = (m + 2) % 3;
    for (std::ptrdiff_t s = 0; s < count_[static_cast<std::size_t>(m)]; ++s) {
      const double low = box_.lower[m] + static_cast<double>(s) * edge_ - 2 * margin_;
      const double high = low + edge_ + 4 * margin_;
      std::array<Range, 3> r{};
      r[static_cast<std::size_t>(m)] = {s, s};
      for (const int k : {u, v}) {
        const double slope = line.direction[k] / line.direction[m];
        const double a = line.point[k] + slope * (low - line.point[m]);
        const double b = line.point[k] + slope * (high - line.point[m]);
        r[static_cast<std::size_t>(k)] = cells(k, std::min(a, b) - margin_, std::max(a, b) + margin_);
      }
      for (std::ptrdiff_t x = r[0].first; x <= r[0].last; ++x)
        for (std::ptrdiff_t y = r[1].first; y <= r[1].last; ++y)
          for (std::ptrdiff_t z = r[2].first; z <= r[2].last; ++z) visit(cell(x, y, z));
    }
  }

  Aabb box_;
  double margin_ = 0.0, edge_ = 0.0;
  std::array<std::ptrdiff_t, 3> count_{1, 1, 1};  // number of cells per axis
  std::vector<std::size_t> start_;                // per cell: first index in lines_; empty without a grid
  std::vector<std::uint32_t> lines_;
};

}  // namespace hinge::detail
