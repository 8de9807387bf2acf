// SPDX-License-Identifier: BSD-3-Clause
// Compares engines with brute force on real and built proteins; tests published contact counts, thresholds and
// exclusions.
#include "hinge/molecular/checker.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <limits>
#include <memory>
#include <numbers>
#include <optional>
#include <ostream>
#include <span>
#include <sstream>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "hinge/core/error.hpp"
#include "hinge/molecular/ideal_protein.hpp"
#include "hinge/molecular/sampler.hpp"
#include "hinge/molecular/selection.hpp"
#include "hinge/policy/laws.hpp"
#include "molecular/run_biocd.hpp"
#include "molecular/test_files.hpp"

namespace hinge::molecular {
namespace checker_test {

constexpr std::uint64_t seed = 1;

/// Tests `count` conformations over the full range and `count` near the reference, in four modes each.
void expect_equal_engines(const std::shared_ptr<const Molecule>& molecule, const std::string& spec, int count) {
  const auto selection = molecule->select(select_torsions(*molecule, spec, true));
  CheckOptions rules;
  rules.exempt_reference = true;
  Checker lazy(molecule, selection, rules);
  rules.engine = "brute";
  Checker brute(molecule, selection, rules);
  std::size_t colliding[2] = {0, 0};
  const Sampling samplings[2] = {{seed, {}}, {seed, std::numbers::pi / 180 * 0.2}};
  for (int s = 0; s < 2; ++s)
    for (int k = 0; k < count; ++k) {
      const auto q = sample_configuration(samplings[s], static_cast<std::uint64_t>(k), lazy.dof_count());
      for (const char* text : {"any", "all", "within:0.5", "closest"}) {
        const Mode mode = Mode::parse(text);
        const Verdict a = lazy.check(q, mode), b = brute.check(q, mode);
        ASSERT_EQ(a.collides, b.collides) << text << " sample " << k;
        ASSERT_EQ(a.pairs, b.pairs) << text << " sample " << k;
        ASSERT_EQ(a.closest, b.closest) << text << " sample " << k;
        if (mode.kind == Mode::Kind::any) colliding[s] += a.collides ? 1 : 0;
      }
      // The same coordinates, given as positions: every admitted pair counts.
      if (k % 50 != 0) continue;
      const auto positions = lazy.positions();
      const Verdict a = lazy.check_coordinates(positions, Mode::parse("all"));
      const Verdict b = brute.check_coordinates(positions, Mode::parse("all"));
      ASSERT_EQ(a.pairs, b.pairs);
    }
  std::printf("seed %d: %zu of %d random and %zu of %d near-native conformations collide\n", static_cast<int>(seed),
              colliding[0], count, colliding[1], count);
}

/// Conformations around the reference; sigma 0: at random over the full range.
std::vector<double> many_conformations(Checker& checker, double sigma, std::size_t count) {
  std::vector<double> all;
  for (std::size_t k = 0; k < count; ++k) {
    const Sampling sampling{seed, sigma > 0.0 ? std::optional(sigma) : std::nullopt};
    const auto q = sample_configuration(sampling, k, checker.dof_count());
    all.insert(all.end(), q.begin(), q.end());
  }
  return all;
}

TEST(CheckBatch, GivesTheVerdictsOfSingleChecks) {
  const auto molecule = std::make_shared<const Molecule>(read_structure(test::ubiquitin()));
  CheckOptions rules;
  rules.exempt_reference = true;
  for (const char* spec : {"all", "count:1", "count:5"})
    for (const char* engine : {"simd", "lazy"}) {
      rules.engine = engine;
      Checker checker(molecule, molecule->select(select_torsions(*molecule, spec, true)), rules), single = checker;
      for (const double degrees : {0.0, 0.02, 0.2, 2.0, 20.0}) {
        SCOPED_TRACE(std::string(spec) + ' ' + engine + ' ' + std::to_string(degrees));
        const std::size_t n = checker.dof_count();
        const std::vector<double> all = many_conformations(checker, degrees * std::numbers::pi / 180, 203);
        const std::vector<std::uint8_t> verdicts = checker.check_batch(all);
        ASSERT_EQ(verdicts.size(), 203U);
        for (std::size_t k = 0; k < verdicts.size(); ++k)
          ASSERT_EQ(verdicts[k] != 0, single.check(std::span(all).subspan(k * n, n), Mode::parse("any")).collides) << k;
        EXPECT_EQ(checker.positions(), single.positions());
      }
      EXPECT_TRUE(checker.check_batch({}).empty());
      std::vector<double> bad = many_conformations(checker, 0.001, 203);
      bad[150 * checker.dof_count()] = std::numeric_limits<double>::quiet_NaN();
      try {
        checker.check_batch(bad);
        ADD_FAILURE() << "NaN was accepted";
      } catch (const ConfigurationError& error) {
        EXPECT_EQ(std::string(error.what()).rfind("configuration 150: ", 0), 0U) << error.what();
      }
      const std::vector<double> one_too_many(2 * checker.dof_count() + 1);
      EXPECT_THROW(checker.check_batch(one_too_many), ConfigurationError);
    }
}

/// Brute force takes most of the time, so `./run test` compares fewer conformations than `./run test --all`.
int conformations() { return std::getenv("HINGE_TEST_ALL") != nullptr ? 500 : 100; }

TEST(Engines, EqualBruteForceOnUbiquitin) {
  const auto molecule = std::make_shared<const Molecule>(read_structure(test::ubiquitin()));
  expect_equal_engines(molecule, "all", conformations());
  expect_equal_engines(molecule, "count:5", conformations());
  expect_equal_engines(molecule, "loops", 100);
}

TEST(Engines, EqualBruteForceOnBuiltProteins) {
  for (const auto& [sequence, structure] :
       {std::pair("ACDEFGHIKLMNPQRSTVWYACDEFGHIKLMNPQRSTVWY", "CCHHHHHHHHHHCCCCEEEEEEECCCHHHHHHHHHHCCCC"),
        std::pair("GGGGG", "CCCCC"), std::pair("A", "C"), std::pair("WP", "EE")}) {
    const auto molecule = std::make_shared<const Molecule>(build_ideal_protein(sequence, structure));
    expect_equal_engines(molecule, "all", 2 * conformations());
  }
}

struct Case {
  const char* file;
  bool hydrogens;
  friend void PrintTo(const Case& c, std::ostream* out) { *out << c.file << (c.hydrogens ? " with hydrogens" : ""); }
};

class SharedProteins : public testing::TestWithParam<Case> {};

TEST_P(SharedProteins, GiveEqualAnswersOnAllEngines) {
  const auto file = test::molecule_file(GetParam().file);
  if (!std::filesystem::exists(file)) GTEST_SKIP() << "shared data not found";
  ReadOptions options;
  options.keep_hydrogens = GetParam().hydrogens;
  options.model = 1;
  const auto molecule = std::make_shared<const Molecule>(read_structure(file, options));
  expect_equal_engines(molecule, "count:7", conformations());
  expect_equal_engines(molecule, "all", conformations());
}

INSTANTIATE_TEST_SUITE_P(Files, SharedProteins,
                         testing::Values(Case{"1ejg.pdb", false}, Case{"1ejg.pdb", true}, Case{"1l2y.pdb", false},
                                         Case{"1l2y.pdb", true}, Case{"5pti.pdb", false}, Case{"5pti.pdb", true},
                                         Case{"paper/1vii_3frames.pdb", false}, Case{"paper/1vii_3frames.pdb", true},
                                         Case{"paper/nmr_neopetrosiamide.pdb", false},
                                         Case{"paper/nmr_neopetrosiamide.pdb", true}),
                         [](const auto& parameter) { return "n" + std::to_string(parameter.index); });

std::size_t native_contacts(const std::filesystem::path& file, bool hydrogens, const CheckOptions& rules) {
  ReadOptions options;
  options.keep_hydrogens = hydrogens;
  const auto molecule = std::make_shared<const Molecule>(read_structure(file, options));
  return Checker(molecule, molecule->select({}), rules).reference_collisions().size();
}

TEST(NativeContacts, OfUbiquitinAreOne) {
  const auto molecule = std::make_shared<const Molecule>(read_structure(test::ubiquitin()));
  const CheckOptions rules;
  const Checker checker(molecule, molecule->select({}), rules);
  ASSERT_EQ(checker.reference_collisions().size(), 1U);
  const Hit hit = checker.reference_collisions().front();
  const auto name = [&](PrimitiveId i) { return label(molecule->structure(), static_cast<std::uint32_t>(index(i))); };
  EXPECT_EQ(name(hit.first), "A:ARG72:O");
  EXPECT_EQ(name(hit.second), "A:ARG72:CG");
  EXPECT_NEAR(hit.distance, 2.380, 5e-4);
  EXPECT_NEAR(hit.threshold, 2.576, 1e-12);
}

TEST(NativeContacts, AgreeWithIndependentCounts) {
  const CheckOptions rules;
  for (const auto& [file, expected] : {std::pair("1ejg.pdb", 0U), std::pair("1crn.pdb", 0U), std::pair("5pti.pdb", 0U),
                                       std::pair("paper/1be0.cif", 0U), std::pair("paper/1mbo.pdb", 0U),
                                       std::pair("paper/2d0f.pdb", 1U), std::pair("paper/1mbn.pdb", 20U)})
    EXPECT_EQ(native_contacts(test::molecule_file(file), false, rules), expected) << file;
  // 4HHB has 10 contacts with template bonds. Bonds by distance alone would give 257, because 127 covalent bonds of
  // this old refinement are longer than radii + 0.4 angstrom (docs/explanation/native_contacts.md).
  EXPECT_EQ(native_contacts(test::molecule_file("4hhb.pdb.gz"), false, rules), 10U);
}

TEST(NativeContacts, WithHydrogensNeedTheHydrogenBondRule) {
  const auto crambin = test::molecule_file("1ejg.pdb"), cage = test::molecule_file("1l2y.pdb");
  CheckOptions rules;
  rules.thresholds.rules = "biocd";
  EXPECT_EQ(native_contacts(crambin, true, rules), 3U);
  EXPECT_EQ(native_contacts(cage, true, rules), 1U);
  rules.thresholds.hydrogen_bonds = false;
  EXPECT_EQ(native_contacts(crambin, true, rules), 33U);
  EXPECT_EQ(native_contacts(cage, true, rules), 10U);
}

/// Returns how many conformations of a file or trajectory are free.
std::size_t free_conformations(const std::string& arguments, std::size_t expected_count) {
  const auto said = test::run_biocd("check " + arguments + " --mode any --threads 2 2>/dev/null");
  std::istringstream lines(said.out);
  std::size_t free = 0, all = 0;
  for (std::string line; std::getline(lines, line);) {
    const bool is_free = line.find(": free") != std::string::npos;
    free += is_free ? 1 : 0;
    all += is_free || line.find(": collides") != std::string::npos ? 1 : 0;
  }
  EXPECT_EQ(all, expected_count) << arguments;
  return free;
}

TEST(NativeContacts, LeaveDepositedStructuresWithHydrogensFreeByDefault) {
  const auto file = [](const char* name) { return test::molecule_file(name).string(); };
  EXPECT_EQ(free_conformations(file("1l2y.pdb"), 38), 38U);
  EXPECT_EQ(free_conformations(file("nmr_neopetrosiamide.pdb"), 24), 24U);
  EXPECT_EQ(free_conformations(file("1ejg.pdb"), 1), 1U);
  if (!std::filesystem::exists(test::shared_molecules())) return;
  EXPECT_EQ(free_conformations(file("adk_closed.pdb") + " " + file("adk_dims.dcd"), 98), 96U);
  // The models of 2AXD differ in one atom, so each is read alone.
  for (const char* model : {"1", "2", "12"})
    EXPECT_EQ(free_conformations(file("paper/2axd.pdb.gz") + " --model " + model, 1), 1U);
  // The rings of Phe47 and Phe51 overlap by 0.94 angstrom in each frame.
  EXPECT_EQ(free_conformations(file("paper/1vii_3frames.pdb"), 3), 0U);
}

TEST(Thresholds, AreSevereByDefaultWhereHydrogensAre) {
  const test::TemporaryFile file(
      "ATOM      1  CB  ALA A   1       0.000   0.000   0.000  1.00  0.00           C\n"
      "ATOM      2  HB1 ALA A   1       1.090   0.000   0.000  1.00  0.00           H\n"
      "ATOM      3  CB  ALA B   1       0.000   5.000   0.000  1.00  0.00           C\n"
      "END\n");
  ThresholdOptions options;
  Thresholds t = make_thresholds(read_structure(file.path()), options);
  EXPECT_EQ(t.rules->name, "severe");
  EXPECT_NEAR(t.matrix.threshold(PrimitiveId{0}, PrimitiveId{2}), 2 * 1.70 - 0.9, 1e-8);
  EXPECT_NEAR(t.matrix.threshold(PrimitiveId{1}, PrimitiveId{2}), 1.22 + 1.70 - 0.9, 1e-8);
  options.rho = 0.8;  // rho selects BioCD's criterion
  t = make_thresholds(read_structure(file.path()), options);
  EXPECT_EQ(t.rules->name, "biocd");
  EXPECT_NEAR(t.matrix.threshold(PrimitiveId{0}, PrimitiveId{2}), 0.8 * 3.40, 1e-8);
  EXPECT_EQ(make_thresholds(read_structure(file.path(), test::heavy_atoms())).rules->name, "biocd");
}

TEST(NativeContacts, OfEveryRadiiSetStayFewOnCrambin) {
  const auto file = test::molecule_file("1ejg.pdb");
  CheckOptions rules;
  for (const auto& [set, expected] : {std::pair("bondi", 0U), std::pair("probe", 0U), std::pair("amber", 2U)}) {
    rules.thresholds.radii = set;
    EXPECT_EQ(native_contacts(file, false, rules), expected) << set;
  }
  rules.thresholds.radii = "amber";
  rules.min_bonds = 4;  // includes pairs four bonds apart, mostly O(i)...C(i+1)
  EXPECT_EQ(native_contacts(file, false, rules), 9U);
}

TEST(Thresholds, AreRhoTimesTheSumOfRadii) {
  const auto structure = read_structure(test::ubiquitin());
  ThresholdOptions options;
  options.rho = 0.5;
  const Thresholds t = make_thresholds(structure, options);
  const auto atom = [&](const char* name) {
    for (std::size_t i = 0; i < structure.atoms.size(); ++i)
      if (structure.atoms[i].name == name) return id<PrimitiveId>(i);
    throw std::runtime_error(name);
  };
  EXPECT_DOUBLE_EQ(t.matrix.threshold(atom("CA"), atom("N")), 0.5 * (1.70 + 1.55));
  EXPECT_DOUBLE_EQ(t.matrix.threshold(atom("SD"), atom("O")), 0.5 * (1.80 + 1.52));
  EXPECT_FALSE(t.hydrogen_bonds);
}

TEST(Thresholds, TakeNoHydroxylForACarbonylWhereHydrogensAreMissing) {
  const auto structure = read_structure(test::ubiquitin());
  const auto classes = classify_atoms(structure);
  std::size_t hydroxyls = 0;
  for (std::size_t i = 0; i < classes.size(); ++i) {
    const std::string& residue = structure.residues[structure.atoms[i].residue].name;
    const std::string& atom = structure.atoms[i].name;
    if (atom == "C") {
      EXPECT_EQ(classes[i], AtomClass::carbon_carbonyl);
    }
    if (atom != "CB" || (residue != "SER" && residue != "THR")) continue;
    ++hydroxyls;
    EXPECT_EQ(classes[i], AtomClass::carbon) << label(structure, static_cast<std::uint32_t>(i));
  }
  EXPECT_GT(hydroxyls, 0U);
}

TEST(Thresholds, RefuseWhatIsOutOfRange) {
  const auto structure = read_structure(test::ubiquitin());
  ThresholdOptions options;
  options.rho = 0.0;
  EXPECT_THROW(make_thresholds(structure, options), ModelError);
  options.rho = std::nan("");
  EXPECT_THROW(make_thresholds(structure, options), ModelError);
  options = {};
  options.radii = "pauling";
  EXPECT_THROW(make_thresholds(structure, options), ModelError);
  options = {};
  options.hydrogen_bond_allowance = -1;
  EXPECT_THROW(make_thresholds(structure, options), ModelError);
  EXPECT_THROW(BondExclusions(structure, 0), ModelError);
  EXPECT_THROW(BondExclusions(structure, 17), ModelError);
}

TEST(BondExclusions, EqualsBondDistance) {
  const auto structure = build_ideal_protein("ACPWK", "CCCCC");
  for (const int k : {1, 2, 4, 5}) {
    const BondExclusions filter(structure, k);
    for (std::uint32_t i = 0; i < structure.atoms.size(); ++i)
      for (std::uint32_t j = 0; j < structure.atoms.size(); ++j)
        if (i != j) {
          const int distance = bond_distance(structure, i, j, 20);
          EXPECT_EQ(filter.admits(id<PrimitiveId>(i), id<PrimitiveId>(j)), distance < 0 || distance >= k);
        }
  }
}

/// Excluded atoms from 64 places before an atom to 63 places after it are stored as bits, others only in a list.
TEST(BondExclusions, HoldAtEveryDistanceInTheFile) {
  const auto structure = build_ideal_protein("ACPWKACPWKACPWKACPWKACPWKACPWK", std::string(30, 'C'));
  const auto atoms = static_cast<std::uint32_t>(structure.atoms.size());
  ASSERT_GT(atoms, 200U);
  std::vector<std::pair<PrimitiveId, PrimitiveId>> exempt;
  for (const std::uint32_t far : {32U, 62U, 63U, 64U, 65U, 100U, 127U, 128U, 129U, 150U})
    exempt.emplace_back(PrimitiveId{20}, id<PrimitiveId>(20 + far));
  const BondExclusions filter(structure, 4, exempt), plain(structure, 4);
  EXPECT_EQ(filter.excluded_pairs(), plain.excluded_pairs() + exempt.size());
  EXPECT_EQ(laws::check_pair_filter(filter, atoms), laws::Violations{});
  for (std::uint32_t i = 0; i < atoms; ++i)
    for (std::uint32_t j = 0; j < atoms; ++j) {
      if (i == j) continue;
      const auto listed = filter.excluded(id<PrimitiveId>(i));
      EXPECT_EQ(filter.admits(id<PrimitiveId>(i), id<PrimitiveId>(j)),
                std::find(listed.begin(), listed.end(), id<PrimitiveId>(j)) == listed.end())
          << i << " " << j;
    }
}

TEST(Checker, ExemptsPairsOfTheReferenceOnRequest) {
  const auto molecule = std::make_shared<const Molecule>(read_structure(test::ubiquitin()));
  CheckOptions rules;
  Checker strict(molecule, molecule->select({}), rules);
  rules.exempt_reference = true;
  Checker lenient(molecule, molecule->select({}), rules);
  const auto& native = molecule->structure().models.front();
  EXPECT_TRUE(strict.check_coordinates(native, Mode::parse("any")).collides);
  EXPECT_FALSE(lenient.check_coordinates(native, Mode::parse("any")).collides);
  EXPECT_EQ(strict.constant_contacts().size(), 1U) << "nothing is free, so the contact is constant";
  EXPECT_TRUE(lenient.constant_contacts().empty());
}

/// Returns difference vectors of length exactly 0.8 * (1.70 + 1.70) = 2.720 A, in thousandths, in arbitrary order.
std::vector<std::array<int, 3>> ties() {
  constexpr int length = 2720;
  std::vector<std::array<int, 3>> all;
  for (int x = 1 - length; x < length; ++x)
    for (int y = 1; y < length; ++y) {
      const int rest = length * length - x * x - y * y;
      if (rest < 0) break;
      const int z = static_cast<int>(std::lround(std::sqrt(rest)));
      if (z * z == rest) all.push_back({x, y, z});
    }
  return all;
}

/// Returns a PDB file with one pair of carbons per difference, far from the other pairs. The second carbon is shifted
/// by `nearer` thousandths along -y.
std::string carbons(const std::vector<std::array<int, 3>>& differences, int nearer) {
  std::string text;
  const auto add = [&](std::size_t number, const std::array<int, 3>& at) {
    std::array<char, 100> line{};
    const auto x = [&](std::size_t k) { return at[k] / 1000.0; };
    std::snprintf(line.data(), line.size(), "ATOM  %5zu  CA  GLY %c%4zu    %8.3f%8.3f%8.3f  1.00  0.00           C\n",
                  number, static_cast<char>('A' + number / 2000), number % 2000, x(0), x(1), x(2));
    text += line.data();
  };
  for (std::size_t k = 0; k < differences.size(); ++k) {
    // Coordinates that are no exact doubles, at varying distances from the origin.
    const auto n = static_cast<int>(k);
    std::array<int, 3> at{10007 * (n % 9) + 3 * n, 10009 * (n / 9 % 9) - n, 10037 * (n / 81) + 7 * n};
    add(2 * k, at);
    for (std::size_t c = 0; c < 3; ++c) at[c] += differences[k][c];
    at[1] -= nearer;
    add(2 * k + 1, at);
  }
  return text + "END\n";
}

TEST(DecimalTies, OfAFileAreFreeInEveryModeAndEngine) {
  const auto differences = ties();
  ASSERT_GE(differences.size(), 100U);
  const test::TemporaryFile exact(carbons(differences, 0)), nearer(carbons(differences, 1));
  const auto molecule = std::make_shared<const Molecule>(read_structure(exact.path()));
  const auto& written = molecule->structure().models.front();
  ASSERT_EQ(written.size(), 2 * differences.size());
  std::size_t below = 0;
  for (std::size_t k = 0; k < written.size(); k += 2)
    below += closer_than(Point{written[k]}, Point{written[k + 1]}, 0.8 * (1.7 + 1.7)) ? 1 : 0;
  std::printf("%zu ties, of which the stored doubles are below the stored threshold in %zu\n", differences.size(),
              below);
  ASSERT_GT(below, differences.size() / 4) << "doubles answer rightly, so this tests nothing";
  const auto close = read_structure(nearer.path()).models.front();

  for (const char* engine : {"simd", "lazy", "brute"}) {
    SCOPED_TRACE(engine);
    CheckOptions rules;
    rules.engine = engine;
    Checker checker(molecule, molecule->select({}), rules);
    EXPECT_TRUE(checker.reference_collisions().empty());
    EXPECT_TRUE(checker.constant_contacts().empty());
    EXPECT_FALSE(checker.check_coordinates(written, Mode::parse("any")).collides);
    const Verdict all = checker.check_coordinates(written, Mode::parse("all"));
    EXPECT_FALSE(all.collides);
    EXPECT_TRUE(all.pairs.empty());
    // Lists the pairs closer than 2.72 + 0.03 = 2.75: only these.
    const Verdict near = checker.check_coordinates(written, Mode::parse("within:0.03"));
    EXPECT_FALSE(near.collides);
    ASSERT_EQ(near.pairs.size(), differences.size());
    for (const Contact& pair : near.pairs) EXPECT_FALSE(pair.collides);
    EXPECT_TRUE(checker.check_coordinates(written, Mode::parse("within:0")).pairs.empty());
    const Verdict closest = checker.check_coordinates(written, Mode::parse("closest"));
    EXPECT_FALSE(closest.collides);
    ASSERT_TRUE(closest.closest.has_value());
    EXPECT_FALSE(closest.closest->collides);

    for (const char* mode : {"any", "all", "within:0.03", "closest"}) {
      const Verdict verdict = checker.check_coordinates(close, Mode::parse(mode));
      EXPECT_TRUE(verdict.collides) << mode;
      const bool lists = Mode::parse(mode).kind == Mode::Kind::all || Mode::parse(mode).kind == Mode::Kind::within;
      EXPECT_EQ(verdict.pairs.size(), lists ? differences.size() : 0U) << mode;
      for (const Contact& pair : verdict.pairs) EXPECT_TRUE(pair.collides) << mode;
    }
  }
}

/// With a margin, ties are decided by the decimal sum: 2.38 + 0.34 = 2.72.
TEST(DecimalTies, AtAMarginAreNotListed) {
  const test::TemporaryFile file(carbons(ties(), 0));
  const auto molecule = std::make_shared<const Molecule>(read_structure(file.path()));
  const auto& written = molecule->structure().models.front();
  CheckOptions rules;
  rules.thresholds.rho = 0.7;  // M = 2.38
  Checker checker(molecule, molecule->select({}), rules);
  EXPECT_TRUE(checker.check_coordinates(written, Mode::parse("within:0.34")).pairs.empty());
  EXPECT_EQ(checker.check_coordinates(written, Mode::parse("within:0.340001")).pairs.size(), written.size() / 2);
}

/// All modes give a conformation the same verdict, even if distance and threshold round to the same double.
TEST(Verdicts, AgreeBetweenModesAtTies) {
  const auto differences = ties();
  const test::TemporaryFile file(carbons(differences, 0));
  const auto molecule = std::make_shared<const Molecule>(read_structure(file.path()));
  const CheckOptions options;  // a temporary makes g++ 12 warn about its members
  Checker checker(molecule, molecule->select({}), options);
  auto moved = molecule->structure().models.front();
  for (Vec3& x : moved) x += Vec3(0.0001, 0.0001, 0.0001);  // not on thousandths: doubles decide
  std::size_t told_apart = 0;
  for (std::size_t k = 0; k < moved.size(); k += 2) {
    std::vector<Vec3> pair = moved;
    for (std::size_t j = 0; j < pair.size(); ++j)
      if (j / 2 != k / 2) pair[j] += Vec3(static_cast<double>(100 * j), 0, 0);
    const bool any = checker.check_coordinates(pair, Mode::parse("any")).collides;
    const Verdict all = checker.check_coordinates(pair, Mode::parse("all"));
    const Verdict within = checker.check_coordinates(pair, Mode::parse("within:0.03"));
    const Verdict closest = checker.check_coordinates(pair, Mode::parse("closest"));
    EXPECT_EQ(all.collides, any);
    EXPECT_EQ(within.collides, any);
    EXPECT_EQ(closest.collides, any);
    ASSERT_EQ(within.pairs.size(), 1U);
    EXPECT_EQ(within.pairs[0].collides, any);
    EXPECT_EQ(closest.closest->collides, any);
    EXPECT_EQ(all.pairs.size(), any ? 1U : 0U);
    const Hit& hit = within.pairs[0].hit;
    told_apart += any != (hit.distance < hit.threshold) ? 1 : 0;
  }
  std::printf("rounded distances would have told %zu of %zu pairs otherwise\n", told_apart, differences.size());
  EXPECT_GT(told_apart, 0U) << "the rounded numbers decide as well, so this tests nothing";
}

TEST(Mode, RefusesUnknownWords) {
  EXPECT_EQ(Mode::parse("within:0.25").text(), "within:0.25");
  for (const char* word : {"", "some", "within", "within:", "within:-1", "within:nan", "within:1x"})
    EXPECT_THROW(Mode::parse(word), ModelError) << word;
}

TEST(Sampler, IsAPureFunctionOfSeedAndIndex) {
  const Sampling full{7, {}}, narrow{7, 0.1};
  EXPECT_EQ(sample_configuration(full, 5, 20), sample_configuration(full, 5, 20));
  EXPECT_NE(sample_configuration(full, 5, 20), sample_configuration(full, 6, 20));
  EXPECT_NE(sample_configuration(full, 5, 20), sample_configuration({8, {}}, 5, 20));
  double sum = 0.0, squares = 0.0;
  const auto q = sample_configuration(narrow, 0, 100000);
  for (const double value : q) {
    sum += value;
    squares += value * value;
  }
  EXPECT_NEAR(sum / 1e5, 0.0, 0.1 * 4 / std::sqrt(1e5));
  EXPECT_NEAR(std::sqrt(squares / 1e5), 0.1, 0.1 * 4 / std::sqrt(2e5));
  for (const double value : sample_configuration(full, 0, 1000)) EXPECT_LE(std::abs(value), std::numbers::pi);
}

}  // namespace checker_test
}  // namespace hinge::molecular
