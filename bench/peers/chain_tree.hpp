// SPDX-License-Identifier: BSD-3-Clause
// ChainTree: a balanced binary hierarchy over points in chain order, refitted for every configuration and traversed
// against itself (Lotan, Schwarzer, Halperin, Latombe, "Algorithm and data structures for efficient energy
// maintenance during Monte Carlo simulation of proteins", 2004). Leaves are tested sixteen points at a time, or pair
// by pair as published.
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <type_traits>
#include <utility>
#include <vector>

#include "chain_volumes.hpp"
#include "lanes.hpp"
#include "pair_rules.hpp"
#include "peer.hpp"
#include "searching_peer.hpp"

namespace hinge::bench {

/// Sixteen points per leaf, tested in SIMD lanes. Volume: SphereVolume or BoxVolume.
template <class VolumeType>
struct LaneLeaves {
  using Volume = VolumeType;
  static constexpr bool lanes = true;
  static constexpr std::size_t points_per_leaf_log2 = 4;
};

/// Eight points per leaf (the fastest of 4, 8 and 16), tested pair by pair.
template <class VolumeType>
struct ScalarLeaves {
  using Volume = VolumeType;
  static constexpr bool lanes = false;
  static constexpr std::size_t points_per_leaf_log2 = 3;
};

/// The search of ChainTree. Leaves: LaneLeaves or ScalarLeaves.
template <class Leaves>
class ChainSearch {
 public:
  explicit ChainSearch(std::shared_ptr<const PeerInput> input) : rules_(std::move(input)) {
    const PeerInput& in = rules_.input();
    points_.resize(in.n);
    for (std::uint32_t i = 0; i < in.n; ++i) {
      points_.tag[i] = i << 4 | in.type[i];
      points_.group[i] = in.group[i];
    }
    for (std::size_t count = (in.n + leaf_size - 1) / leaf_size; count != 0; count = count == 1 ? 0 : (count + 1) / 2) {
      levels_.push_back({group_.size(), count, {}, {}, {}});
      for (std::size_t k = 0; k < count; ++k) group_.push_back(common_group(levels_.size() - 1, k));
    }
    volumes_.resize(group_.size());
    for (std::size_t level = 0; level < levels_.size(); ++level)
      for (std::uint32_t k = 0; k < levels_[level].count; ++k) {
        levels_[level].every.push_back(k);
        if (group_[node(level, k)] != 0) levels_[level].moving.push_back(k);
      }
    has_fixed_ = std::find(group_.begin(), group_.end(), 0u) != group_.end();
  }

  void update(std::span<const double> xyz) {
    xyz_ = xyz;
    if (points_.size == 0) return;
    if (!has_fixed_ || !placed_)
      for (std::size_t a = 0; a < 3; ++a) origin_[a] = xyz[3 * (points_.size / 2) + a];
    for (std::size_t level = 0; level < levels_.size(); ++level)
      for (const std::uint32_t k : placed_ ? levels_[level].moving : levels_[level].every) refit(level, k);
    placed_ = true;
    extent_ = volumes_.back().extent();
  }

  // --- Monte Carlo moves: refits only nodes above moved points and skips pairs of nodes that move together; a
  // rejected move is undone. Call update() first, and no other search afterwards. ---

  /// Announces the next move. `body`: for each point the index of its moving part, 0 if it stays fixed. Not timed,
  /// because a chain knows the parts from the indices of the changed joints.
  void prepare_move(std::span<const std::uint32_t> body) {
    part_.resize(group_.size());
    for (std::size_t level = 0; level < levels_.size(); ++level) {
      levels_[level].changed.clear();
      for (std::uint32_t k = 0; k < levels_[level].count; ++k) {
        std::uint32_t& part = part_[node(level, k)];
        if (level == 0) {
          const std::size_t begin = k * leaf_size, end = std::min(begin + leaf_size, points_.size);
          part = body[begin];
          for (std::size_t i = begin; i < end; ++i)
            if (body[i] != part) part = mixed;
        } else {
          const std::size_t left = node(level - 1, 2 * k),
                            right = 2 * k + 1 < levels_[level - 1].count ? left + 1 : left;
          part = part_[left] == part_[right] ? part_[left] : mixed;
        }
        if (part != 0) levels_[level].changed.push_back(k);
      }
    }
  }
  /// xyz: coordinates after the move, angstrom.
  bool move_collides(std::span<const double> xyz) {
    xyz_ = xyz;
    saved_.clear();
    saved_points_.clear();
    for (std::size_t level = 0; level < levels_.size(); ++level)
      for (const std::uint32_t k : levels_[level].changed) {
        saved_.push_back(volumes_[node(level, k)]);
        if (level == 0)
          for (std::size_t i = k * leaf_size; i < std::min((k + 1) * leaf_size, points_.size); ++i)
            saved_points_.push_back({points_.x[i], points_.y[i], points_.z[i]});
        refit(level, k);
      }
    if (volumes_.back().extent() > move_extent_) {
      move_extent_ = extent_ = 1.5 * volumes_.back().extent();  // 1.5 makes new thresholds rare
      rules_.set_margin(0.0, extent_);
    }
    AnyPair answer;
    tasks_.clear();
    if (!self(levels_.size() - 1, 0, answer)) flush(answer);
    return answer.found;
  }
  void take_back() {
    std::size_t v = 0, p = 0;
    for (std::size_t level = 0; level < levels_.size(); ++level)
      for (const std::uint32_t k : levels_[level].changed) {
        volumes_[node(level, k)] = saved_[v++];
        if (level == 0)
          for (std::size_t i = k * leaf_size; i < std::min((k + 1) * leaf_size, points_.size); ++i, ++p) {
            points_.x[i] = saved_points_[p][0];
            points_.y[i] = saved_points_[p][1];
            points_.z[i] = saved_points_[p][2];
          }
      }
  }

