// SPDX-License-Identifier: BSD-3-Clause
// Tests closed conformations of molecules: loops with both ends held, disulphides, cyclic backbones, hydrogen bonds.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <memory>
#include <numbers>
#include <set>
#include <span>
#include <string>
#include <vector>

#include "hinge/core/error.hpp"
#include "hinge/molecular/bond_exclusions.hpp"
#include "hinge/molecular/checker.hpp"
#include "hinge/molecular/closed_sampler.hpp"
#include "hinge/molecular/ideal_protein.hpp"
#include "hinge/molecular/loop.hpp"
#include "hinge/molecular/molecule.hpp"
#include "hinge/molecular/selection.hpp"
#include "molecular/test_files.hpp"
#include "rules/hydrogen_bonds.hpp"

namespace hinge::molecular {
namespace loop_test {

constexpr double promised = 1e-6;  // angstrom: largest residual of a closed conformation

std::shared_ptr<const Molecule> with_loop(const Structure& s, const std::string& words) {
  MoleculeOptions options;
  options.loops = find_loops(s, words);
  return std::make_shared<const Molecule>(s, options);
}

/// Returns the largest change of a bond length, of the distance across a bond angle, or of the distance across an omega
/// (angstrom). x: coordinates that the solver did not compute.
double worst_strain(const Molecule& m, const std::vector<Vec3>& x) {
  const Structure& s = m.structure();
  const auto& y = s.models.front();
  double worst = 0.0;
  const auto keep = [&](std::uint32_t i, std::uint32_t j) {
    worst = std::max(worst, std::abs((x[i] - x[j]).norm() - (y[i] - y[j]).norm()));
  };
  const auto neighbours = bonded_neighbours(s);
  for (std::uint32_t i = 0; i < x.size(); ++i)
    for (const std::uint32_t j : neighbours[i]) {
      keep(i, j);
      for (const std::uint32_t k : neighbours[i])
        if (k != j) keep(j, k);
    }
  std::vector<std::string> ignored;
  for (const Torsion& t : find_torsions(s, ignored))
    if (t.name == "omega") keep(t.atoms[0], t.atoms[3]);
  return worst;
}

bool moves(const Molecule& m, std::uint32_t atom) {
  const Residue& residue = m.structure().residues[m.structure().atoms[atom].residue];
  const std::string& name = m.structure().atoms[atom].name;
  for (const Loop& loop : m.loops()) {
    const std::uint32_t r = m.structure().atoms[atom].residue;
    if (r < loop.first || r > loop.last) continue;
    if (r == loop.first && (name == "N" || name == "CA" || name == "H")) return false;
    if (r == loop.last && (name == "CA" || name == "C" || name == "O" || name == "OXT")) return false;
    return residue.name != "PRO" || r != loop.first || name == "C" || name == "O";
  }
  return false;
}

/// Tests samples of one loop: closed under the checker's own kinematics; all other atoms keep their exact coordinates.
void expect_closed(const Structure& s, const std::string& loop, std::uint64_t count) {
  const auto m = with_loop(s, loop);
  const auto torsions = select_loop_torsions(*m, "none", false);
  const DofSelection selection = m->select(torsions);
  Checker checker(m, selection, {});
  ClosedSampler sampler(*m, selection, {5, {}}, 200);
  std::uint64_t found = 0;
  double spread = 0.0;
  for (std::uint64_t k = 0; k < count; ++k) {
    const ClosedSample sample = sampler.sample(k);
    if (!sample.found()) continue;
    ++found;
    const Verdict verdict = checker.check(sample.q, Mode::parse("any"));
    EXPECT_LE(verdict.closure_residual, promised) << loop << " " << k;
    const std::vector<Vec3> x = checker.positions();
    EXPECT_LE(worst_strain(*m, x), promised) << loop << " " << k;
    for (std::uint32_t i = 0; i < x.size(); ++i)
      if (!moves(*m, i)) {
        ASSERT_EQ(x[i], s.models.front()[i]) << loop << " " << k << " " << label(s, i);
      } else {
        spread = std::max(spread, (x[i] - s.models.front()[i]).norm());
      }
  }
  EXPECT_EQ(found, count) << loop;
  if (torsions.size() > 8) {  // shorter loops can hardly move
    EXPECT_GT(spread, 1.0) << loop;
  }
}

std::uint64_t per_loop(std::uint64_t quick) { return std::getenv("HINGE_TEST_ALL") != nullptr ? 10 * quick : quick; }

TEST(Loops, CloseInIdealProteinsAtEveryLength) {
  const std::string sequence = "MKTAYIAKQRGISFPVKSHFSRDLEERLGLIEVQ";
  const std::string elements = "CCCHHHHHHHCCCCEEEECCCHHHHHHHHCCCCC";
  const Structure s = build_ideal_protein(sequence, elements);
  for (int length = 3; length <= 20; ++length) {
    std::string loop = "A:6-";
    loop += std::to_string(5 + length);
    expect_closed(s, loop, per_loop(45));
  }
}

TEST(Loops, CloseInUbiquitinAlsoWithProlinesAndTwoAtATime) {
  const Structure s = read_structure(test::ubiquitin());
  for (const char* loop :
       {"A:7-11", "A:17-24", "A:34-41", "A:37-42", "A:19-22", "A:45-64", "A:8-11,A:45-50", "A:2-4,A:5-8"})
    expect_closed(s, loop, per_loop(25));
}

TEST(Loops, CloseInMyoglobin) {
  const auto file = test::molecule_file("paper/1mbn.pdb");
  const Structure s = read_structure(file);
  for (const char* loop : {"A:40-52", "A:78-86", "_:40-52"}) {
    if (s.chains.front().name.empty() != (loop[0] == '_')) continue;
    expect_closed(s, loop, per_loop(25));
  }
}

TEST(Loops, AreAFunctionOfSeedAndIndexAndJudgedAsByBruteForce) {
  const Structure s = read_structure(test::ubiquitin());
  const auto m = with_loop(s, "A:7-11");
  const DofSelection selection = m->select(select_loop_torsions(*m, "A:7-11:chi", false));
  CheckOptions brute_rules;
  brute_rules.engine = "brute";
  Checker simd(m, selection, {}), brute(m, selection, brute_rules);
  const Sampling near{9, 0.3};
  ClosedSampler forward(*m, selection, near, 100), other(*m, selection, near, 100);
  for (std::uint64_t k = 50; k-- > 0;) other.sample(k);
  int colliding = 0;
  for (std::uint64_t k = 0; k < 50; ++k) {
    const ClosedSample sample = forward.sample(k);
    ASSERT_TRUE(sample.found());
    EXPECT_EQ(sample.q, other.sample(k).q);
    const Verdict a = simd.check(sample.q, Mode::parse("all")), b = brute.check(sample.q, Mode::parse("all"));
    EXPECT_EQ(a.pairs, b.pairs);
    EXPECT_EQ(a.closure_residuals, b.closure_residuals);
    colliding += a.collides ? 1 : 0;
  }
  EXPECT_GT(colliding, 0);
  EXPECT_LT(colliding, 50);
}

TEST(Loops, SpreadOverTheTorsionsThatTheirEndsLeave) {
  const Structure s = read_structure(test::ubiquitin());
  const auto m = with_loop(s, "A:34-41");
  const DofSelection selection = m->select(select_loop_torsions(*m, "none", false));
  ClosedSampler sampler(*m, selection, {1, {}}, 100);
  // Each torsion visits at least nine of twelve sectors of 30 degrees.
  std::vector<std::set<int>> sectors(selection.size());
  for (std::uint64_t k = 0; k < 300; ++k) {
    const ClosedSample sample = sampler.sample(k);
    for (std::size_t d = 0; d < sample.q.size(); ++d)
      sectors[d].insert(static_cast<int>(std::floor(sample.q[d] / std::numbers::pi * 6.0)));
  }
  for (const auto& visited : sectors) EXPECT_GE(visited.size(), 9U);
}

TEST(Loops, OfSixTurnsJumpBetweenIsolatedConformations) {
  const Structure s = read_structure(test::ubiquitin());
  const auto m = with_loop(s, "A:60-62");
  const auto torsions = select_loop_torsions(*m, "none", false);
  ASSERT_EQ(torsions.size(), 5U);
  EXPECT_EQ(find_held_torsions(*m, torsions), torsions);
  ClosedSampler sampler(*m, m->select(torsions), {1, {}}, 100);
  std::vector<std::vector<double>> found;
  for (std::uint64_t k = 0; k < 300; ++k) {
    const std::vector<double> q = sampler.sample(k).q;
    const bool known = std::any_of(found.begin(), found.end(), [&](const std::vector<double>& other) {
      double apart = 0.0;
      for (std::size_t d = 0; d < q.size(); ++d)
        apart = std::max(apart, std::abs(std::remainder(q[d] - other[d], 2 * std::numbers::pi)));
      return apart < 1e-4;
    });
    if (!known) found.push_back(q);
  }
  EXPECT_GE(found.size(), 2U);   // the reference and at least one more solution
  EXPECT_LE(found.size(), 16U);  // degree of the polynomial (Coutsias et al. 2004)
}

TEST(Loops, RefuseWhatCannotBeOne) {
  const Structure s = read_structure(test::ubiquitin());
  for (const char* words : {"", "A", "A:40", "A:40-39", "A:40-52:chi", "B:1-5", "A:70-80", "A:1-8", "A:70-76",
                            "A:10-15,A:15-20", "A:10-15,", "A:10-15;A:20-25"})
    if (std::string(words) == "A:40") {
      const auto m = with_loop(s, words);  // one residue: its two torsions move nothing
      EXPECT_THROW(select_loop_torsions(*m, "none", false), ModelError);
    } else {
      EXPECT_THROW(find_loops(s, words), ModelError) << words;
    }
  const auto m = with_loop(s, "A:36-38");  // two prolines leave four torsions
  EXPECT_THROW(select_loop_torsions(*m, "none", false), ModelError);
  const auto fine = with_loop(s, "A:40-45");
  EXPECT_THROW(select_loop_torsions(*fine, "A:50", false), ModelError);
  EXPECT_THROW(select_loop_torsions(*fine, "A:41:phi", false), ModelError);
  EXPECT_EQ(select_loop_torsions(*fine, "A:41:chi", false).size(),
            select_loop_torsions(*fine, "none", false).size() + 3);  // three chi of glutamine
  Structure broken = s;                                              // with a gap in the middle
  std::erase_if(broken.bonds, [&](const Bond& bond) {
    return bond.origin == BondOrigin::peptide &&
           broken.residues[broken.atoms[bond.second].residue].sequence_number == 43;
  });
  EXPECT_THROW(find_loops(broken, "A:40-45"), ModelError);
  EXPECT_THROW(find_loops(broken, "A:36-42"), ModelError);
  EXPECT_NO_THROW(find_loops(broken, "A:44-49"));
}

/// Tests that samples keep bond lengths and angles if all cycles are closed, and change them if cycles are open.
void expect_kept(const Structure& s, const MoleculeOptions& options, const Sampling& sampling, std::uint64_t count) {
  auto m = std::make_shared<const Molecule>(s, options);
  ASSERT_FALSE(m->model().tree().closures().empty());
  auto torsions = select_torsions(*m, "all", false);
  const auto held = find_held_torsions(*m, torsions);
  std::erase_if(torsions, [&](std::size_t k) { return std::binary_search(held.begin(), held.end(), k); });
  const DofSelection selection = m->select(torsions);
  Checker checker(m, selection, {});
  ClosedSampler sampler(*m, selection, sampling, 20);
  for (std::uint64_t k = 0; k < count; ++k) {
    const auto start = sample_configuration(sampling, k, selection.size());
    const Verdict open = checker.check(start, Mode::parse("any"));
    EXPECT_EQ(open.closure_residuals.size(), m->model().tree().closures().size());
    EXPECT_EQ(open.closure_residual, *std::max_element(open.closure_residuals.begin(), open.closure_residuals.end()));
    EXPECT_GT(open.closure_residual, 1e-3);
    const ClosedSample sample = sampler.sample(k);
    ASSERT_TRUE(sample.found()) << k;
    EXPECT_LE(checker.check(sample.q, Mode::parse("any")).closure_residual, promised);
    EXPECT_LE(worst_strain(*m, checker.positions()), promised) << k;
  }
}

TEST(Closures, OfDisulphidesAreKept) {
  for (const char* name : {"5pti.pdb", "1crn.pdb"}) {
    const auto file = test::molecule_file(name);
    if (!std::filesystem::exists(file)) GTEST_SKIP() << "shared data not found";
    const Structure s = read_structure(file);
    expect_kept(s, {}, {1, {}}, 10);
    expect_kept(s, {}, {2, 0.1}, 10);
  }
}

TEST(Closures, OfACyclicBackboneAreKeptWithItsOmega) {
  const auto file = test::molecule_file("1sfi.cif");
  expect_kept(read_structure(file), {}, {1, {}}, 5);
}

TEST(Loops, CloseWithinACyclicBackbone) {
  const auto file = test::molecule_file("1sfi.cif");
  const Structure s = read_structure(file);
  for (const char* loop : {"I:4-8", "I:5-10"}) expect_closed(s, loop, per_loop(10));
}

TEST(Closures, LeaveADisulphideThatALoopHolds) {
  const auto file = test::molecule_file("5pti.pdb");
  const Structure s = read_structure(file);
  const auto m = with_loop(s, "A:12-19");  // contains Cys 14, bonded to Cys 38
  EXPECT_EQ(m->model().tree().closures().size(), 4U);
  const DofSelection selection = m->select(select_loop_torsions(*m, "A:14:chi1", false));
  Checker checker(m, selection, {});
  ClosedSampler sampler(*m, selection, {1, {}}, 300);
  for (std::uint64_t k = 0; k < 10; ++k) {
    const ClosedSample sample = sampler.sample(k);
    ASSERT_TRUE(sample.found());
    checker.check(sample.q, Mode::parse("any"));
    const std::vector<Vec3> x = checker.positions();
    EXPECT_LE(worst_strain(*m, x), promised);
    for (std::uint32_t i = 0; i < x.size(); ++i)
      if (!moves(*m, i)) {
        EXPECT_EQ(x[i], s.models.front()[i]) << label(s, i);
      }
  }
}

TEST(HydrogenBonds, OfAnIdealHelixJoinEachFourthResidue) {
  const Structure s = build_ideal_protein("AAAAAAAAAAAA", "HHHHHHHHHHHH");
  const auto bonds = find_hydrogen_bonds(s);
  ASSERT_EQ(bonds.size(), 8U);
  for (const HydrogenBond& bond : bonds) {
    EXPECT_EQ(s.atoms[bond.nitrogen].residue, s.atoms[bond.oxygen].residue + 4);
    EXPECT_EQ(s.atoms[bond.nitrogen].name, "N");
    EXPECT_EQ(s.atoms[bond.oxygen].name, "O");
    EXPECT_LT(bond.energy, -0.5);
  }
  EXPECT_TRUE(find_hydrogen_bonds(build_ideal_protein("AAAAAAAAAAAA", "EEEEEEEEEEEE")).empty());
}

TEST(HydrogenBonds, AreTheSheetAndTheHelixOfUbiquitin) {
  const Structure s = read_structure(test::ubiquitin());
  std::set<std::pair<int, int>> pairs;  // sequence numbers of N-H and C=O
  for (const HydrogenBond& bond : find_hydrogen_bonds(s))
    pairs.emplace(s.residues[s.atoms[bond.nitrogen].residue].sequence_number,
                  s.residues[s.atoms[bond.oxygen].residue].sequence_number);
  for (const auto& known : {std::pair(3, 15), std::pair(15, 3), std::pair(5, 13), std::pair(13, 5), std::pair(27, 23),
                            std::pair(30, 26), std::pair(44, 68), std::pair(68, 44), std::pair(67, 4)})
    EXPECT_TRUE(pairs.contains(known)) << known.first << " " << known.second;
  for (const auto& pair : pairs) EXPECT_NE(pair.first, 37);  // proline has no N-H
}

TEST(HydrogenBonds, AreKeptOnRequestAndHoldAHelix) {
  const Structure s = read_structure(test::ubiquitin());
  expect_kept(s, {{}, true}, {1, 0.01}, 2);
  const Structure helix = build_ideal_protein("AAAAAAAAAAAA", "HHHHHHHHHHHH");
  const Molecule m(helix, {{}, true});
  std::set<std::uint32_t> held;
  for (const std::size_t k : find_held_torsions(m, select_torsions(m, "backbone", false)))
    held.insert(m.torsions()[k].residue);
  for (std::uint32_t r = 2; r < 10; ++r) EXPECT_TRUE(held.contains(r)) << r;
  EXPECT_FALSE(held.contains(11));
}

}  // namespace loop_test
}  // namespace hinge::molecular
