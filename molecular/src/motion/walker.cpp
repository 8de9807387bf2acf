// SPDX-License-Identifier: BSD-3-Clause
// Implements a walk with MoveChecker, MoveCloser and random_move.
#include "hinge/molecular/walker.hpp"

#include <string>
#include <utility>

#include "hinge/core/error.hpp"
#include "hinge/core/id.hpp"
#include "hinge/core/number_text.hpp"
#include "hinge/engine/simd.hpp"
#include "hinge/moves/dof_change.hpp"
#include "hinge/moves/move_checker.hpp"
#include "hinge/moves/move_closer.hpp"
#include "hinge/moves/random_move.hpp"

namespace hinge::molecular {

namespace {

/// Throws ModelError if the molecule or the options allow no walk.
void require_walk(const Checker& checker, const WalkOptions& options) {
  if (!checker.molecule().placed_parts().empty())
    throw ModelError("walk: changes only torsions, expected a molecule without placed parts");
  const std::size_t dof = checker.dof_count();
  if (dof == 0) throw ModelError("walk: no torsion is free, expected at least one");
  if (options.changes < 1 || options.changes > dof)
    throw ModelError("walk: " + std::to_string(options.changes) + " changes per step, expected 1 to " +
                     std::to_string(dof) + ", the number of free torsions");
  if (!(options.sigma > 0.0 && options.sigma <= 1e9))
    throw ModelError("walk: standard deviation " + number_text(options.sigma) +
                     ", expected an angle above 0, at most 1e9 rad");
}

}  // namespace

struct Walker::Walk {
  MoveChecker<Point, BondExclusions, TypedThresholds> moves;
  MoveCloser closer;
  WalkOptions options;
  std::vector<DofChange> move{};  // of a step
  WalkCounts counts{};            // without full_queries
};

Walker::Walker(const Checker& checker, const WalkOptions& options) {
  require_walk(checker, options);
  const Model<Point>& model = checker.molecule().model();
  walk_ =
      std::make_unique<Walk>(Walk{MoveChecker(MolecularHierarchy<Simd>(model, checker.selection(), checker.exclusions(),
                                                                       checker.thresholds().matrix)),
                                  MoveCloser(model.tree(), checker.selection(), options.closures), options});
  if (!options.start.empty()) walk_->moves.set(options.start);
}

Walker::Walker(Walker&&) noexcept = default;
Walker& Walker::operator=(Walker&&) noexcept = default;
Walker::~Walker() = default;

bool Walker::step() {
  auto& [moves, closer, options, move, counts] = *walk_;
  random_move(options.seed, counts.steps++, moves.configuration(), options.changes, options.sigma, move);
  if (!closer.close(moves.configuration(), move)) {
    ++counts.unclosed;
    return false;
  }
  if (!moves.try_move(move)) {
    moves.reject();
    return false;
  }
  moves.accept();
  ++counts.accepted;
  return true;
}

std::span<const double> Walker::configuration() const noexcept { return walk_->moves.configuration(); }

std::vector<Vec3> Walker::positions() {
  auto& moves = walk_->moves;
  std::vector<Vec3> all;
  all.reserve(moves.model().size());
  for (std::size_t i = 0; i < moves.model().size(); ++i) all.push_back(moves.placed(id<PrimitiveId>(i)).position);
  return all;
}

std::vector<Hit> Walker::collisions() { return walk_->moves.collisions(); }

WalkCounts Walker::counts() const noexcept {
  WalkCounts counts = walk_->counts;
  counts.full_queries = walk_->moves.counts().full_queries;
  return counts;
}

}  // namespace hinge::molecular
