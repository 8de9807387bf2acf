// SPDX-License-Identifier: BSD-3-Clause
// Walker: each step equals a drawn move that brute force accepts or rejects, with closed cycles and without; the start;
// rejected arguments.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <limits>
#include <utility>
#include <vector>

#include "hinge/core/error.hpp"
#include "hinge/molecular/checker.hpp"
#include "hinge/molecular/walker.hpp"
#include "hinge/moves/dof_change.hpp"
#include "hinge/moves/move_closer.hpp"
#include "hinge/moves/random_move.hpp"
#include "molecular/free_molecule.hpp"
#include "molecular/test_files.hpp"

namespace hinge::molecular {
namespace walker_test {

const Mode any = Mode::parse("any", "angstrom");
const CheckOptions exempt = [] {
  CheckOptions options;
  options.exempt_reference = true;
  return options;
}();

/// Walks `steps` steps, and makes the same walk by brute force. Returns the counts.
WalkCounts compare(const test::FreeMolecule& made, const CheckOptions& rules, const WalkOptions& options,
                   std::uint64_t steps) {
  Walker walker(made.checker(rules, "simd"), options);
  Checker brute = made.checker(rules, "brute");
  MoveCloser closer(made.molecule->model().tree(), brute.selection(), options.closures);
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
  const test::FreeMolecule ubiquitin(read_structure(test::ubiquitin()), "all");
  for (const std::size_t changes : {1U, 3U}) {
    const WalkCounts counts = compare(ubiquitin, exempt, {.changes = changes, .sigma = 0.1, .seed = 40 + changes}, 300);
    EXPECT_GT(counts.accepted, 20U);
    EXPECT_GT(counts.steps - counts.accepted, 20U);
    EXPECT_LT(counts.full_queries, counts.steps);
  }
}

TEST(Walker, KeepsCyclesClosed) {
  const test::FreeMolecule cystines(read_structure(test::molecule_file("nmr_neopetrosiamide.pdb")), "all");
  ASSERT_EQ(cystines.kept.closures.size(), 3U);
  const WalkOptions small{.closures = cystines.kept.closures, .changes = 2, .sigma = 0.5, .seed = 7};
  EXPECT_GT(compare(cystines, exempt, small, 400).accepted, 20U);

  const test::FreeMolecule loop(read_structure(test::ubiquitin()), "none", "A:7-10");
  ASSERT_EQ(loop.kept.closures.size(), 1U);
  const WalkOptions large{.closures = loop.kept.closures, .changes = loop.kept.torsions.size(), .sigma = 2.0};
  const WalkCounts counts = compare(loop, exempt, large, 400);
  EXPECT_GT(counts.accepted, 0U);
  EXPECT_GT(counts.unclosed, 0U);
}

TEST(Walker, StartsAnywhere) {
  const test::FreeMolecule tail(read_structure(test::ubiquitin()), "A:70-76");
  Checker brute = tail.checker({}, "brute");
  WalkOptions options;
  options.start.assign(brute.dof_count(), 0.0);
  Walker first(tail.checker({}, "simd"));
  const auto reference = brute.check(options.start, Mode::parse("all", "angstrom")).pairs;
  EXPECT_FALSE(reference.empty());
  EXPECT_EQ(first.collisions().size(), reference.size());

  // From a conformation that collides, a walk goes to free ones alone.
  options.sigma = 0.4;
  EXPECT_GT(compare(tail, {}, options, 200).accepted, 0U);
  options.start[2] = 2.0;
  options.start[5] = -1.5;
  compare(tail, {}, options, 200);

  first.step();
  const std::vector<double> q(first.configuration().begin(), first.configuration().end());
  Walker moved(std::move(first));
  EXPECT_EQ(moved.counts().steps, 1U);
  EXPECT_EQ(std::vector<double>(moved.configuration().begin(), moved.configuration().end()), q);
  moved.step();
  EXPECT_EQ(moved.counts().steps, 2U);
}

TEST(Walker, RefusesWhatCannotWalk) {
  const Structure ubiquitin = read_structure(test::ubiquitin());
  const Checker checker = test::FreeMolecule(ubiquitin, "A:70-76").checker({}, "simd");
  const auto refused = [&](const WalkOptions& options) { EXPECT_THROW(Walker(checker, options), ModelError); };
  refused({.changes = 0});
  refused({.changes = checker.dof_count() + 1});
  refused({.closures = {1000}});
  for (const double sigma : {0.0, -1.0, 2e9, std::nan(""), std::numeric_limits<double>::infinity()})
    refused({.sigma = sigma});
  EXPECT_THROW(Walker(checker, {.start = {0.0}}), ConfigurationError);
  EXPECT_THROW(Walker(checker, {.start = std::vector<double>(checker.dof_count(), std::nan(""))}), ConfigurationError);
  EXPECT_THROW(Walker(test::FreeMolecule(ubiquitin, "none").checker({}, "simd")), ModelError);
  const test::FreeMolecule placed(read_structure(test::molecule_file("1hpx.pdb")), "none", "", "B");
  EXPECT_THROW(Walker(placed.checker({}, "simd")), ModelError);
}

}  // namespace walker_test
}  // namespace hinge::molecular
