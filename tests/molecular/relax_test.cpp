// SPDX-License-Identifier: BSD-3-Clause
// Checker::steric and Displacement against sums over all pairs or atoms and finite differences; relax: turned side
// chains, loops, disulphides and placed parts become free by brute force, and nothing becomes worse.
#include "hinge/molecular/relax.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <limits>
#include <memory>
#include <numbers>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include "hinge/core/error.hpp"
#include "hinge/core/philox.hpp"
#include "hinge/core/vec3.hpp"
#include "hinge/molecular/selection.hpp"
#include "molecular/free_molecule.hpp"
#include "molecular/side_chains.hpp"
#include "molecular/test_files.hpp"
#include "motion/displacement.hpp"

namespace hinge::molecular {
namespace relax_test {

constexpr double degree = std::numbers::pi / 180.0;

/// A molecule with free torsions, as biocd relax makes it.
struct Question {
  Question(const Structure& structure, const std::string& free, const std::string& engine = "simd",
           const std::string& loop = "", const std::string& placed = "") {
    const test::FreeMolecule made(structure, free, loop, placed);
    molecule = made.molecule;
    how.closures = made.kept.closures;
    checker = made.checker(options, engine);
  }
  Verdict by_brute_force(const std::vector<double>& q) const {
    CheckOptions other = options;
    other.engine = "brute";
    return Checker(molecule, checker->selection(), other).check(q, Mode{Mode::Kind::all});
  }
  std::vector<double> reference() const { return std::vector<double>(checker->dof_count(), 0.0); }
  /// Returns the root of the mean squared displacement of the atoms that differ between two configurations, angstrom.
  double moved(const std::vector<double>& from, const std::vector<double>& to) {
    checker->check(from, Mode{});
    const std::vector<Vec3> x = checker->positions();
    checker->check(to, Mode{});
    const std::vector<Vec3> y = checker->positions();
    double sum = 0.0, count = 0.0;
    for (std::size_t i = 0; i < x.size(); ++i) {
      const double square = squared_norm(Vec3(x[i] - y[i]));
      sum += square;
      if (square > 1e-6) count += 1.0;
    }
    return std::sqrt(sum / std::max(1.0, count));
  }

