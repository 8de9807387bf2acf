// SPDX-License-Identifier: BSD-3-Clause
// Tests DNA and RNA: bonds, torsions and their angles, old and new names, modified nucleotides, engines against brute
// force.
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <map>
#include <memory>
#include <numbers>
#include <optional>
#include <set>
#include <sstream>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "chemistry/nucleotide_table.hpp"
#include "chemistry/residue_table.hpp"
#include "hinge/core/error.hpp"
#include "hinge/molecular/summary.hpp"
#include "molecular/dictionary_bonds.hpp"
#include "molecular/engines_agree.hpp"
#include "molecular/test_files.hpp"

namespace hinge::molecular {
namespace nucleic_acid_test {

using test::TemporaryFile;
using Counts = std::map<std::string, std::size_t>;

std::filesystem::path dodecamer() { return std::filesystem::path(HINGE_SOURCE_DIR) / "molecular/data/1bna.pdb"; }

std::string dodecamer_text() {
  std::ifstream in(dodecamer());
  return {std::istreambuf_iterator<char>(in), {}};
}

std::shared_ptr<const Molecule> molecule(const std::filesystem::path& file, bool hetero = false) {
  ReadOptions options;
  options.hetero = hetero;
  return std::make_shared<const Molecule>(read_structure(file, options));
}

Counts kinds(const Molecule& m) { return torsions_by_kind(m.structure(), m.torsions()); }

/// Returns PDB text with other atom names (columns 13-16).
template <class Rename>
std::string renamed(const std::string& text, const Rename& rename) {
  std::istringstream lines(text);
  std::string line, result;
  while (std::getline(lines, line)) {
    if (line.starts_with("ATOM")) {
      std::string name = line.substr(12, 4);
      rename(name);
      line.replace(12, 4, name);
    }
    result += line + "\n";
  }
  return result;
}

TEST(NucleicAcid, HasTheTorsionsOfItsChain) {
  // Twelve nucleotides per strand. The first has no phosphate, hence no alpha and beta; the last has no epsilon and
  // zeta.
  const auto m = molecule(dodecamer());
  EXPECT_EQ(kinds(*m), (Counts{{"alpha", 2 * 11},
                               {"beta", 2 * 11},
                               {"gamma", 2 * 12},
                               {"epsilon", 2 * 11},
                               {"zeta", 2 * 11},
                               {"chi", 2 * 12}}));
  EXPECT_TRUE(m->structure().notes.empty());
  EXPECT_TRUE(m->notes().empty());
  EXPECT_TRUE(m->model().tree().closures().empty());
  const auto classes = residues_by_class(m->structure());
  ASSERT_EQ(classes.size(), 1U);
  EXPECT_EQ(classes.at("DNA").residues, 24U);
}

/// Returns the angle between the projections of a - b and d - c along c - b, with IUPAC sign. Independent of the
/// library's formula.
double projected_dihedral(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d) {
  const Vec3 axis = (c - b) / std::sqrt((c - b).dot(c - b));
  const Vec3 u = (a - b) - (a - b).dot(axis) * axis, w = (d - c) - (d - c).dot(axis) * axis;
  const double angle = std::acos(std::clamp(u.dot(w) / std::sqrt(u.dot(u) * w.dot(w)), -1.0, 1.0));
  return u.cross(w).dot(axis) < 0 ? -angle : angle;
}

/// The four atoms of a torsion by IUPAC-IUB 1983; +1 and -1 are the next and the previous residue.
struct Definition {
  const char* name;
  std::array<std::pair<int, const char*>, 4> atoms;
};
constexpr std::array<Definition, 7> definitions{{
    {"alpha", {{{-1, "O3'"}, {0, "P"}, {0, "O5'"}, {0, "C5'"}}}},
    {"beta", {{{0, "P"}, {0, "O5'"}, {0, "C5'"}, {0, "C4'"}}}},
    {"gamma", {{{0, "O5'"}, {0, "C5'"}, {0, "C4'"}, {0, "C3'"}}}},
    {"epsilon", {{{0, "C4'"}, {0, "C3'"}, {0, "O3'"}, {1, "P"}}}},
    {"zeta", {{{0, "C3'"}, {0, "O3'"}, {1, "P"}, {1, "O5'"}}}},
    {"chi", {{{0, "O4'"}, {0, "C1'"}, {0, "N9"}, {0, "C4"}}}},
    {"chi", {{{0, "O4'"}, {0, "C1'"}, {0, "N1"}, {0, "C2"}}}},
}};

TEST(NucleicAcid, TurnsEachDihedralByItsJointValueAndNoOther) {
  const auto m = molecule(dodecamer());
  const Structure& s = m->structure();
  std::map<std::pair<std::uint32_t, std::string>, std::uint32_t> atoms;
  for (std::uint32_t i = 0; i < s.atoms.size(); ++i) atoms[{s.atoms[i].residue, s.atoms[i].name}] = i;
  const auto angle_of = [&](const Torsion& t, const std::vector<Vec3>& x) -> std::optional<double> {
    for (const Definition& definition : definitions) {
      if (t.name != definition.name) continue;
      // Purines also have N1, but it is not bonded to the sugar.
      const bool purine = atoms.contains({t.residue, "N9"});
      if (t.name == "chi" && purine != (std::string_view(definition.atoms[2].second) == "N9")) continue;
      std::array<Vec3, 4> at;
      for (std::size_t k = 0; k < 4; ++k)
        at[k] = x[atoms.at(
            {t.residue + static_cast<std::uint32_t>(definition.atoms[k].first), definition.atoms[k].second})];
      return projected_dihedral(at[0], at[1], at[2], at[3]);
    }
    return std::nullopt;
  };
  Checker checker(m, m->select(select_torsions(*m, "all", false)), {});
  std::vector<double> q(checker.dof_count());
  ASSERT_EQ(q.size(), 136U);
  for (std::size_t k = 0; k < q.size(); ++k) q[k] = std::sin(static_cast<double>(k) + 1.0);
  checker.check(q, Mode::parse("any"));
  const std::vector<Vec3> turned = checker.positions();
  for (std::size_t k = 0; k < q.size(); ++k) {
    const Torsion& t = m->torsions()[k];
    const auto before = angle_of(t, s.models.front()), after = angle_of(t, turned);
    ASSERT_TRUE(before && after) << t.name;
    EXPECT_NEAR(*before, t.reference, 1e-7) << t.name;
    EXPECT_NEAR(std::remainder(*after - *before - q[index(m->dof(k))], 2 * std::numbers::pi), 0.0, 1e-6) << t.name;
  }
}

TEST(NucleicAcid, KeepsSugarsBasesAndBondsWhateverItsTorsions) {
  const auto m = molecule(dodecamer());
  const Structure& s = m->structure();
  Checker checker(m, m->select(select_torsions(*m, "all", false)), {});
  checker.check(std::vector<double>(checker.dof_count(), 1.1), Mode::parse("any"));
  const auto x = checker.positions();
  const auto& y = s.models.front();
  const auto rigid_part = [](std::string_view name) {
    if (name == "C1'" || name == "C2'" || name == "C3'" || name == "C4'" || name == "O4'") return 1;
    return name.find_first_of("P'") == std::string_view::npos ? 2 : 0;  // base, or an atom that moves
  };
  for (const Bond& bond : s.bonds)
    EXPECT_NEAR((x[bond.first] - x[bond.second]).norm(), (y[bond.first] - y[bond.second]).norm(), 1e-10);
  for (const Residue& r : s.residues)
    for (std::uint32_t i = r.first_atom; i < r.last_atom; ++i)
      for (std::uint32_t j = r.first_atom; j < i; ++j)
        if (const int part = rigid_part(s.atoms[i].name); part != 0 && part == rigid_part(s.atoms[j].name)) {
          EXPECT_NEAR((x[i] - x[j]).norm(), (y[i] - y[j]).norm(), 1e-10) << label(s, i) << " " << label(s, j);
        }
}

TEST(NucleicAcid, IsTheSameUnderItsOldNames) {
  const TemporaryFile old(renamed(dodecamer_text(), [](std::string& name) {
    std::replace(name.begin(), name.end(), '\'', '*');
    if (name == " OP1") name = " O1P";
    if (name == " OP2") name = " O2P";
    if (name == " C7 ") name = " C5M";
  }));
  const auto today = molecule(dodecamer()), before = molecule(old.path());
  EXPECT_EQ(kinds(*before), kinds(*today));
  ASSERT_EQ(before->structure().bonds.size(), today->structure().bonds.size());
  for (std::size_t k = 0; k < today->structure().bonds.size(); ++k)
    EXPECT_EQ(before->structure().bonds[k].second, today->structure().bonds[k].second);
  EXPECT_EQ(residues_by_class(before->structure()).at("DNA").residues, 24U);
  EXPECT_EQ(basic_groups(before->structure()), basic_groups(today->structure()));
}

TEST(NucleicAcid, HasNoBondAcrossABreak) {
  std::string text;
  std::istringstream lines(dodecamer_text());
  for (std::string line; std::getline(lines, line);)
    if (!(line.starts_with("ATOM") && line.substr(21, 5) == "A   5")) text += line + "\n";
  const TemporaryFile broken(text);
  const auto m = molecule(broken.path());
  const auto& notes = m->structure().notes;
  EXPECT_EQ(std::count(notes.begin(), notes.end(), "chain A: break between DG4 and DA6; no bond across"), 1);
  // Missing: all six torsions of nucleotide 5, and epsilon and zeta of 4. alpha of 6 remains, about its own phosphate.
  EXPECT_EQ(m->torsions().size(), 136U - 6U - 2U);
}

/// Some models leave phosphates out: one note for each chain, not one for each nucleotide.
TEST(NucleicAcid, NotesAllBreaksOfAChainTogether) {
  std::string text;
  std::istringstream lines(dodecamer_text());
  for (std::string line; std::getline(lines, line);)
    if (!line.starts_with("ATOM") || line.substr(12, 4) != " P  ") text += line + "\n";
  const TemporaryFile broken(text);
  const auto m = molecule(broken.path());
  std::vector<std::string> breaks;
  for (const std::string& note : m->structure().notes)
    if (note.find("no bond across") != std::string::npos) breaks.push_back(note);
  ASSERT_EQ(breaks.size(), 2U);
  EXPECT_TRUE(breaks[0].starts_with("chain A: breaks between DC1 and DG2, DG2 and DC3, ")) << breaks[0];
  EXPECT_TRUE(breaks[0].ends_with(", DG10 and DC11, and 1 more; no bond across")) << breaks[0];
}

TEST(NucleicAcid, TurnsHydroxylsWhereTheirHydrogensAreExplicit) {
  // Nucleotide 3 becomes RNA: O2' replaces a hydrogen of C2' and has its own hydrogen. HO5' ends the chain.
  const Structure s = read_structure(dodecamer());
  std::map<std::string, Vec3> at;
  for (std::uint32_t i = 0; i < s.atoms.size(); ++i)
    if (s.chains[s.residues[s.atoms[i].residue].chain].name == "A")
      at[std::to_string(s.residues[s.atoms[i].residue].sequence_number) + s.atoms[i].name] = s.models.front()[i];
  const Vec3 c2 = at.at("3C2'"), out = (c2 - at.at("3C1'")).cross(c2 - at.at("3C3'"));
  const Vec3 o2 = c2 + out * (1.42 / out.norm()), h = o2 + (c2 - at.at("3C1'")) * (0.96 / (c2 - at.at("3C1'")).norm());
  const Vec3 o5 = at.at("1O5'"), away = o5 - at.at("1C4'"), h5 = o5 + away * (0.96 / away.norm());
  const auto line = [](const char* name, const char* residue, int number, const Vec3& x, char element) {
    std::array<char, 100> text{};
    std::snprintf(text.data(), text.size(), "ATOM  %5d %-4s %3s A%4d    %8.3f%8.3f%8.3f  1.00  0.00           %c\n",
                  9000, name, residue, number, x[0], x[1], x[2], element);
    return std::string(text.data());
  };
  std::string text;
  std::istringstream lines(dodecamer_text());
  for (std::string next; std::getline(lines, next);) {
    text += next + "\n";
    if (next.starts_with("ATOM") && next.substr(12, 4) == " C2'" && next.substr(21, 5) == "A   3")
      text += line(" O2'", "DC ", 3, o2, 'O').replace(17, 3, next.substr(17, 3)) +
              line("HO2'", "DC ", 3, h, 'H').replace(17, 3, next.substr(17, 3));
    if (next.starts_with("ATOM") && next.substr(12, 4) == " O5'" && next.substr(21, 5) == "A   1")
      text += line("HO5'", "DC ", 1, h5, 'H').replace(17, 3, next.substr(17, 3));
  }
  const TemporaryFile file(text);
  const auto m = molecule(file.path());
  Counts counts = kinds(*m);
  EXPECT_EQ(counts["kappa"], 1U);
  EXPECT_EQ(counts["beta"], 23U) << "one turns the hydrogen of O5'";
  EXPECT_EQ(select_torsions(*m, "A:3:kappa", false).size(), 1U);
  EXPECT_EQ(select_torsions(*m, "A:3:O2'-C2'", false), select_torsions(*m, "A:3:kappa", false));
  EXPECT_EQ(residues_by_class(m->structure()).at("RNA").residues, 1U);
}

TEST(NucleicAcid, IsSelectedByTheNamesOfItsTorsions) {
  const Molecule m(read_structure(dodecamer()));
  EXPECT_EQ(select_torsions(m, "alpha", false).size(), 22U);
  EXPECT_EQ(select_torsions(m, "A:5:chi", false).size(), 1U);
  EXPECT_EQ(select_torsions(m, "A:5", false).size(), 6U);
  EXPECT_EQ(select_torsions(m, "A:5:C4'-C5'", false), select_torsions(m, "A:5:gamma", false));
  EXPECT_EQ(select_torsions(m, "backbone", false).size(), 112U);
  EXPECT_EQ(select_torsions(m, "chi", false).size(), 24U);
  EXPECT_EQ(select_torsions(m, "every:2", false).size(), 10U * 6U + 2U * 4U)
      << "A12 and B24 have four, the other ten six";
  EXPECT_THROW(select_torsions(m, "ligands", false), ModelError) << "there are none";
  EXPECT_THROW(select_torsions(m, "count:25", false), ModelError);
  EXPECT_THROW(select_torsions(m, "A:5:C1'-C2'", false), ModelError) << "a bond of the sugar's ring";
  try {
    select_torsions(m, "A:5:delta", false);
    FAIL() << "expected a ModelError";
  } catch (const ModelError& error) {
    EXPECT_NE(std::string(error.what()).find("lies in the sugar ring"), std::string::npos) << error.what();
  }
}

TEST(NucleicAcid, GivesEqualAnswersOnAllEngines) {
  test::expect_engines_agree(molecule(dodecamer()), "all", 40);
  test::expect_engines_agree(molecule(dodecamer()), "A:1-12,B:20:chi", 20);
}

TEST(NucleicAcid, WithModifiedNucleotidesIsOneChain) {
  const auto file = test::molecule_file("1ehz.pdb.gz");
  const auto m = molecule(file, true);
  // One chain of 76 nucleotides; the first has a phosphate. Both 2'-O-methyl groups rotate, and five bonds in the tail
  // of wybutosine: its ester and carbamate bonds are as short as double bonds in these coordinates.
  EXPECT_EQ(kinds(*m), (Counts{{"alpha", 76},
                               {"beta", 76},
                               {"gamma", 76},
                               {"epsilon", 75},
                               {"zeta", 75},
                               {"chi", 76},
                               {"bonds of OMC", 1},
                               {"bonds of OMG", 1},
                               {"bonds of YYG", 5}}));
  const auto classes = residues_by_class(m->structure());
  EXPECT_EQ(classes.at("RNA").residues, 76U);
  EXPECT_EQ(classes.at("ion").names, (Counts{{"MG", 6}, {"MN", 3}}));
  for (const Torsion& t : m->torsions())
    if (t.name == "chi" && m->structure().residues[t.residue].name == "PSU") {
      EXPECT_EQ(m->structure().atoms[t.atoms[2]].name, "C5");
      EXPECT_EQ(m->structure().atoms[t.atoms[3]].name, "C4");
    }
  test::expect_engines_agree(m, "all", 6);
}

TEST(NucleicAcid, WithProteinAndMetalsIsCountedByHand) {
  const auto file = test::molecule_file("1d66.pdb");
  const auto m = molecule(file, true);
  // Two strands of 19 nucleotides without 5' phosphates; two proteins of 57 residues, with three prolines besides the
  // first residue.
  const std::size_t nucleic = std::size_t{2} * (18 + 18 + 19 + 18 + 18 + 19), chi = 127, phi = 53, psi = 57;
  EXPECT_EQ(select_torsions(*m, "all", false).size(), nucleic + 2 * (chi + phi + psi));
  // Each protein has two cadmium ions with four sulphurs each, two of them shared. Of these eight bonds two attach the
  // ions, and six close cycles.
  EXPECT_EQ(m->model().tree().closures().size(), 2U * 6U);
  test::expect_engines_agree(m, "all", 6);
}

TEST(NucleotideTable, HasTheBondsOfTheMonomerDictionary) {
  if (!std::filesystem::exists(test::dictionary)) GTEST_SKIP() << "refmac-dictionary is not installed";
  const auto own = [](const char* name) {
    std::set<std::set<std::string>> bonds;
    const auto add = [&](std::string_view a, std::string_view b) { bonds.insert({std::string(a), std::string(b)}); };
    for_each_bond(nucleotide_backbone_bonds, add);
    for_each_bond(find_nucleotide_template(name)->base, add);
    return bonds;
  };
  for (const char* name : {"A", "C", "G", "I", "U", "DA", "DC", "DG", "DI", "DT", "DU", "PSU"}) {
    auto expected = test::dictionary_bonds(name);
    ASSERT_FALSE(expected.empty()) << name;
    if (name[0] == 'D') expected.insert({"C2'", "O2'"});  // the table has one backbone for DNA and RNA
    expected.insert({"P", "OP3"});
    EXPECT_EQ(own(name), expected) << name;
  }
  for (const char* name : {"1MA", "A2M", "6MZ", "MA6", "5MC", "OMC", "4AC", "1MG", "2MG", "7MG", "G7M", "M2G", "OMG",
                           "5MU", "H2U", "OMU", "UR3", "5BU"}) {
    // Some of these monomers have old atom names.
    const auto bonds = test::dictionary_bonds(name);
    ASSERT_FALSE(bonds.empty()) << name;
    for (const auto& wanted : own(name)) {
      const std::string &a = *wanted.begin(), &b = *wanted.rbegin();
      if (a == "OP3" || b == "OP3") continue;
      EXPECT_TRUE(std::any_of(bonds.begin(), bonds.end(),
                              [&](const auto& bond) {
                                const std::string &c = *bond.begin(), &d = *bond.rbegin();
                                return (is_nucleotide_atom(c, a) && is_nucleotide_atom(d, b)) ||
                                       (is_nucleotide_atom(c, b) && is_nucleotide_atom(d, a));
                              }))
          << name << " has no " << a << "-" << b;
    }
  }
}

}  // namespace nucleic_acid_test
}  // namespace hinge::molecular
