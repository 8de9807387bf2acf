// SPDX-License-Identifier: BSD-3-Clause
// Cells: points in a grid with cells of about the cutoff. Columns are sorted by cell, so that neighbouring cells
// along x are one contiguous run.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <utility>
#include <vector>

#include "pair_rules.hpp"

namespace hinge::bench {

class Cells {
 public:
  /// Selects the points by their indices.
  void assign(const PeerInput& input, std::vector<std::uint32_t> members) {
    members_ = std::move(members);
    for (auto* columns : {&taken_, &points_}) columns->resize(members_.size());
    for (std::size_t k = 0; k < members_.size(); ++k) {
      taken_.tag[k] = members_[k] << 4 | input.type[members_[k]];
      taken_.group[k] = input.group[members_[k]];
    }
    cell_of_.resize(members_.size());
  }

  /// Stores new coordinates. Cells are invalid until prepare().
  void take(const double* xyz) {
    edge_ = 0.0f;
    if (members_.empty()) return;
    constexpr double far = std::numeric_limits<double>::infinity();
    std::array<double, 3> low{far, far, far}, high{-far, -far, -far};
    for (const std::uint32_t i : members_)
      for (std::size_t a = 0; a < 3; ++a) {
        const double c = xyz[3 * std::size_t{i} + a];
        low[a] = c < low[a] ? c : low[a];
        high[a] = c > high[a] ? c : high[a];
      }
    origin_ = low;
    for (std::size_t a = 0; a < 3; ++a) size_[a] = high[a] - low[a];
    for (std::size_t k = 0; k < members_.size(); ++k) {
      const double* p = xyz + 3 * std::size_t{members_[k]};
      taken_.x[k] = static_cast<float>(p[0] - low[0]);
      taken_.y[k] = static_cast<float>(p[1] - low[1]);
      taken_.z[k] = static_cast<float>(p[2] - low[2]);
    }
  }

  /// Sorts the points into cells at least `cutoff` wide, unless the present cells are wide enough.
  void prepare(float cutoff) {
    if (cutoff <= edge_ && edge_ > 0.0f) return;
    choose_edges(cutoff);
    const std::size_t rows = (ny_ + 2) * (nz_ + 2), n = members_.size();
    start_.assign(rows * nx_ + 2, 0);
    occupied_.resize(n + 1);
    std::size_t occupied = 0;
    std::uint32_t* count = start_.data() + 2;
    for (std::size_t k = 0; k < n; ++k) {
      const std::size_t cx = slot(taken_.x[k], inverse_x_), cy = slot(taken_.y[k], inverse_),
                        cz = slot(taken_.z[k], inverse_);
      const auto cell = static_cast<std::uint32_t>(((cz + 1) * (ny_ + 2) + cy + 1) * nx_ + cx);
      cell_of_[k] = cell;
      occupied_[occupied] = cell;
      occupied += count[cell]++ == 0;
    }
    occupied_.resize(occupied);
    std::uint32_t sum = 0;
    for (std::uint32_t& c : start_) c = sum += c;
    // start_[cell + 1] is the index for the next point of the cell; after the loop it is the start of the next cell.
    for (std::size_t k = 0; k < n; ++k) {
      const std::size_t to = start_[cell_of_[k] + 1]++;
      points_.x[to] = taken_.x[k];
      points_.y[to] = taken_.y[k];
      points_.z[to] = taken_.z[k];
      points_.tag[to] = taken_.tag[k];
      points_.group[to] = taken_.group[k];
    }
  }

  const Columns& points() const { return points_; }
  const std::vector<std::uint32_t>& occupied() const { return occupied_; }
  /// Index of the first point of a cell, which is the end of the previous cell.
  std::size_t begin_of(std::uint32_t cell) const { return start_[cell]; }
  /// Largest edge of the bounding box of the points; 0 without points.
  double extent() const { return members_.empty() ? 0.0 : std::max({size_[0], size_[1], size_[2]}); }
  /// The offset that converts coordinates relative to this origin into coordinates relative to the origin of `other`.
  std::array<float, 3> shift_to(const Cells& other) const {
    std::array<float, 3> shift{};
    for (std::size_t a = 0; a < 3; ++a) shift[a] = static_cast<float>(origin_[a] - other.origin_[a]);
    return shift;
  }
  double offset_from(const Cells& other) const {
    if (members_.empty() || other.members_.empty()) return 0.0;
    double sum = 0.0;
    for (std::size_t a = 0; a < 3; ++a) sum += std::abs(origin_[a] - other.origin_[a]);
    return sum;
  }

