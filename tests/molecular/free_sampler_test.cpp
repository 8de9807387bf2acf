// SPDX-License-Identifier: BSD-3-Clause
// FreeSampler: every conformation is free by brute force, closed and different from the reference; growth equals a
// plain loop over whole-molecule checks; what cannot be found is said.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <memory>
#include <numbers>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "hinge/core/error.hpp"
#include "hinge/molecular/checker.hpp"
#include "hinge/molecular/free_sampler.hpp"
#include "hinge/molecular/ideal_protein.hpp"
#include "hinge/molecular/join_structures.hpp"
#include "hinge/molecular/molecule.hpp"
#include "hinge/molecular/part.hpp"
#include "hinge/molecular/selection.hpp"
#include "molecular/free_molecule.hpp"
#include "molecular/test_files.hpp"

namespace hinge::molecular {
namespace free_sampler_test {

/// A molecule with free torsions, as biocd sample --collision-free makes it.
struct Question {
  Question(const Structure& structure, const std::string& loop, const std::string& free, const std::string& engine) {
    const test::FreeMolecule made(structure, free, loop);
    molecule = made.molecule;
    closures = made.kept.closures;
    options.exempt_reference = true;
    checker = made.checker(options, engine);
  }
  FreeSampler sampler(Prior prior, std::uint64_t seed) const {
    FreeSampling how;
    how.prior = prior;
    how.sampling.seed = seed;
    return {*checker, how, closures, {}};
  }
  /// The same checks by brute force.
  Checker brute() const {
    CheckOptions other = options;
    other.engine = "brute";
    return {molecule, checker->selection(), other};
  }

