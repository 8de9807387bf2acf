// SPDX-License-Identifier: BSD-3-Clause
// BruteSimd: tests every pair, sixteen at a time in float, and decides candidates in double.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <type_traits>
#include <utility>
#include <vector>

#include "lanes.hpp"
#include "pair_rules.hpp"
#include "peer.hpp"
#include "searching_peer.hpp"

namespace hinge::bench {

/// The search of BruteSimd.
class BruteSearch {
 public:
  explicit BruteSearch(std::shared_ptr<const PeerInput> input) : rules_(std::move(input)) {
    // Fixed points come first: their blocks are tested against moving points only.
    const PeerInput& in = rules_.input();
    points_.resize(in.n);
    std::size_t k = 0;
    for (const bool moving : {false, true}) {
      for (std::uint32_t i = 0; i < in.n; ++i)
        if ((in.group[i] != 0) == moving) {
          points_.tag[k] = i << 4 | in.type[i];
          points_.group[k++] = in.group[i];
        }
      if (!moving) fixed_ = k;
    }
  }

  void update(std::span<const double> xyz) {
    xyz_ = xyz;
    if (points_.size == 0) return;
    // Fixed points keep the origin that they were rounded about.
    const std::size_t from = placed_ ? fixed_ : 0;
    if (fixed_ == 0 || !placed_)
      for (std::size_t a = 0; a < 3; ++a) origin_[a] = xyz[3 * std::size_t{points_.index(points_.size / 2)} + a];
    for (std::size_t k = from; k < points_.size; ++k) {
      const double* p = &xyz[3 * std::size_t{points_.index(k)}];
      points_.x[k] = static_cast<float>(p[0] - origin_[0]);
      points_.y[k] = static_cast<float>(p[1] - origin_[1]);
      points_.z[k] = static_cast<float>(p[2] - origin_[2]);
    }
    if (!placed_) fixed_extent_ = extent(0, fixed_);
    placed_ = true;
    extent_ = std::max(fixed_extent_, extent(fixed_, points_.size));
  }

  /// No gap exceeds the diagonal of a cube of edge 2 * extent_.
  double everything() const { return 4.0 * double{extent_} + 1.0; }

  template <class Answer>
  void search(double margin, Answer& answer) {
    if (points_.size == 0) return;
    rules_.set_margin(margin, extent_);
    const Columns& p = points_;
    for (std::size_t block = fixed_ - fixed_ % lane_count; block < p.size; block += lane_count) {
      const Lanes x = Lanes::load(&p.x[block]), y = Lanes::load(&p.y[block]), z = Lanes::load(&p.z[block]);
      const Tags tags = Tags::load(&p.tag[block]);
      const auto test = [&](std::size_t i) {
        const Lanes squared = squared_distance(x, y, z, p.x[i], p.y[i], p.z[i]);
        return less(squared, Lanes::lookup(rules_.row(p.type(i)), tags));
      };
      tasks_.clear();
      tasks_.add(0, block, block, test);
      tasks_.add(block, std::min(block + lane_count, p.size), block,
                 [&](std::size_t i) { return test(i) & ~first_lanes(static_cast<std::ptrdiff_t>(i + 1 - block)); });
      if (rules_.settle(xyz_.data(), p, p, tasks_.tasks(), answer)) return;
      if constexpr (std::is_same_v<Answer, ClosestPair>)
        if (answer.found) rules_.set_margin(answer.margin, extent_);
    }
  }

 private:
  /// Largest magnitude of a coordinate of points first .. last - 1.
  float extent(std::size_t first, std::size_t last) const {
    float most = 0.0f;
    for (const auto* column : {&points_.x, &points_.y, &points_.z}) {
      Lanes lanes = Lanes::all(0.0f);
      std::size_t k = first;
      for (; k + lane_count <= last; k += lane_count) {
        const Lanes c = Lanes::load(column->data() + k);
        lanes = larger(lanes, larger(c, Lanes::all(0.0f) - c));
      }
      most = std::max(most, lanes.highest());
      for (; k < last; ++k) most = std::max(most, std::abs((*column)[k]));
    }
    return most;
  }

  PairRules rules_;
  Columns points_;
  std::size_t fixed_ = 0;
  std::span<const double> xyz_;
  bool placed_ = false;
  std::array<double, 3> origin_{};
  float fixed_extent_ = 0.0f, extent_ = 0.0f;
  TaskList tasks_;
};

using BruteSimd = SearchingPeer<BruteSearch>;

}  // namespace hinge::bench
