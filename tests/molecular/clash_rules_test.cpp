// SPDX-License-Identifier: BSD-3-Clause
// Tests the named rules: their constants, their bounds to the last decimal, and equal verdicts of every engine.
#include "hinge/molecular/clash_rules.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "hinge/core/error.hpp"
#include "hinge/molecular/checker.hpp"
#include "hinge/molecular/sampler.hpp"
#include "hinge/molecular/selection.hpp"
#include "hinge/molecular/severity.hpp"
#include "molecular/test_files.hpp"
#include "rules/hydrogen_bonds.hpp"

namespace hinge::molecular {
namespace clash_rules_test {

CheckOptions by(const char* rules) {
  CheckOptions options;
  options.thresholds.rules = rules;
  return options;
}

/// Returns the ATOM record of an atom of residue 1 of a chain, at (x, y, 0).
std::string atom(int serial, const char* name, const char* residue, char chain, double x, double y,
                 const char* element) {
  std::array<char, 100> line{};
  std::snprintf(line.data(), line.size(), "ATOM  %5d %-4s %3s %c   1    %8.3f%8.3f%8.3f  1.00  0.00          %2s\n",
                serial, name, residue, chain, x, y, 0.0, element);
  return line.data();
}

std::shared_ptr<const Molecule> molecule_of(const std::string& text) {
  const test::TemporaryFile file(text + "END\n");
  return std::make_shared<const Molecule>(read_structure(file.path()));
}

/// Two methyl carbons in chains A and B, `apart` angstrom apart.
std::shared_ptr<const Molecule> two_carbons(double apart) {
  return molecule_of(atom(1, " CB", "ALA", 'A', 0, 0, "C") + atom(2, " CB", "ALA", 'B', apart, 0, "C"));
}

struct Answer {
  bool collides;
  Severity severity;
};

/// Returns the verdict and severity of the pair of the first and the last atom.
Answer ends(const std::shared_ptr<const Molecule>& molecule, const char* rules) {
  Checker checker(molecule, molecule->select({}), by(rules));
  const Verdict verdict = checker.check_coordinates(molecule->structure().models.front(), Mode::parse("within:10"));
  for (const Contact& pair : verdict.pairs)
    if (index(pair.hit.first) == 0 && index(pair.hit.second) + 1 == molecule->structure().atoms.size())
      return {pair.collides, severity_of(checker.thresholds(), pair.hit, pair.collides)};
  ADD_FAILURE() << "no such pair";
  return {};
}

TEST(ClashRules, RefusesUnknownNamesAndWhatTheyFix) {
  try {
    clash_rules("whatcheck");
    FAIL();
  } catch (const ModelError& error) {
    EXPECT_STREQ(error.what(),
                 "clash rules 'whatcheck': expected one of biocd, severe, molprobity, chimerax, posebusters");
  }
  const auto molecule = two_carbons(3.0);
  const auto make = [&](const CheckOptions& options) { Checker(molecule, molecule->select({}), options); };
  CheckOptions options = by("molprobity");
  EXPECT_NO_THROW(make(options));
  options.min_bonds = 4;
  EXPECT_THROW(make(options), ModelError);
  options = by("chimerax");
  options.thresholds.rho = 0.9;
  EXPECT_THROW(make(options), ModelError);
  options = by("posebusters");
  options.thresholds.radii = "amber";
  EXPECT_THROW(make(options), ModelError);
  options = by("molprobity");
  options.thresholds.hydrogen_bonds = false;
  EXPECT_THROW(make(options), ModelError);
}

TEST(ClashRules, NameTheRadiiTheyUse) {
  EXPECT_EQ(clash_rules("molprobity").radii, "probe");
  EXPECT_EQ(clash_rules("molprobity").radii_version, radii_set("probe").version);
}

TEST(ClashRules, DecideTiesInDecimalsAsTheProgramsDo) {
  // MolProbity and ChimeraX include their cutoff; PoseBusters does not.
  EXPECT_TRUE(ends(two_carbons(3.000), "molprobity").collides);  // 2 * 1.70 - 0.4
  EXPECT_FALSE(ends(two_carbons(3.001), "molprobity").collides);
  EXPECT_TRUE(ends(two_carbons(2.500), "severe").collides);  // 2 * 1.70 - 0.9
  EXPECT_FALSE(ends(two_carbons(2.501), "severe").collides);
  EXPECT_TRUE(ends(two_carbons(3.160), "chimerax").collides);  // 2 * 1.88 - 0.6
  EXPECT_FALSE(ends(two_carbons(3.161), "chimerax").collides);
  EXPECT_TRUE(ends(two_carbons(2.549), "posebusters").collides);  // 0.75 * 3.40
  EXPECT_FALSE(ends(two_carbons(2.550), "posebusters").collides);
}

TEST(ClashRules, SaySeverityAndClass) {
  const auto expect = [](double apart, const char* rules, double overlap, const char* kind) {
    const Answer answer = ends(two_carbons(apart), rules);
    EXPECT_NEAR(answer.severity.overlap, overlap, 1e-12) << rules << ' ' << apart;
    EXPECT_EQ(answer.severity.kind, kind) << rules << ' ' << apart;
    EXPECT_EQ(answer.severity.relative_distance.has_value(), std::string(rules) == "posebusters");
  };
  expect(2.500, "biocd", 0.900, "");
  expect(2.500, "severe", 0.900, "");
  expect(2.500, "molprobity", 0.900, "clash");
  expect(3.001, "molprobity", 0.399, "small_overlap");
  expect(3.400, "molprobity", 0.000, "small_overlap");
  expect(3.401, "molprobity", -0.001, "close_contact");
  expect(3.650, "molprobity", -0.250, "close_contact");
  expect(3.651, "molprobity", -0.251, "wide_contact");
  expect(3.901, "molprobity", -0.501, "apart");
  expect(3.000, "chimerax", 0.760, "clash");
  expect(4.160, "chimerax", -0.400, "contact");
  expect(4.161, "chimerax", -0.401, "apart");
  expect(2.500, "posebusters", 0.900, "clash");
  expect(2.550, "posebusters", 0.850, "apart");
  EXPECT_DOUBLE_EQ(*ends(two_carbons(2.55), "posebusters").severity.relative_distance, 0.75);
  EXPECT_DOUBLE_EQ(clashscore(3, 2000), 1.5);
  EXPECT_EQ(clashscore(0, 0), 0.0);
}

/// A serine whose hydroxyl points at an oxygen of another chain. HG is the first atom, that oxygen the last; `apart` is
/// their distance (angstrom).
std::shared_ptr<const Molecule> hydroxyl_and(const char* residue, const char* oxygen, double apart) {
  return molecule_of(atom(1, " HG", "SER", 'A', 0, 0, "H") + atom(2, " OG", "SER", 'A', -0.96, 0, "O") +
                     atom(3, " CB", "SER", 'A', -1.5, 1.3, "C") + atom(4, oxygen, residue, 'B', apart, 0, "O"));
}

TEST(ClashRules, AllowHydrogenBonds) {
  // 1.05 + 1.40 = 2.45. Probe allows hydrogen and acceptor to overlap by 0.6, and counts only the overlap beyond.
  EXPECT_EQ(ends(hydroxyl_and("ALA", " O", 1.851), "molprobity").severity.kind, "hydrogen_bond");
  EXPECT_EQ(ends(hydroxyl_and("ALA", " O", 1.850), "molprobity").severity.kind, "hydrogen_bond");
  EXPECT_EQ(ends(hydroxyl_and("ALA", " O", 1.849), "molprobity").severity.kind, "small_overlap");
  EXPECT_EQ(ends(hydroxyl_and("ALA", " O", 1.451), "molprobity").severity.kind, "small_overlap");
  EXPECT_EQ(ends(hydroxyl_and("ALA", " O", 1.450), "molprobity").severity.kind, "clash");
  EXPECT_NEAR(ends(hydroxyl_and("ALA", " O", 1.450), "molprobity").severity.overlap, 0.4, 1e-12);
  EXPECT_EQ(ends(hydroxyl_and("ALA", " O", 2.451), "molprobity").severity.kind, "close_contact");
  // PoseBusters ignores hydrogens.
  const Answer ignored = ends(hydroxyl_and("ALA", " O", 0.500), "posebusters");
  EXPECT_FALSE(ignored.collides);
  EXPECT_EQ(ignored.severity.kind, "ignored");
  EXPECT_FALSE(ignored.severity.relative_distance.has_value());
}

const Structure& ubiquitin() {
  static const Structure structure = read_structure(test::ubiquitin());
  return structure;
}

std::uint32_t find(const Structure& s, const std::string& wanted) {
  for (std::uint32_t i = 0; i < s.atoms.size(); ++i)
    if (label(s, i) == wanted) return i;
  ADD_FAILURE() << "no atom " << wanted;
  return 0;
}

TEST(AtomClasses, AreTheSameWhereAMetalIsBound) {
  // The carboxylate of a glutamate and a carbonyl bind the same sodium.
  const std::string text = atom(1, " CA", "ALA", 'A', -0.76, 1.32, "C") + atom(2, " C", "ALA", 'A', 0, 0, "C") +
                           atom(3, " O", "ALA", 'A', 1.23, 0, "O") + atom(4, " CG", "GLU", 'B', 7.0, 3.5, "C") +
                           atom(5, " CD", "GLU", 'B', 6.0, 2.4, "C") + atom(6, " OE1", "GLU", 'B', 4.8, 2.1, "O") +
                           atom(7, " OE2", "GLU", 'B', 6.6, 1.3, "O");
  const std::string sodium =
      "HETATM    8 NA    NA C   1       2.430   2.078   0.000  1.00  0.00          NA\n"
      "CONECT    8    3    6\n";
  const auto types = [](const std::string& records, const char* rules) {
    const test::TemporaryFile file(records + "END\n");
    ReadOptions options;
    options.hetero = true;
    const Structure s = read_structure(file.path(), options);
    const Thresholds t = make_thresholds(s, by(rules).thresholds);
    std::string names;
    for (std::uint32_t i = 0; i < 7; ++i) names += t.type_names[t.matrix.type(id<PrimitiveId>(i))] + ' ';
    return std::pair(names, s.bonds.size());
  };
  for (const char* rules : {"molprobity", "severe", "biocd"}) {
    const auto [alone, bonds] = types(text, rules);
    const auto [bound, more] = types(text + sodium, rules);
    EXPECT_EQ(more, bonds + 2) << "the sodium is bonded to both";
    EXPECT_EQ(bound, alone) << rules;
  }
  EXPECT_NE(types(text + sodium, "molprobity").first.find("C.carbonyl"), std::string::npos);
}

TEST(HydrogenBondRoles, AreKnownWithoutHydrogens) {
  const Structure& s = ubiquitin();
  const auto roles = hydrogen_bond_roles(s);
  const auto expect = [&](const char* atom, bool donor, bool acceptor) {
    const HydrogenBondRole role = roles[find(s, atom)];
    EXPECT_EQ(role.donor, donor) << atom;
    EXPECT_EQ(role.acceptor, acceptor) << atom;
  };
  expect("A:GLN2:N", true, false);
  expect("A:GLN2:O", false, true);
  expect("A:GLN2:NE2", true, false);
  expect("A:GLN2:CA", false, false);
  expect("A:PRO19:N", false, false);
  expect("A:LYS6:NZ", true, false);
  expect("A:ARG42:NE", true, false);
  expect("A:THR7:OG1", true, true);
  expect("A:TYR59:OH", true, true);
  expect("A:ASP21:OD1", false, true);
  expect("A:MET1:SD", false, true);
  expect("A:HIS68:ND1", true, false);  // ND1 donates and NE2 accepts, as in ChimeraX
  expect("A:HIS68:NE2", false, true);
  expect("A:GLY76:OXT", false, true);
}

TEST(ClashRules, ChimeraxRadiiAndAllowanceWithoutHydrogens) {
  const Structure& s = ubiquitin();
  ThresholdOptions options;
  options.rules = "chimerax";
  const Thresholds t = make_thresholds(s, options);
  const auto contact = [&](const char* a, const char* b) {
    const auto type = [&](const char* atom) { return t.matrix.type(id<PrimitiveId>(find(s, atom))); };
    return t.contact[type(a) * t.type_names.size() + type(b)];
  };
  EXPECT_DOUBLE_EQ(contact("A:ILE3:CA", "A:ILE13:CA"), 3.76);
  EXPECT_DOUBLE_EQ(contact("A:ILE3:C", "A:ILE13:C"), 3.22);
  EXPECT_DOUBLE_EQ(contact("A:ILE3:CA", "A:PHE4:CZ"), 1.88 + 1.76);
  EXPECT_DOUBLE_EQ(contact("A:ILE3:CA", "A:PHE4:CG"), 1.88 + 1.61);
  EXPECT_DOUBLE_EQ(contact("A:ILE3:CA", "A:ASP21:CG"), 3.76);
  EXPECT_DOUBLE_EQ(contact("A:ILE3:N", "A:ILE13:O"), 2.66);    // 1.64 + 1.42 - 0.4
  EXPECT_DOUBLE_EQ(contact("A:PRO19:N", "A:ILE13:O"), 3.06);   // proline: no hydrogen to donate
  EXPECT_DOUBLE_EQ(contact("A:THR7:OG1", "A:ILE13:O"), 2.48);  // 1.46 + 1.42 - 0.4
  EXPECT_DOUBLE_EQ(contact("A:ILE3:O", "A:ILE13:O"), 2.84);
  EXPECT_DOUBLE_EQ(contact("A:MET1:SD", "A:ILE13:CA"), 3.65);
}

TEST(ClashRules, BiocdLowersThresholdsOfHeavyDonorsWhenAsked) {
  const Structure& s = ubiquitin();
  ThresholdOptions options;
  const auto threshold = [&](const char* a, const char* b) {
    return make_thresholds(s, options).matrix.threshold(id<PrimitiveId>(find(s, a)), id<PrimitiveId>(find(s, b)));
  };
  EXPECT_DOUBLE_EQ(threshold("A:ILE3:N", "A:ILE13:O"), 0.8 * (1.55 + 1.52));
  options.hydrogen_bonds = true;
  EXPECT_DOUBLE_EQ(threshold("A:ILE3:N", "A:ILE13:O"), 0.8 * (1.55 + 1.52) - 0.4);
  EXPECT_DOUBLE_EQ(threshold("A:PRO19:N", "A:ILE13:O"), 0.8 * (1.55 + 1.52));
  EXPECT_DOUBLE_EQ(threshold("A:ILE3:CA", "A:ILE13:O"), 0.8 * (1.70 + 1.52));
}

/// Returns the number of bonds between any two atoms; 9 if there are more than 4.
std::vector<std::vector<int>> bonds_between(const Structure& s) {
  const std::size_t n = s.atoms.size();
  std::vector<std::vector<int>> bonds(n, std::vector<int>(n, 9));
  for (std::size_t i = 0; i < n; ++i) bonds[i][i] = 0;
  for (int length = 1; length <= 4; ++length)
    for (std::size_t i = 0; i < n; ++i)
      for (const Bond& bond : s.bonds)
        for (const auto& [from, to] : {std::pair(bond.first, bond.second), std::pair(bond.second, bond.first)})
          if (bonds[i][from] == length - 1) bonds[i][to] = std::min(bonds[i][to], length);
  return bonds;
}

using Pairs = std::set<std::pair<std::uint32_t, std::uint32_t>>;

/// Returns the clashes by definition: tests every pair, without an engine or a list of exclusions.
Pairs by_definition(const Structure& s, const std::vector<std::vector<int>>& bonds, const Thresholds& t,
                    const std::vector<Vec3>& x) {
  const std::string rules(t.rules->name);
  Pairs clashes;
  for (std::uint32_t i = 0; i < s.atoms.size(); ++i)
    for (std::uint32_t j = i + 1; j < s.atoms.size(); ++j) {
      const std::size_t pair =
          t.matrix.type(id<PrimitiveId>(i)) * t.type_names.size() + t.matrix.type(id<PrimitiveId>(j));
      const double d = (x[i] - x[j]).norm(), overlap = t.contact[pair] - d;
      const bool hydrogen = s.atoms[i].element == "H" || s.atoms[j].element == "H";
      bool clash = false;
      if (rules == "severe") clash = overlap >= 0.9 - 1e-9 && bonds[i][j] > (hydrogen ? 4 : 3);
      if (rules == "molprobity") clash = overlap >= 0.4 - 1e-9 && bonds[i][j] > (hydrogen ? 4 : 3);
      if (rules == "chimerax")
        clash = overlap >= 0.6 - 1e-9 && bonds[i][j] > 4 && s.atoms[i].residue != s.atoms[j].residue;
      if (rules == "posebusters") clash = !hydrogen && d / t.contact[pair] < 0.75 && bonds[i][j] > 3;
      if (clash) clashes.emplace(i, j);
    }
  return clashes;
}

void expect_definition(const std::shared_ptr<const Molecule>& molecule, const char* rules) {
  constexpr std::uint64_t seed = 11;
  const Structure& s = molecule->structure();
  const auto bonds = bonds_between(s);
  const auto selection = molecule->select(select_torsions(*molecule, "every:8", false));
  for (const char* engine : {"simd", "lazy", "brute"}) {
    CheckOptions options = by(rules);
    options.engine = engine;
    Checker checker(molecule, selection, options);
    const Thresholds& t = checker.thresholds();
    const auto compare = [&](const Verdict& verdict, const std::vector<Vec3>& x, bool all_pairs) {
      Pairs expected = by_definition(s, bonds, t, x);
      if (!all_pairs) std::erase_if(expected, [&](const auto& p) { return checker.constant(p.first, p.second); });
      Pairs found;
      for (const Contact& pair : verdict.pairs) {
        const Severity severity = severity_of(t, pair.hit, pair.collides);
        if (std::string(rules) != "severe") {
          EXPECT_EQ(pair.collides, severity.kind == "clash");
        }
        if (pair.collides)
          found.emplace(static_cast<std::uint32_t>(index(pair.hit.first)),
                        static_cast<std::uint32_t>(index(pair.hit.second)));
      }
      EXPECT_EQ(found, expected) << rules << ' ' << engine;
      EXPECT_EQ(verdict.collides, !expected.empty());
      return found.size();
    };
    const Mode mode = Mode::parse("within:0.3");
    std::size_t clashes = compare(checker.check_coordinates(s.models.front(), mode), s.models.front(), true);
    for (std::uint64_t k = 0; k < 2; ++k) {
      const auto q = sample_configuration({seed, {}}, k, checker.dof_count());
      const Verdict verdict = checker.check(q, mode);
      clashes += compare(verdict, checker.positions(), false);
    }
    std::printf("%s, %s, %s: seed %d, %zu clashes in three conformations\n", s.name.c_str(), rules, engine,
                static_cast<int>(seed), clashes);
  }
}

TEST(ClashRules, AreWhatEveryEngineAnswersWithoutHydrogens) {
  const auto molecule = std::make_shared<const Molecule>(ubiquitin());
  for (const char* rules : {"molprobity", "chimerax", "posebusters"}) expect_definition(molecule, rules);
}

TEST(ClashRules, AreWhatEveryEngineAnswersWithHydrogens) {
  const auto file = test::molecule_file("1l2y.pdb");
  ReadOptions first;
  first.model = 1;
  const auto molecule = std::make_shared<const Molecule>(read_structure(file, first));
  for (const char* rules : {"severe", "molprobity", "chimerax", "posebusters"}) expect_definition(molecule, rules);
}

}  // namespace clash_rules_test
}  // namespace hinge::molecular