  std::shared_ptr<const Molecule> molecule;
  std::vector<std::size_t> closures;
  CheckOptions options;
  std::optional<Checker> checker;
};

/// The number of sectors of 30 degrees that the torsions visit, mean over all torsions.
double mean_sectors(const std::vector<std::vector<double>>& samples) {
  double sum = 0.0;
  for (std::size_t k = 0; k < samples.front().size(); ++k) {
    std::set<int> visited;
    for (const std::vector<double>& q : samples)
      visited.insert(static_cast<int>(std::floor(std::remainder(q[k], 2.0 * std::numbers::pi) / std::numbers::pi * 6)));
    sum += static_cast<double>(visited.size());
  }
  return sum / static_cast<double>(samples.front().size());
}

TEST(FreeSampler, FindsOnlyConformationsThatAreFreeByBruteForce) {
  struct Case {
    std::string file, loop, free;
    Prior prior;
    std::uint64_t count;
    double least_sectors;
  };
  // In the long run 10 000 conformations.
  const std::uint64_t times = std::getenv("HINGE_TEST_ALL") != nullptr ? 20 : 1;
  for (const Case& c : {Case{"1ubq", "A:7-11", "A:7-11 and chi", Prior::ramachandran, 100, 3.0},
                        Case{"1ubq", "A:6-17", "A:6-17 and chi", Prior::ramachandran, 15, 2.0},
                        Case{"1ubq", "A:7-11", "none", Prior::independent, 100, 2.0},
                        Case{"1ubq", "", "A:70-76", Prior::ramachandran, 200, 3.0},
                        Case{"1ubq", "", "A:70-76", Prior::independent, 100, 6.0},
                        Case{"1ubq", "", "all", Prior::ramachandran, 20, 3.0},
                        Case{"2src", "", "A:245-255", Prior::ramachandran, 10, 2.0},
                        Case{"2src", "", "A:405-420", Prior::ramachandran, 10, 2.0},
                        Case{"5pti", "", "A:1-9", Prior::ramachandran, 10, 2.0}}) {
    SCOPED_TRACE(c.file + " " + c.loop + " " + c.free);
    const Structure structure =
        read_structure(c.file == "1ubq" ? test::ubiquitin() : test::molecule_file(c.file + ".pdb"));
    const Question question(structure, c.loop, c.free, "simd");
    FreeSampler sampler = question.sampler(c.prior, 1);
    Checker brute = question.brute();
    std::vector<std::vector<double>> samples;
    for (std::uint64_t k = 0; k < times * c.count; ++k) {
      const FreeSample sample = sampler.sample(k);
      ASSERT_TRUE(sample.found()) << k;
      EXPECT_TRUE(sample.blockers.empty());
      const Verdict verdict = brute.check(sample.q, Mode::parse("any"));
      EXPECT_FALSE(verdict.collides) << k;
      for (const std::size_t closure : question.closures) EXPECT_LT(verdict.closure_residuals[closure], 1e-8) << k;
      samples.push_back(sample.q);
    }
    EXPECT_GT(mean_sectors(samples), c.least_sectors);
  }
}

TEST(FreeSampler, GivesTheSameSamplesWithEveryEngineInAnyOrder) {
  const Structure structure = read_structure(test::ubiquitin());
  for (const char* loop : {"A:7-11", ""}) {
    const std::string free = *loop == '\0' ? "A:60-76" : "A:7-11 and chi";
    const Question simd(structure, loop, free, "simd"), lazy(structure, loop, free, "lazy"),
        brute(structure, loop, free, "brute");
    FreeSampler first = simd.sampler(Prior::ramachandran, 9), second = lazy.sampler(Prior::ramachandran, 9),
                third = brute.sampler(Prior::ramachandran, 9);
    std::vector<std::vector<double>> expected;
    for (std::uint64_t k = 0; k < 6; ++k) expected.push_back(first.sample(k).q);
    for (std::uint64_t k = 6; k-- > 0;) {
      EXPECT_EQ(first.sample(k).q, expected[k]);
      EXPECT_EQ(second.sample(k).q, expected[k]);
      EXPECT_EQ(third.sample(k).q, expected[k]);
    }
    EXPECT_NE(expected[0], expected[1]);
    EXPECT_NE(simd.sampler(Prior::ramachandran, 10).sample(0).q, expected[0]);
  }
}

// A chain whose residues never collide: growth accepts every first draw, so samples are draws from the prior.
TEST(FreeSampler, KeepsThePriorWhereNothingCollides) {
  CheckOptions options;
  options.thresholds.rules = "biocd";
  options.thresholds.rho = 1e-3;
  const auto molecule = std::make_shared<const Molecule>(build_ideal_protein("ASA", "CCC"));
  const Checker checker(molecule, molecule->select(select_torsions(*molecule, "A:2:chi1", false)), options);
  FreeSampler sampler(checker, {}, {}, {});
  const double reference = molecule->torsions()[molecule->torsion_of(checker.selection().dofs()[0])].reference;
  constexpr int n = 20'000;
  int plus = 0;  // serine: rotamer p, 48.7 %
  for (std::uint64_t k = 0; k < n; ++k) {
    const FreeSample sample = sampler.sample(k);
    EXPECT_EQ(sample.starts(), 1U);
    const double chi = std::remainder(sample.q[0] + reference, 2.0 * std::numbers::pi);
    plus += chi > 0.0 && chi < 2.0 * std::numbers::pi / 3.0 ? 1 : 0;
  }
  EXPECT_NEAR(plus / static_cast<double>(n), 0.487, 0.02);
}

TEST(FreeSampler, SaysWhatIsInTheWay) {
  const Structure structure = read_structure(test::ubiquitin());
  CheckOptions options;
  options.thresholds.rules = "biocd";
  options.thresholds.rho = 3.0;  // nothing fits
  const auto molecule = std::make_shared<const Molecule>(structure);
  const Checker checker(molecule, molecule->select(select_torsions(*molecule, "A:70-76", false)), options);
  FreeSampling how;
  how.most_starts = 4;
  FreeSampler sampler(checker, how, {}, {});
  const FreeSample none = sampler.sample(0);
  EXPECT_FALSE(none.found());
  EXPECT_FALSE(none.stopped);
  EXPECT_EQ(none.dead_ends, 4U);
  EXPECT_EQ(none.starts(), 4U);
  EXPECT_FALSE(none.blockers.empty());
  EXPECT_TRUE(std::is_sorted(none.blockers.begin(), none.blockers.end(), [](const Hit& a, const Hit& b) {
    return std::pair(a.first, a.second) < std::pair(b.first, b.second);
  }));
  int calls = 0;
  const FreeSample stopped = sampler.sample(0, [&] { return ++calls > 2; });
  EXPECT_TRUE(stopped.stopped);
  EXPECT_EQ(stopped.dead_ends, 2U);
}

TEST(FreeSampler, MovesTowardsTheReferenceWhenItFails) {
  // The loop is buried: statistics alone find it once in hundreds of starts.
  const Question question(read_structure(test::ubiquitin()), "A:45-56", "A:45-56 and chi", "simd");
  FreeSampler sampler = question.sampler(Prior::ramachandran, 1);
  std::uint64_t starts = 0;
  for (std::uint64_t k = 0; k < 5; ++k) {
    const FreeSample sample = sampler.sample(k);
    ASSERT_TRUE(sample.found());
    starts += sample.starts();
  }
  EXPECT_GT(starts, 10U);
  EXPECT_LT(starts, 150U);
}

TEST(FreeSampler, DrawsPlacements) {
  Structure s = read_structure(test::ubiquitin());
  Structure other = s;
  for (Vec3& x : other.models.front()) x[0] += 30.0;
  other.chains.front().name = "B";
  const Structure both = join_structures({s, other});
  MoleculeOptions made;
  made.placed.push_back(find_part(both, "B", ResidueNames::only));
  const auto molecule = std::make_shared<const Molecule>(both, made);
  CheckOptions options;
  options.exempt_reference = true;
  const Checker checker(molecule, molecule->select_placed(std::vector<std::size_t>{}), options);
  FreeSampler sampler(checker, {}, {}, std::vector<PlacementRange>{{12.0, std::numbers::pi}});
  Checker judge = checker;
  std::uint64_t starts = 0;
  for (std::uint64_t k = 0; k < 50; ++k) {
    const FreeSample sample = sampler.sample(k);
    ASSERT_TRUE(sample.found());
    EXPECT_FALSE(judge.check(sample.q, Mode::parse("any")).collides);
    EXPECT_LE(std::hypot(sample.q[0], sample.q[1], sample.q[2]), 12.0);
    starts += sample.starts();
  }
  EXPECT_LT(starts, 100U);
  EXPECT_THROW(FreeSampler(checker, {}, {}, {}), ModelError);
}

TEST(FreeSampler, RefusesBadOptions) {
  const Structure structure = read_structure(test::ubiquitin());
  const Question question(structure, "", "A:70-76", "simd");
  FreeSampling how;
  how.most_starts = 0;
  EXPECT_THROW(FreeSampler(*question.checker, how, {}, {}), ModelError);
  how = {};
  how.most_draws = 0;
  EXPECT_THROW(FreeSampler(*question.checker, how, {}, {}), ModelError);
  how = {};
  how.prior = Prior::ramachandran;
  how.sampling.sigma = 0.1;
  EXPECT_THROW(FreeSampler(*question.checker, how, {}, {}), ModelError);
  const auto molecule = std::make_shared<const Molecule>(structure);
  const Checker rigid(molecule, molecule->select({}), CheckOptions{});
  EXPECT_THROW(FreeSampler(rigid, {}, {}, {}), ModelError);
}

}  // namespace free_sampler_test
}  // namespace hinge::molecular