  std::shared_ptr<const Molecule> molecule;
  CheckOptions options;
  RelaxOptions how;
  std::optional<Checker> checker;
};

std::vector<double> random_turns(const Checker& checker, double sigma, std::uint64_t seed) {
  std::vector<double> q(checker.dof_count());
  SampleStream stream(seed, 0);
  for (double& value : q) value = sigma * stream.normal();
  return q;
}

Structure structure_of(const std::string& name) {
  return read_structure(name == "1ubq" ? test::ubiquitin() : test::molecule_file(name));
}

TEST(Steric, IsTheSumOverAllPairsWithItsDerivatives) {
  struct Case {
    std::string file, free, loop, placed;
  };
  for (const Case& c : {Case{"1ubq", "all", "", ""}, Case{"1ubq", "chi", "", ""}, Case{"1ubq", "chi", "A:7-11", ""},
                        Case{"1hpx.pdb", "none", "", "B"}, Case{"1l2y.pdb", "all", "", ""}}) {
    SCOPED_TRACE(c.file + " " + c.free + " " + c.loop + c.placed);
    Question question(structure_of(c.file), c.free, "simd", c.loop, c.placed);
    Checker& checker = *question.checker;
    for (const double softness : {0.0, 0.3}) {
      const std::vector<double> q = random_turns(checker, 0.3, 11);
      const Steric steric = checker.steric(q, softness);
      ASSERT_EQ(steric.gradient.size(), checker.dof_count());
      double sum = 0.0;
      for (const Contact& pair : checker.check(q, Mode{Mode::Kind::within, softness}).pairs)
        sum += std::pow(pair.hit.threshold + softness - pair.hit.distance, 2);
      EXPECT_NEAR(steric.energy, sum, 1e-12 * sum);
      EXPECT_GT(steric.energy, 0.0);
      double scale = 0.0;
      for (const double value : steric.gradient) scale = std::max(scale, std::abs(value));
      for (std::size_t k = 0; k < q.size(); ++k) {
        constexpr double step = 1e-6;
        std::vector<double> a = q, b = q;
        a[k] += step;
        b[k] -= step;
        const double slope = (checker.steric(a, softness).energy - checker.steric(b, softness).energy) / (2 * step);
        EXPECT_NEAR(steric.gradient[k], slope, 1e-7 * scale) << k;
      }
    }
  }
}

TEST(Steric, HasTheSameBitsForEveryEngine) {
  Question simd(structure_of("1ubq"), "all"), lazy(structure_of("1ubq"), "all", "lazy"),
      brute(structure_of("1ubq"), "all", "brute");
  for (std::uint64_t seed = 1; seed <= 3; ++seed) {
    const std::vector<double> q = random_turns(*simd.checker, 0.2, seed);
    const Steric expected = simd.checker->steric(q, 0.1);
    for (Question* other : {&lazy, &brute}) {
      const Steric found = other->checker->steric(q, 0.1);
      EXPECT_EQ(found.energy, expected.energy);
      EXPECT_EQ(found.gradient, expected.gradient);
    }
  }
}

TEST(Steric, DoesNotDependOnThePlaceOfTheMolecule) {
  Structure far = structure_of("1ubq");
  for (Vec3& x : far.models.front()) x += Vec3(1000.0, -2000.0, 500.0);
  Question here(structure_of("1ubq"), "all"), there(far, "all");
  const std::vector<double> q = random_turns(*here.checker, 0.2, 5);
  const Steric a = here.checker->steric(q, 0.1), b = there.checker->steric(q, 0.1);
  EXPECT_NEAR(a.energy, b.energy, 1e-9 * a.energy);
  double scale = 0.0;
  for (const double value : a.gradient) scale = std::max(scale, std::abs(value));
  for (std::size_t k = 0; k < q.size(); ++k) EXPECT_NEAR(a.gradient[k], b.gradient[k], 1e-9 * scale);
}

TEST(Steric, RefusesBadArguments) {
  Question question(structure_of("1ubq"), "A:70-76");
  std::vector<double> q = question.reference();
  for (const double softness : {-1e-300, std::numeric_limits<double>::infinity(), std::nan("")})
    EXPECT_THROW(question.checker->steric(q, softness), ConfigurationError);
  q.back() = std::nan("");
  EXPECT_THROW(question.checker->steric(q, 0.0), ConfigurationError);
  q.pop_back();
  EXPECT_THROW(question.checker->steric(q, 0.0), ConfigurationError);
}

TEST(Displacement, IsTheSumOverAllAtomsWithItsDerivatives) {
  struct Case {
    std::string file, free, loop, placed;
  };
  for (const Case& c : {Case{"1ubq", "all", "", ""}, Case{"1ubq", "chi", "A:7-11", ""},
                        Case{"1hpx.pdb", "chi", "", "B"}, Case{"1l2y.pdb", "all", "", ""}}) {
    SCOPED_TRACE(c.file + " " + c.free + " " + c.loop + c.placed);
    Question question(structure_of(c.file), c.free, "simd", c.loop, c.placed);
    Checker& checker = *question.checker;
    const std::vector<double> start = random_turns(checker, 0.3, 12), q = random_turns(checker, 0.3, 13);
    const Displacement displacement(checker, start);
    checker.check(start, Mode{});
    const std::vector<Vec3> x = checker.positions();
    checker.check(q, Mode{});
    const std::vector<Vec3> y = checker.positions();
    double sum = 0.0;
    for (std::size_t atom = 0; atom < x.size(); ++atom) sum += squared_norm(Vec3(x[atom] - y[atom]));
    std::vector<double> gradient(q.size(), 1.0);  // add() adds
    constexpr double weight = 0.5;
    EXPECT_NEAR(displacement.add(weight, q, gradient), weight * sum, 1e-10 * sum);
    double scale = 0.0;
    for (const double value : gradient) scale = std::max(scale, std::abs(value));
    for (std::size_t k = 0; k < q.size(); ++k) {
      constexpr double step = 1e-6;
      std::vector<double> a = q, b = q, ignored(q.size());
      a[k] += step;
      b[k] -= step;
      const double slope = (displacement.add(weight, a, ignored) - displacement.add(weight, b, ignored)) / (2 * step);
      EXPECT_NEAR(gradient[k] - 1.0, slope, 1e-7 * scale) << k;
    }
    EXPECT_NEAR(displacement.add(weight, start, gradient), 0.0, 1e-20 * sum);
  }
}

/// Calls call(q, clashes) for `count` conformations of more than `goal` clashes: one to four values of `turned`, drawn
/// by the seeds from 1, are changed by 60 to 120 degrees.
template <class Call>
void turn_until_they_clash(Question& question, const std::vector<std::size_t>& turned, int count, std::size_t goal,
                           const Call& call) {
  for (std::uint64_t seed = 1; count > 0; ++seed) {
    SampleStream stream(seed, 0);
    std::vector<double> q = question.reference();
    for (std::size_t turn = 0; turn < 1 + seed % 4; ++turn) {
      const std::size_t k = turned[static_cast<std::size_t>(stream.uniform() * static_cast<double>(turned.size()))];
      q[k] += (stream.uniform() < 0.5 ? -1.0 : 1.0) * (60.0 + 60.0 * stream.uniform()) * degree;
    }
    const std::size_t before = question.by_brute_force(q).pairs.size();
    if (before <= goal) continue;
    --count;
    SCOPED_TRACE("seed " + std::to_string(seed));
    call(q, before);
  }
}

TEST(Relax, MendsTurnedSideChains) {
  const int times = std::getenv("HINGE_TEST_ALL") != nullptr ? 20 : 1;
  for (const std::string file : {"1ubq", "5pti.pdb", "1crn.pdb", "1l2y.pdb", "2src.pdb", "4hhb.pdb"}) {
    SCOPED_TRACE(file);
    Question question(structure_of(file), "chi");
    const std::size_t goal = question.by_brute_force(question.reference()).pairs.size();
    int mended = 0;
    turn_until_they_clash(question, test::side_chains(*question.checker), 5 * times, goal,
                          [&](const auto& q, std::size_t before) {
                            const Relaxation relaxed = relax(*question.checker, q, question.how);
                            EXPECT_EQ(relaxed.collisions_before, before);
                            EXPECT_EQ(relaxed.collisions, question.by_brute_force(relaxed.q).pairs.size());
                            if (relaxed.collisions <= goal) ++mended;
                            EXPECT_LE(relaxed.collisions, before);
                          });
    EXPECT_GE(mended, 0.9 * 5 * times);
  }
}

// Backbone torsions that compensate each other move few atoms, although each of them alone would move many.
TEST(Relax, MovesAtomsByLessThanHalfAnAngstromIfTheBackboneMayTurn) {
  const int times = std::getenv("HINGE_TEST_ALL") != nullptr ? 10 : 1;
  int tried = 0, moved_little = 0;
  for (const std::string file : {"1ubq", "5pti.pdb", "1crn.pdb", "1l2y.pdb", "2src.pdb", "4hhb.pdb"}) {
    SCOPED_TRACE(file);
    Question question(structure_of(file), "all");
    const std::size_t goal = question.by_brute_force(question.reference()).pairs.size();
    const int count = times * (question.molecule->structure().atoms.size() < 1000 ? 5 : 2);
    turn_until_they_clash(question, test::side_chains(*question.checker), count, goal, [&](const auto& q, std::size_t) {
      ++tried;
      const Relaxation relaxed = relax(*question.checker, q, question.how);
      const std::size_t left = question.by_brute_force(relaxed.q).pairs.size();
      EXPECT_EQ(relaxed.collisions, left);
      if (left <= goal && question.moved(q, relaxed.q) < 0.5) ++moved_little;
    });
  }
  EXPECT_GE(moved_little, 0.9 * tried) << tried;
}

TEST(Relax, MovesLittleWhereLittleIsNeeded) {
  Question question(structure_of("1ubq"), "chi");
  const Relaxation relaxed = relax(*question.checker, question.reference());
  EXPECT_EQ(relaxed.collisions_before, 1U);
  EXPECT_EQ(relaxed.collisions, 0U);
  EXPECT_EQ(relaxed.restarts, 0U);
  for (std::size_t k = 0; k < relaxed.q.size(); ++k) {
    const std::size_t torsion = question.molecule->torsion_of(question.checker->selection().dofs()[k]);
    EXPECT_TRUE(relaxed.q[k] == 0.0 || question.molecule->torsions()[torsion].residue == 71) << k;  // ARG72
  }
  EXPECT_LT(question.moved(question.reference(), relaxed.q), 0.3);
  // A file with three decimals is free, too.
  question.checker->check(relaxed.q, Mode{});
  std::vector<Vec3> rounded = question.checker->positions();
  for (Vec3& x : rounded)
    for (double& value : x) value = std::round(value * 1000.0) / 1000.0;
  EXPECT_FALSE(question.checker->check_coordinates(rounded, Mode{}).collides);
}

TEST(Relax, KeepsCyclesClosed) {
  struct Case {
    std::string file, free, loop;
    double sigma;
  };
  for (const Case& c : {Case{"1ubq", "chi", "A:7-11", 0.0}, Case{"5pti.pdb", "A:12-40", "", 0.06}}) {
    SCOPED_TRACE(c.file);
    Question question(structure_of(c.file), c.free, "simd", c.loop);
    ASSERT_FALSE(question.how.closures.empty());
    ClosureSolver solver(question.molecule->model().tree(), question.checker->selection(), question.how.closures);
    std::vector<double> q = random_turns(*question.checker, c.sigma, 3);
    if (c.sigma == 0.0)  // turn a side chain beside the loop instead
      for (std::size_t k = 0; k < q.size(); ++k)
        if (question.molecule->torsions()[question.molecule->torsion_of(question.checker->selection().dofs()[k])]
                .name == "chi1")
          q[k] = 90.0 * degree;
    ASSERT_TRUE(solver.close(q));
    const Relaxation relaxed = relax(*question.checker, q, question.how);
    EXPECT_GT(relaxed.collisions_before, 0U);
    EXPECT_LT(relaxed.collisions, relaxed.collisions_before);
    const Verdict verdict = question.by_brute_force(relaxed.q);
    EXPECT_EQ(verdict.pairs.size(), relaxed.collisions);
    for (const std::size_t closure : question.how.closures) EXPECT_LT(verdict.closure_residuals[closure], 1e-8);
  }
}

TEST(Relax, MovesAPlacedLigandOutOfItsPocketWall) {
  ReadOptions read;
  read.hetero = true;
  Question question(read_structure(test::molecule_file("1hpx.pdb"), read), "KNI", "simd", "", "KNI");
  std::vector<double> q = question.reference();
  const PlacedPart& part = question.molecule->placed_parts().front();
  for (std::size_t k = 0; k < q.size(); ++k)
    if (question.checker->selection().dofs()[k] == part.dofs[1]) q[k] = 1.0;  // angstrom
  const Relaxation relaxed = relax(*question.checker, q, question.how);
  EXPECT_GT(relaxed.collisions_before, 1U);
  EXPECT_EQ(relaxed.collisions, 0U);
  EXPECT_TRUE(question.by_brute_force(relaxed.q).pairs.empty());
  EXPECT_LT(question.moved(q, relaxed.q), 1.5);
}

TEST(Relax, LeavesTheStartWhereNothingCanBeDone) {
  Question free(structure_of("1ubq"), "A:1-10 and chi");
  const Relaxation nothing = relax(*free.checker, free.reference());
  EXPECT_EQ(nothing.q, free.reference());
  EXPECT_EQ(nothing.collisions_before, 0U);
  EXPECT_EQ(nothing.restarts, 0U);

  // With radii twice as large, every conformation collides in many pairs.
  const Structure structure = structure_of("1ubq");
  const auto molecule = std::make_shared<const Molecule>(structure);
  CheckOptions large;
  large.thresholds.rules = "biocd";
  large.thresholds.rho = 2.0;
  const Checker hopeless(molecule, molecule->select(select_torsions(*molecule, "A:20-30 and chi", false)), large);
  RelaxOptions few;
  few.most_restarts = 5;
  const std::vector<double> start(hopeless.dof_count(), 0.0);
  const Relaxation tried = relax(hopeless, start, few);
  EXPECT_EQ(tried.restarts, 5U);
  EXPECT_GT(tried.collisions, 0U);
  EXPECT_LE(tried.collisions, tried.collisions_before);
  EXPECT_TRUE(tried.collisions < tried.collisions_before || tried.energy < tried.energy_before || tried.q == start);
  EXPECT_EQ(relax(hopeless, start, few).q, tried.q);  // depends on the arguments alone

  int calls = 0;
  const Relaxation stopped = relax(hopeless, start, {}, [&] { return ++calls == 3; });
  EXPECT_TRUE(stopped.stopped);
  EXPECT_EQ(calls, 3);
  EXPECT_LE(stopped.collisions, stopped.collisions_before);
  EXPECT_THROW(relax(hopeless, start, {}, []() -> bool { throw std::runtime_error("stop"); }), std::runtime_error);
  // The first exception counts, however often the optimiser still asks.
  calls = 0;
  const auto throws = [&]() -> bool { throw std::runtime_error("call " + std::to_string(++calls)); };
  try {
    relax(hopeless, start, {}, throws);
    FAIL() << "expected an exception";
  } catch (const std::runtime_error& error) {
    EXPECT_STREQ(error.what(), "call 1");
  }
}

TEST(Relax, RefusesBadArguments) {
  Question question(structure_of("1ubq"), "A:70-76");
  std::vector<double> q = question.reference();
  q[0] = std::nan("");
  EXPECT_THROW(relax(*question.checker, q), ConfigurationError);
  q.pop_back();
  EXPECT_THROW(relax(*question.checker, q), ConfigurationError);
  EXPECT_THROW(relax(*question.checker, question.reference(), {.closures = {7}}), ModelError);
  Question nothing(structure_of("1ubq"), "none");
  EXPECT_THROW(relax(*nothing.checker, {}), ModelError);
}

}  // namespace relax_test
}  // namespace hinge::molecular
