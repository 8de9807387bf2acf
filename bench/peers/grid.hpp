// SPDX-License-Identifier: BSD-3-Clause
// Grid: a SIMD cell grid, rebuilt for every configuration. Points that never move have a second grid, built once.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <type_traits>
#include <utility>
#include <vector>

#include "cells.hpp"
#include "lanes.hpp"
#include "pair_rules.hpp"
#include "peer.hpp"
#include "searching_peer.hpp"

namespace hinge::bench {

/// The search of Grid.
class GridSearch {
 public:
  explicit GridSearch(std::shared_ptr<const PeerInput> input) : rules_(std::move(input)) {
    const PeerInput& in = rules_.input();
    std::vector<std::uint32_t> fixed, moving;
    for (std::uint32_t i = 0; i < in.n; ++i) (in.group[i] == 0 ? fixed : moving).push_back(i);
    // It is cheaper to treat few fixed points as moving ones. Pairs of one group are never admitted.
    if (fixed.size() < moving.size()) {
      moving.resize(in.n);
      for (std::uint32_t i = 0; i < in.n; ++i) moving[i] = i;
      fixed.clear();
    }
    fixed_.assign(in, std::move(fixed));
    moving_.assign(in, std::move(moving));
  }

  /// The first query sorts the points into cells for its cutoff.
  void update(std::span<const double> xyz) {
    xyz_ = xyz;
    moving_.take(xyz.data());
    if (!fixed_taken_) fixed_.take(xyz.data());
    fixed_taken_ = true;
  }

  double everything() const { return 2.0 * (moving_.extent() + fixed_.extent() + moving_.offset_from(fixed_)) + 1.0; }

  template <class Answer>
  void search(double margin, Answer& answer) {
    if (moving_.points().size == 0) return;
    set_margin(margin);
    moving_.prepare(rules_.cutoff());
    if (fixed_.points().size != 0) fixed_.prepare(rules_.cutoff());
    tasks_.clear();
    for (const std::uint32_t cell : moving_.occupied()) {
      moving_.half_shell(cell, [&](std::size_t first, std::size_t last, std::size_t begin, std::size_t end) {
        test(first, last, begin, end);
      });
      if (tasks_.size() > flush_at && flush(moving_, answer)) return;
    }
    if (flush(moving_, answer) || fixed_.points().size == 0) return;
    for (const std::uint32_t cell : moving_.occupied()) {
      near_fixed(cell);
      if (tasks_.size() > flush_at && flush(fixed_, answer)) return;
    }
    flush(fixed_, answer);
  }

 private:
  static constexpr std::size_t flush_at = 192;  // the number of tasks after which candidates are decided

  void set_margin(double margin) { rules_.set_margin(margin, moving_.extent() + fixed_.extent()); }

  template <class Answer>
  bool flush(const Cells& partners, Answer& answer) {
    const bool stop = rules_.settle(xyz_.data(), moving_.points(), partners.points(), tasks_.tasks(), answer);
    tasks_.clear();
    if constexpr (std::is_same_v<Answer, ClosestPair>)
      if (answer.found) set_margin(answer.margin);
    return stop;
  }

  /// Moving points first .. last - 1 against points begin .. end - 1. The run starts with the cell of the moving
  /// points.
  void test(std::size_t first, std::size_t last, std::size_t begin, std::size_t end) {
    const Columns& p = moving_.points();
    for (std::size_t block = begin; block < end; block += lane_count) {
      const Lanes x = Lanes::load(&p.x[block]), y = Lanes::load(&p.y[block]), z = Lanes::load(&p.z[block]);
      const Tags tags = Tags::load(&p.tag[block]);
      const std::uint32_t lanes = first_lanes(static_cast<std::ptrdiff_t>(end - block));
      const auto candidates = [&](std::size_t i) {
        const Lanes squared = squared_distance(x, y, z, p.x[i], p.y[i], p.z[i]);
        return less(squared, Lanes::lookup(rules_.row(p.type(i)), tags)) & lanes;
      };
      if (begin != first)
        tasks_.add(first, last, block, candidates);
      else
        tasks_.add(first, last, block, [&](std::size_t i) {
          return candidates(i) & ~first_lanes(static_cast<std::ptrdiff_t>(i + 1 - block));
        });
    }
  }

  /// The moving points of a cell against the fixed points around them.
  void near_fixed(std::uint32_t cell) {
    const Columns &p = moving_.points(), &q = fixed_.points();
    const std::size_t first = moving_.begin_of(cell), last = moving_.begin_of(cell + 1);
    const auto shift = moving_.shift_to(fixed_);
    fixed_.around(p, first, last, shift, rules_.cutoff(), [&](std::size_t begin, std::size_t end) {
      for (std::size_t block = begin; block < end; block += lane_count) {
        const Lanes x = Lanes::load(&q.x[block]), y = Lanes::load(&q.y[block]), z = Lanes::load(&q.z[block]);
        const Tags tags = Tags::load(&q.tag[block]);
        const std::uint32_t lanes = first_lanes(static_cast<std::ptrdiff_t>(end - block));
        tasks_.add(first, last, block, [&](std::size_t i) {
          const Lanes squared = squared_distance(x, y, z, p.x[i] + shift[0], p.y[i] + shift[1], p.z[i] + shift[2]);
          return less(squared, Lanes::lookup(rules_.row(p.type(i)), tags)) & lanes;
        });
      }
    });
  }

  PairRules rules_;
  Cells fixed_, moving_;
  bool fixed_taken_ = false;
  std::span<const double> xyz_;
  TaskList tasks_;
};

using Grid = SearchingPeer<GridSearch>;

}  // namespace hinge::bench
