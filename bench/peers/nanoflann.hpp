// SPDX-License-Identifier: BSD-3-Clause
// Nanoflann: a k-d tree of the moving points, rebuilt for every configuration, and one of the fixed points, built
// once; a radius search from every moving point.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <memory>
#include <nanoflann.hpp>
#include <span>
#include <utility>
#include <vector>

#include "pair_rules.hpp"
#include "peer.hpp"

namespace hinge::bench {

class Nanoflann {
 public:
  explicit Nanoflann(std::shared_ptr<const PeerInput> input)
      : input_(std::move(input)), reach_(input_->type_count, 0.0) {
    for (std::uint32_t i = 0; i < input_->n; ++i) (input_->group[i] == 0 ? fixed_ : moving_).members.push_back(i);
    for (std::size_t t = 0; t < reach_.size(); ++t)
      for (std::size_t u = 0; u < reach_.size(); ++u)
        reach_[t] = std::max(reach_[t], input_->table[t * reach_.size() + u]);
  }

  void update(std::span<const double> xyz) {
    xyz_ = xyz;
    moving_.build(xyz.data());
    if (fixed_.xyz.empty() && !fixed_.members.empty()) fixed_.build(xyz.data());
  }

  bool any() {
    AnyPair answer;
    search(answer);
    return answer.found;
  }
  std::size_t count() {
    PairCount answer;
    search(answer);
    return answer.count;
  }
  void within(double margin, PairList& out) {
    out.clear();
    PairsWithin answer{out, margin};
    search(answer);
    detail::sort_hits(out);
  }
  /// The radius shrinks with the best pair. If no pair is below the first guess, searches without a limit.
  double closest() {
    for (const double margin : {first_guess(last_), std::numeric_limits<double>::infinity()}) {
      ClosestPair answer{margin};
      search(answer);
      last_ = answer.margin;
      if (answer.found) break;
    }
    return last_;
  }

 private:
  /// nanoflann's view of points: copied coordinates in the order of `members`.
  struct Cloud {
    std::vector<std::uint32_t> members;
    std::vector<double> xyz;
    std::size_t kdtree_get_point_count() const { return members.size(); }
    double kdtree_get_pt(std::size_t k, std::size_t axis) const { return xyz[3 * k + axis]; }
    template <class Box>
    bool kdtree_get_bbox(Box&) const {
      return false;
    }
  };
  using Tree =
      nanoflann::KDTreeSingleIndexAdaptor<nanoflann::L2_Simple_Adaptor<double, Cloud>, Cloud, 3, std::uint32_t>;
  struct Index : Cloud {
    std::unique_ptr<Tree> tree;
    void build(const double* all) {
      xyz.resize(3 * members.size());
      for (std::size_t k = 0; k < members.size(); ++k)
        for (std::size_t a = 0; a < 3; ++a) xyz[3 * k + a] = all[3 * std::size_t{members[k]} + a];
      constexpr std::size_t points_per_leaf = 32;  // fastest of 6 to 64 at 1200 points, for build plus search
      if (!tree)
        tree = std::make_unique<Tree>(
            3, *this,
            nanoflann::KDTreeSingleIndexAdaptorParams(points_per_leaf,
                                                      nanoflann::KDTreeSingleIndexAdaptorFlags::SkipInitialBuildIndex));
      tree->buildIndex();
    }
  };

  /// nanoflann's "result set": accepts points whose squared distance is below worstDist().
  template <class Answer>
  struct Visitor {
    const PeerInput& input;
    const std::vector<std::uint32_t>& members;
    double reach;
    Answer& answer;
    std::uint32_t self;
    std::uint32_t after;  // a pair of moving points is tested from one side only
    bool stopped = false;

    /// Squared radius, with room for the rounding of nanoflann's bounds and of gaps.
    double worstDist() const {
      const double radius = std::max(reach + answer.margin + 1e-9, 0.0);
      return radius * radius * (1.0 + 1e-9);
    }
    bool full() const { return true; }
    bool addPoint(double squared, std::uint32_t k) {
      if (k < after) return true;
      const std::uint32_t j = members[k];
      const double threshold = input.threshold(self, j);
      if (!worth_looking_up(squared, threshold, answer.margin) || !input.admits(self, j)) return true;
      stopped = answer.add(self, j, squared, threshold);
      return !stopped;
    }
  };

  template <class Answer>
  void search(Answer& answer) {
    for (const Index* partners : {&moving_, &fixed_}) {
      if (partners->members.empty()) continue;
      for (std::uint32_t k = 0; k < moving_.members.size(); ++k) {
        const std::uint32_t i = moving_.members[k];
        Visitor<Answer> visitor{
            *input_, partners->members, reach_[input_->type[i]], answer, i, partners == &moving_ ? k + 1 : 0};
        partners->tree->findNeighbors(visitor, xyz_.data() + 3 * std::size_t{i}, nanoflann::SearchParams());
        if (visitor.stopped) return;
      }
    }
  }

  std::shared_ptr<const PeerInput> input_;
  std::vector<double> reach_;  // largest threshold M of a type
  Index moving_, fixed_;
  std::span<const double> xyz_;
  double last_ = 0.0;
};

}  // namespace hinge::bench
