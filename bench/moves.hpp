// SPDX-License-Identifier: BSD-3-Clause
// Monte Carlo walks of collision-free moves from the native structure; every step is timed for each contestant.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <limits>
#include <memory>
#include <numbers>
#include <span>
#include <string>
#include <vector>

#include "hinge/kinematics/frame.hpp"
#include "hinge/moves/move_checker.hpp"
#include "hinge/moves/random_move.hpp"
#include "peers/chain_tree.hpp"
#include "results.hpp"
#include "scene.hpp"
#include "timing.hpp"

namespace hinge::bench {

/// Times include everything, except that the chains receive frames from forward kinematics.
/// chain-skip tests leaves pair by pair, as published; chain16-skip tests them in SIMD lanes.
enum Mover : std::size_t { mover_moves, mover_full, mover_moved_only, mover_chain_skip, mover_chain16_skip, movers };
inline constexpr std::array<const char*, movers> mover_names = {"moves", "full", "moved-only", "chain-skip",
                                                                "chain16-skip"};

/// Counts and mean times of one walk.
struct Walk {
  std::size_t steps = 0, accepted = 0, recalled = 0, full_queries = 0, differences = 0;
  double blocks = 0.0;              ///< moved per step
  std::array<double, movers> us{};  ///< per step
  std::array<double, movers> accepted_us{}, rejected_us{};

  double ratio(Mover m) const { return us[m] / us[mover_moves]; }
};

/// One step of the walk, as contestants receive it.
struct Step {
  std::vector<DofChange> changes;
  bool is_free = false;
};

/// A step with a chain tree: place moved points, refit, search, and undo a move that collides.
template <class Leaves>
class ChainMover {
 public:
  explicit ChainMover(const Scene& scene)
      : tree_(scene.input()),
        frames_(scene.make<Simd>()),
        parts_(*frames_.model().groups()),
        place_of_(scene.dof_count()) {
    const SelectedModel<Point>& model = frames_.model();
    for (std::uint32_t p = 1; p < parts_.size(); ++p) place_of_[(*model.groups())[parts_.group(p)].dof] = p;
    for (std::size_t i = 0; i < model.size(); ++i) group_of_.push_back(model.group_of(id<PrimitiveId>(i)));
    body_.resize(model.size());
  }
  void start(std::span<const double> q) {
    frames_.update(q);
    xyz_.clear();
    for (const Point& p : frames_.placed()) xyz_.insert(xyz_.end(), {p.position[0], p.position[1], p.position[2]});
    tree_.update(xyz_);
  }
  /// Computes frames and moving parts, not timed. after: the configuration after the step.
  void prepare(const Step& step, std::span<const double> after) {
    joints_.clear();
    for (const DofChange& change : step.changes) joints_.push_back(place_of_[change.dof]);
    std::ranges::sort(joints_);
    parts_.cut(joints_);
    moved_.clear();
    for (std::uint32_t i = 0; i < body_.size(); ++i) {
      body_[i] = parts_.part_of(group_of_[i]);
      if (body_[i] != 0) moved_.push_back(i);
    }
    tree_.prepare_move(body_);
    next_ = xyz_;
    frames_.update(after);
    poses_ = frames_.frames();
  }
  bool is_free() {
    for (const std::uint32_t i : moved_) {
      const double* x = frames_.model().primitives()[i].position.data();
      std::array<double, 4> placed;
      detail::FrameColumns(poses_[index(group_of_[i])]).place(x[0], x[1], x[2]).store(placed.data());
      std::copy_n(placed.data(), 3, next_.data() + 3 * std::size_t{i});
    }
    const bool is_free = !tree_.move_collides(next_);
    if (is_free)
      xyz_.swap(next_);
    else
      tree_.take_back();
    return is_free;
  }