  double everything() const { return 4.0 * extent_ + 1.0; }

  template <class Answer>
  void search(double margin, Answer& answer) {
    if (points_.size == 0) return;
    rules_.set_margin(margin, extent_);
    tasks_.clear();
    if (!self(levels_.size() - 1, 0, answer)) flush(answer);
  }

 private:
  using Volume = typename Leaves::Volume;
  static constexpr std::size_t leaf_size = std::size_t{1} << Leaves::points_per_leaf_log2;
  static constexpr std::uint32_t mixed = 0xffffffffu;
  struct Level {
    std::size_t first, count;                  // index of its first node, number of its nodes; leaves are level 0
    std::vector<std::uint32_t> every, moving;  // indices of all nodes; of nodes with a moving point
    std::vector<std::uint32_t> changed{};      // indices of the nodes that the present move refits
  };
  struct Pair {
    std::uint32_t a, b;  // node indices in one level
  };

  std::size_t node(std::size_t level, std::size_t k) const { return levels_[level].first + k; }
  /// The common group of all points below a node, or `mixed`.
  std::uint32_t common_group(std::size_t level, std::size_t k) const {
    if (level != 0) {
      const std::size_t left = node(level - 1, 2 * k), right = 2 * k + 1 < levels_[level - 1].count ? left + 1 : left;
      return group_[left] == group_[right] ? group_[left] : mixed;
    }
    const std::size_t begin = k * leaf_size, end = std::min(begin + leaf_size, points_.size);
    const std::uint32_t group = points_.group[begin];
    for (std::size_t i = begin; i < end; ++i)
      if (points_.group[i] != group) return mixed;
    return group;
  }

  void refit(std::size_t level, std::size_t k) {
    const std::size_t shift = level + Leaves::points_per_leaf_log2;
    const std::size_t begin = k << shift, end = std::min((k + 1) << shift, points_.size);
    Volume& volume = volumes_[node(level, k)];
    if (level != 0) {
      const std::size_t left = node(level - 1, 2 * k), right = 2 * k + 1 < levels_[level - 1].count ? left + 1 : left;
      volume.enclose(volumes_[left], volumes_[right], points_, begin, end);
      return;
    }
    for (std::size_t i = begin; i < end; ++i) {
      points_.x[i] = static_cast<float>(xyz_[3 * i] - origin_[0]);
      points_.y[i] = static_cast<float>(xyz_[3 * i + 1] - origin_[1]);
      points_.z[i] = static_cast<float>(xyz_[3 * i + 2] - origin_[2]);
    }
    volume.enclose(points_, begin, end);
  }

  /// Tests pairs within a subtree, close pairs along the chain first. Returns true when the answer needs no more.
  template <class Answer>
  bool self(std::size_t level, std::size_t k, Answer& answer) {
    if (group_[node(level, k)] != mixed || moves_as_one(node(level, k), node(level, k))) return false;
    if (level == 0) {
      test_leaf(k);
    } else {
      const std::size_t left = 2 * k, right = left + 1;
      if (self(level - 1, left, answer)) return true;
      if (right == levels_[level - 1].count) return false;
      if (self(level - 1, right, answer)) return true;
      cross(level - 1, left, right);
    }
    return tasks_.size() > flush_at && flush(answer);
  }

  /// Tests pairs between two subtrees of a level: descends level by level to the leaves, without a branch per pair.
  void cross(std::size_t level, std::size_t left, std::size_t right) {
    front_.assign(1, {static_cast<std::uint32_t>(left), static_cast<std::uint32_t>(right)});
    if (!near(level, left, right)) return;
    for (; level != 0; --level) {
      next_.resize(4 * front_.size() + 4);
      std::size_t count = 0;
      const std::size_t below = levels_[level - 1].count;
      for (const Pair& p : front_)
        for (const std::uint32_t a : {2 * p.a, 2 * p.a + 1})
          for (const std::uint32_t b : {2 * p.b, 2 * p.b + 1}) {
            next_[count] = {a, b};
            count += b < below && near(level - 1, a, b);  // b exists; a is left of b, so a exists too
          }
      next_.resize(count);
      std::swap(front_, next_);
    }
    for (const Pair& p : front_) test_leaves(p.a, p.b);
  }
  bool near(std::size_t level, std::size_t a, std::size_t b) const {
    const std::size_t first = levels_[level].first;
    const std::uint32_t group = group_[first + a];
    if ((group == group_[first + b] && group != mixed) || moves_as_one(first + a, first + b)) return false;
    return volumes_[first + a].near(volumes_[first + b], rules_.cutoff());
  }

