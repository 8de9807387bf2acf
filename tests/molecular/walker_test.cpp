// SPDX-License-Identifier: BSD-3-Clause
// Walker: each step equals a drawn move that brute force accepts or rejects, with closed cycles and without; the start;
// rejected arguments.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "hinge/core/error.hpp"
#include "hinge/molecular/checker.hpp"
#include "hinge/molecular/join_structures.hpp"
#include "hinge/molecular/kept_closures.hpp"
#include "hinge/molecular/loop.hpp"
#include "hinge/molecular/molecule.hpp"
#include "hinge/molecular/part.hpp"
#include "hinge/molecular/selection.hpp"
#include "hinge/molecular/walker.hpp"
#include "hinge/moves/dof_change.hpp"
#include "hinge/moves/move_closer.hpp"
#include "hinge/moves/random_move.hpp"
#include "molecular/test_files.hpp"

namespace hinge::molecular {
namespace walker_test {

/// A molecule with free torsions whose closures are kept.
struct Subject {
  Subject(const Structure& structure, const std::string& free, bool exempt = true, const std::string& loop = "") {
    MoleculeOptions made;
    if (!loop.empty()) made.loops = find_loops(structure, loop);
    molecule = std::make_shared<const Molecule>(structure, made);
    const auto torsions =
        loop.empty() ? select_torsions(*molecule, free, false) : select_loop_torsions(*molecule, free, false);
    const KeptClosures kept = find_kept_closures(*molecule, torsions, Closures::all);
    walk.closures = kept.closures;
    options.exempt_reference = exempt;
    checker.emplace(molecule, molecule->select(kept.torsions), options);
  }
  /// The same checks by brute force.
  Checker brute() const {
    CheckOptions other = options;
    other.engine = "brute";
    return {molecule, checker->selection(), other};
  }

  std::shared_ptr<const Molecule> molecule;
  CheckOptions options;
  WalkOptions walk;
  std::optional<Checker> checker;
};

const Mode any = Mode::parse("any", "angstrom");

/// Walks `steps` steps, and makes the same walk by brute force. Returns the counts.
WalkCounts compare(const Subject& subject, const WalkOptions& options, std::uint64_t steps) {
  Walker walker(*subject.checker, options);
  Checker brute = subject.brute();
  MoveCloser closer(subject.molecule->model().tree(), brute.selection(), options.closures);
  std::vector<double> q(brute.dof_count(), 0.0);
  if (!options.start.empty()) q = options.start;
  std::vector<DofChange> move;
  std::uint64_t accepted = 0, unclosed = 0;
  for (std::uint64_t k = 0; k < steps; ++k) {
    random_move(options.seed, k, q, options.changes, options.sigma, move);
    std::vector<double> next = q;
    const bool closed = closer.close(q, move);
    if (closed)
      for (const DofChange& change : move) next[change.dof] = change.value;
    const bool expected = closed && !brute.check(next, any).collides;
    if (expected) q = next;
    accepted += expected ? 1 : 0;
    unclosed += closed ? 0 : 1;
    EXPECT_EQ(walker.step(), expected) << "step " << k;
    const auto now = walker.configuration();
    EXPECT_EQ(std::vector<double>(now.begin(), now.end()), q) << "step " << k;
    if (::testing::Test::HasFailure()) break;
  }
  const Verdict last = brute.check(q, any);
  EXPECT_EQ(walker.positions(), brute.positions());
  EXPECT_EQ(walker.collisions().empty(), !last.collides);
  EXPECT_LT(last.closure_residual, 1e-6);
  const WalkCounts counts = walker.counts();
  EXPECT_EQ(counts.steps, steps);
  EXPECT_EQ(counts.accepted, accepted);
  EXPECT_EQ(counts.unclosed, unclosed);
  return counts;
}

TEST(Walker, WalksAsBruteForceDecides) {
  const Subject subject(read_structure(test::ubiquitin()), "all");
  WalkOptions options = subject.walk;
  options.sigma = 0.1;
  for (const std::size_t changes : {1U, 3U}) {
    options.changes = changes;
    options.seed = 40 + changes;
    const WalkCounts counts = compare(subject, options, 300);
    EXPECT_GT(counts.accepted, 20U);
    EXPECT_GT(counts.steps - counts.accepted, 20U);
    EXPECT_LT(counts.full_queries, counts.steps);
  }
}

TEST(Walker, KeepsCyclesClosed) {
  const Subject cystines(read_structure(test::molecule_file("nmr_neopetrosiamide.pdb")), "all");
  ASSERT_EQ(cystines.walk.closures.size(), 3U);
  WalkOptions options = cystines.walk;
  options.changes = 2;
  options.sigma = 0.5;
  options.seed = 7;
  EXPECT_GT(compare(cystines, options, 400).accepted, 20U);

  const Subject loop(read_structure(test::ubiquitin()), "none", true, "A:7-10");
  ASSERT_EQ(loop.walk.closures.size(), 1U);
  options = loop.walk;
  options.changes = loop.checker->dof_count();
  options.sigma = 2.0;
  const WalkCounts counts = compare(loop, options, 400);
  EXPECT_GT(counts.accepted, 0U);
  EXPECT_GT(counts.unclosed, 0U);
}

TEST(Walker, StartsAnywhere) {
  const Subject subject(read_structure(test::ubiquitin()), "A:70-76", false);
  EXPECT_FALSE(subject.checker->reference_collisions().empty());
  WalkOptions options = subject.walk;
  Walker first(*subject.checker, options);
  const std::vector<Hit> hits = first.collisions();
  Checker brute = subject.brute();
  const std::vector<double> reference(brute.dof_count(), 0.0);
  EXPECT_EQ(hits.size(), brute.check(reference, Mode::parse("all", "angstrom")).pairs.size());

  // From a conformation that collides, a walk goes to free ones alone.
  options.start.assign(brute.dof_count(), 0.0);
  options.start[2] = 2.0;
  options.start[5] = -1.5;
  options.sigma = 0.4;
  compare(subject, options, 200);

  Walker moved(std::move(first));
  moved.step();
  EXPECT_EQ(moved.counts().steps, 1U);
}

TEST(Walker, RefusesWhatCannotWalk) {
  const Structure structure = read_structure(test::ubiquitin());
  const Subject subject(structure, "A:70-76");
  const auto refused = [&](const WalkOptions& options) { EXPECT_THROW(Walker(*subject.checker, options), ModelError); };
  refused({.changes = 0});
  refused({.changes = subject.checker->dof_count() + 1});
  refused({.closures = {1000}});
  for (const double sigma : {0.0, -1.0, 2e9, std::nan(""), std::numeric_limits<double>::infinity()})
    refused({.sigma = sigma});
  EXPECT_THROW(Walker(*subject.checker, {.start = {0.0}}), ConfigurationError);
  EXPECT_THROW(Walker(*subject.checker, {.start = std::vector<double>(subject.checker->dof_count(), std::nan(""))}),
               ConfigurationError);
  EXPECT_THROW(Walker(Checker(subject.molecule, subject.molecule->select({}), {})), ModelError);

  Structure other = structure;
  for (Vec3& x : other.models.front()) x[0] += 60.0;
  other.chains.front().name = "B";
  const Structure both = join_structures({structure, other});
  MoleculeOptions made;
  made.placed.push_back(find_part(both, "B", ResidueNames::only));
  const auto molecule = std::make_shared<const Molecule>(both, made);
  EXPECT_THROW(Walker(Checker(molecule, molecule->select_placed(std::vector<std::size_t>{}), {})), ModelError);
}

}  // namespace walker_test
}  // namespace hinge::molecular