  /// Calls run(first, last, begin, end): points first .. last - 1 of the cell against points begin .. end - 1 of this
  /// and later cells. The run in the cell's own row comes first and starts with the cell itself.
  template <class Run>
  void half_shell(std::uint32_t cell, const Run& run) const {
    const std::size_t row = cell / nx_, cx = cell % nx_;
    const std::size_t left = cx == 0 ? 0 : cx - 1, right = std::min(cx + 1, nx_ - 1);
    const std::size_t first = start_[cell], last = start_[cell + 1];
    run(first, last, first, start_[row * nx_ + right + 1]);
    for (const std::size_t other : {row + 1, row + ny_ + 1, row + ny_ + 2, row + ny_ + 3}) {
      const std::size_t begin = start_[other * nx_ + left], end = start_[other * nx_ + right + 1];
      if (begin != end) run(first, last, begin, end);
    }
  }

  /// Calls run(begin, end) for points here that may be closer than `cutoff` to points first .. last - 1 of `others`.
  template <class Run>
  void around(const Columns& others, std::size_t first, std::size_t last, const std::array<float, 3>& shift,
              float cutoff, const Run& run) const {
    std::array<std::size_t, 3> low{}, high{};
    const std::array<const float*, 3> column{others.x.data(), others.y.data(), others.z.data()};
    for (std::size_t a = 0; a < 3; ++a) {
      const auto [least, most] = std::minmax_element(column[a] + first, column[a] + last);
      // 0.1 % covers the rounding of shifts and differences of lengths within the box.
      const float from = *least + shift[a] - 1.001f * cutoff, to = *most + shift[a] + 1.001f * cutoff;
      if (to < 0.0f || from > static_cast<float>(size_[a]) * 1.001f) return;
      const float inverse = a == 0 ? inverse_x_ : inverse_;
      low[a] = slot(std::max(from, 0.0f), inverse);
      high[a] = std::min(slot(std::min(to, static_cast<float>(size_[a])), inverse), (a == 0   ? nx_
                                                                                     : a == 1 ? ny_
                                                                                              : nz_) -
                                                                                        1);
    }
    for (std::size_t cz = low[2]; cz <= high[2]; ++cz)
      for (std::size_t cy = low[1]; cy <= high[1]; ++cy) {
        const std::size_t row = ((cz + 1) * (ny_ + 2) + cy + 1) * nx_;
        const std::size_t begin = start_[row + low[0]], end = start_[row + high[0] + 1];
        if (begin != end) run(begin, end);
      }
  }

 private:
  static constexpr double edge_per_cutoff = 1.5;
  static constexpr double edge_x_per_cutoff = 1.5;

  static std::size_t slot(float c, float inverse) { return static_cast<std::size_t>(static_cast<int>(c * inverse)); }

  void choose_edges(float cutoff) {
    double edge = edge_per_cutoff * cutoff, edge_x = edge_x_per_cutoff * cutoff;
    if (!(edge > 1e-3)) edge = edge_x = 1e-3;
    // Open chains leave most cells empty, so the number of cells is limited.
    const double most = 8.0 * static_cast<double>(members_.size()) + 512.0;
    const auto along = [](double size, double e) { return std::floor(size / e * (1.0 + 1e-6)) + 1.0; };
    while (along(size_[0], edge_x) * (along(size_[1], edge) + 2.0) * (along(size_[2], edge) + 2.0) > most) {
      edge *= 1.2;
      edge_x *= 1.2;
    }
    edge_ = static_cast<float>(0.98 * std::min(edge, edge_x));  // slot() rounds, with larger errors far from the origin
    inverse_ = static_cast<float>(1.0 / edge);
    inverse_x_ = static_cast<float>(1.0 / edge_x);
    nx_ = slot(static_cast<float>(size_[0]), inverse_x_) + 1;
    ny_ = slot(static_cast<float>(size_[1]), inverse_) + 1;
    nz_ = slot(static_cast<float>(size_[2]), inverse_) + 1;
  }

  std::vector<std::uint32_t> members_;
  Columns taken_, points_;  // in the order of members_; sorted by cell
  std::array<double, 3> origin_{}, size_{};
  float edge_ = 0.0f, inverse_ = 0.0f, inverse_x_ = 0.0f;
  std::size_t nx_ = 1, ny_ = 1, nz_ = 1;
  std::vector<std::uint32_t> start_, cell_of_, occupied_;
};

}  // namespace hinge::bench