  bool moves_as_one(std::size_t a, std::size_t b) const {
    return !part_.empty() && part_[a] == part_[b] && part_[a] != mixed;
  }

  void test_leaf(std::size_t leaf) {
    const std::size_t begin = leaf * leaf_size, end = std::min(begin + leaf_size, points_.size);
    if constexpr (!Leaves::lanes) {
      for (std::size_t i = begin; i < end; ++i) test_one(i, i + 1, end);
      return;
    }
    test(begin, first_lanes(static_cast<std::ptrdiff_t>(end - begin)), begin, [&](std::size_t i, std::uint32_t mask) {
      return mask & ~first_lanes(static_cast<std::ptrdiff_t>(i + 1 - begin));
    });
  }
  /// Tests points of one leaf that are near the volume of the other leaf, from the leaf with fewer such points.
  void test_leaves(std::size_t a, std::size_t b) {
    const float cutoff = rules_.cutoff();
    if constexpr (!Leaves::lanes) {
      const std::size_t end = std::min((b + 1) * leaf_size, points_.size);
      for (std::size_t i = a * leaf_size; i < (a + 1) * leaf_size; ++i)
        if (volumes_[b].near(points_.x[i], points_.y[i], points_.z[i], cutoff)) test_one(i, b * leaf_size, end);
      return;
    }
    const std::uint32_t of_a = volumes_[b].near(points_, a * leaf_size, cutoff);
    const std::uint32_t of_b = volumes_[a].near(points_, b * leaf_size, cutoff);
    const auto pass = [](std::size_t, std::uint32_t mask) { return mask; };
    if (std::popcount(of_a) < std::popcount(of_b))
      test(a * leaf_size, of_a, b * leaf_size, pass);
    else
      test(b * leaf_size, of_b, a * leaf_size, pass);
  }
  void test_one(std::size_t i, std::size_t begin, std::size_t end) {
    const Columns& p = points_;
    const float* row = rules_.row(p.type(i));
    for (std::size_t j = begin; j < end; ++j) {
      const float dx = p.x[j] - p.x[i], dy = p.y[j] - p.y[i], dz = p.z[j] - p.z[i];
      if (dx * dx + dy * dy + dz * dz < row[p.type(j)]) tasks_.add(i, i + 1, j, [](std::size_t) { return 1u; });
    }
  }
  template <class Keep>
  void test(std::size_t from, std::uint32_t which, std::size_t block, const Keep& keep) {
    const Columns& p = points_;
    const Lanes x = Lanes::load(&p.x[block]), y = Lanes::load(&p.y[block]), z = Lanes::load(&p.z[block]);
    const Tags tags = Tags::load(&p.tag[block]);
    tasks_.add_lanes(from, which, block, [&](std::size_t i) {
      const Lanes squared = squared_distance(x, y, z, p.x[i], p.y[i], p.z[i]);
      return keep(i, less(squared, Lanes::lookup(rules_.row(p.type(i)), tags)));
    });
  }

  template <class Answer>
  bool flush(Answer& answer) {
    const bool stop = rules_.settle(xyz_.data(), points_, points_, tasks_.tasks(), answer);
    tasks_.clear();
    if constexpr (std::is_same_v<Answer, ClosestPair>)
      if (answer.found) rules_.set_margin(answer.margin, extent_);
    return stop;
  }

  static constexpr std::size_t flush_at = 48;  // the number of tasks after which candidates are decided

  PairRules rules_;
  Columns points_;
  std::vector<Level> levels_;
  std::vector<std::uint32_t> group_;  // per node
  std::vector<Volume> volumes_;       // per node
  std::vector<std::uint32_t> part_;   // per node: its moving part in the present move, or `mixed`; empty without a move
  std::vector<Volume> saved_;         // volumes of the refitted nodes before the present move
  std::vector<std::array<float, 3>> saved_points_;
  double move_extent_ = 0.0;
  bool has_fixed_ = false, placed_ = false;
  std::array<double, 3> origin_{};
  double extent_ = 0.0;
  std::span<const double> xyz_;
  std::vector<Pair> front_, next_;
  TaskList tasks_;
};

template <class Leaves>
using ChainTree = SearchingPeer<ChainSearch<Leaves>>;
using ChainTreeSpheres = ChainTree<LaneLeaves<SphereVolume>>;
using ChainTreeBoxes = ChainTree<LaneLeaves<BoxVolume>>;
using ScalarChainTreeSpheres = ChainTree<ScalarLeaves<SphereVolume>>;
using ScalarChainTreeBoxes = ChainTree<ScalarLeaves<BoxVolume>>;

}  // namespace hinge::bench