 private:
  ChainSearch<Leaves> tree_;
  Molecular<Simd> frames_;
  detail::MovingParts parts_;
  std::vector<std::uint32_t> place_of_, joints_, body_, moved_;
  std::vector<GroupId> group_of_;
  std::vector<double> xyz_, next_;
  std::span<const Frame> poses_;
};

/// Each step changes `dofs` DOF by N(0, 3 degrees). A contestant does the walk three times in a row, as in practice:
/// the cache holds its own data only. Contestants take turns eight times, because the speed of the machine varies;
/// the best time of each step counts.
inline Walk walk(Scene& scene, std::size_t dofs, std::size_t steps) {
  constexpr double sigma = 3.0 * std::numbers::pi / 180.0;
  auto full = scene.make<Simd>(), moved_only = full;
  MoveChecker moves(full);
  ChainMover<ScalarLeaves<BoxVolume>> chain(scene);
  ChainMover<LaneLeaves<BoxVolume>> chain16(scene);
  const std::vector<double> native(scene.dof_count(), 0.0);
  std::vector<Step> taken(steps);
  Walk walk;
  walk.steps = steps;
  for (std::size_t k = 0; k < steps; ++k) {
    random_move(seed, k, moves.configuration(), dofs, sigma, taken[k].changes);
    taken[k].is_free = moves.try_move(taken[k].changes);
    taken[k].is_free ? moves.accept() : moves.reject();
  }
  walk.full_queries = moves.counts().full_queries;
  walk.recalled = moves.counts().recalled;
  walk.blocks = static_cast<double>(moves.counts().blocks_moved) / static_cast<double>(steps);

  std::vector<std::array<double, movers>> best(steps);
  for (auto& b : best) b.fill(std::numeric_limits<double>::infinity());
  std::vector<double> before, after;
  const auto price = [&](Mover m, const auto& start, const auto& prepare, const auto& work) {
    for (int repetition = 0; repetition < repetitions; ++repetition) {
      start();
      before = after = native;
      for (std::size_t k = 0; k < steps; ++k) {
        for (const DofChange& change : taken[k].changes) after[change.dof] = change.value;
        prepare(taken[k]);
        bool is_free = false;
        best[k][m] = std::min(best[k][m], microseconds([&] { is_free = work(taken[k]); }));
        walk.differences += is_free == taken[k].is_free ? 0 : 1;
        const std::vector<double>& kept = taken[k].is_free ? after : before;
        for (const DofChange& change : taken[k].changes) before[change.dof] = after[change.dof] = kept[change.dof];
      }
    }
  };
  const auto nothing = [](const Step&) {};
  for (int round = 0; round < 8; ++round) {
    price(
        mover_moves,
        [&] {
          moves.set(native);
          moves.try_move(taken.front().changes);  // places all blocks, once per walk
          moves.reject();
        },
        nothing,
        [&](const Step& step) {
          const bool is_free = moves.try_move(step.changes);
          is_free ? moves.accept() : moves.reject();
          return is_free;
        });
    price(
        mover_full, [&] { full.update(native); }, nothing,
        [&](const Step&) {
          full.update(after);
          return !full.self_collides();
        });
    price(
        mover_moved_only, [&] { moved_only.update(native); }, nothing,
        [&](const Step&) {
          QueryOptions options;
          options.moved_only = true;
          moved_only.update(after);
          const bool is_free = !moved_only.self_collides(options);
          if (!is_free) moved_only.update(before);
          return is_free;
        });
    price(
        mover_chain_skip, [&] { chain.start(native); }, [&](const Step& step) { chain.prepare(step, after); },
        [&](const Step&) { return chain.is_free(); });
    price(
        mover_chain16_skip, [&] { chain16.start(native); }, [&](const Step& step) { chain16.prepare(step, after); },
        [&](const Step&) { return chain16.is_free(); });
  }
  for (std::size_t step = 0; step < steps; ++step) {
    walk.accepted += taken[step].is_free ? 1 : 0;
    for (std::size_t m = 0; m < movers; ++m) {
      walk.us[m] += best[step][m];
      (taken[step].is_free ? walk.accepted_us : walk.rejected_us)[m] += best[step][m];
    }
  }
  for (std::size_t m = 0; m < movers; ++m) {
    walk.us[m] /= static_cast<double>(steps);
    walk.accepted_us[m] /= std::max(1.0, static_cast<double>(walk.accepted));
    walk.rejected_us[m] /= std::max(1.0, static_cast<double>(steps - walk.accepted));
  }
  return walk;
}

/// Prints `moves any Ddof PEER R`, where R is the peer's time per step over the time of `moves`. Returns the number
/// of wrong verdicts.
inline std::size_t print_walk(Results& results, const Walk& walk, std::size_t dofs) {
  for (const Mover m : {mover_full, mover_moved_only, mover_chain_skip, mover_chain16_skip})
    results.print("moves any " + std::to_string(dofs) + "dof " + mover_names[m], walk.ratio(m), 1);
  return walk.differences;
}

/// 1MBN with all torsions free, or 1UBQ without the shared data. Returns the number of wrong verdicts.
inline std::size_t print_walks(Results& results) {
  const std::string shared = shared_molecule("paper/1mbn.pdb");
  Scene scene(read_protein(shared.empty() ? ubiquitin() : shared, false), "all");
  std::size_t differences = 0;
  for (const std::size_t dofs : {1U, 3U, 10U}) differences += print_walk(results, walk(scene, dofs, 500), dofs);
  if (differences != 0) std::printf("%zu moves with a WRONG verdict\n", differences);
  return differences;
}

}  // namespace hinge::bench
