// SPDX-License-Identifier: BSD-3-Clause
// Tests the identification of residues and atoms, and the bonds that follow from it.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <set>
#include <sstream>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "chemistry/residue_table.hpp"
#include "hinge/core/error.hpp"
#include "hinge/molecular/bond_exclusions.hpp"
#include "hinge/molecular/bonds.hpp"
#include "hinge/molecular/ideal_protein.hpp"
#include "hinge/molecular/torsions.hpp"
#include "molecular/dictionary_bonds.hpp"
#include "molecular/test_files.hpp"

namespace hinge::molecular {
namespace identify_test {

using test::TemporaryFile;

std::string atom(const std::string& name, const std::string& residue, int number, const Vec3& x,
                 const std::string& element, const std::string& record = "ATOM  ") {
  std::array<char, 100> line{};
  std::snprintf(line.data(), line.size(), "%s%5d %-4s %3s A%4d    %8.3f%8.3f%8.3f%6.2f%6.2f          %2s\n",
                record.c_str(), 1, name.c_str(), residue.c_str(), number, x[0], x[1], x[2], 1.0, 0.0, element.c_str());
  return line.data();
}

/// Returns a residue of an ideal protein as PDB records, shifted by `shift` (angstrom). If `name` is not empty, they
/// are HETATM records with that residue name.
std::string records(const Structure& s, std::uint32_t residue, const std::string& name, const Vec3& shift = {0, 0, 0}) {
  std::string text;
  for (std::uint32_t i = s.residues[residue].first_atom; i < s.residues[residue].last_atom; ++i)
    text += atom(" " + s.atoms[i].name, name.empty() ? s.residues[residue].name : name, static_cast<int>(residue) + 1,
                 s.models.front()[i] + shift, s.atoms[i].element, name.empty() ? "ATOM  " : "HETATM");
  return text;
}

bool has_note(const Structure& s, const std::string& words) {
  return std::any_of(s.notes.begin(), s.notes.end(),
                     [&](const std::string& note) { return note.find(words) != std::string::npos; });
}

Structure read(const std::string& text, bool hetero = false) {
  const TemporaryFile file(text);
  ReadOptions options;
  options.hetero = hetero;
  return read_structure(file.path(), options);
}

bool bonded(const Structure& s, const std::string& a, const std::string& b) {
  return std::any_of(s.bonds.begin(), s.bonds.end(), [&](const Bond& bond) {
    const std::string first = label(s, bond.first), second = label(s, bond.second);
    return (first == a && second == b) || (first == b && second == a);
  });
}

TEST(ResidueKind, KeepsAModifiedResidueThatIsBondedIntoTheChain) {
  const Structure ideal = build_ideal_protein("AYA", "CCC");
  const Structure s = read(records(ideal, 0, "") + records(ideal, 1, "PTR") + records(ideal, 2, ""));
  ASSERT_EQ(s.residues.size(), 3U);
  EXPECT_EQ(s.residues[1].kind, ResidueKind::amino_acid);
  EXPECT_TRUE(bonded(s, "A:ALA1:C", "A:PTR2:N"));
  std::vector<std::string> notes;
  const auto torsions = find_torsions(s, notes);
  EXPECT_TRUE(std::any_of(torsions.begin(), torsions.end(), [](const Torsion& t) { return t.name == "chi2"; }));
}

TEST(ResidueKind, TakesAnAminoAcidBesideTheChainForALigand) {
  const Structure ideal = build_ideal_protein("AAA", "CCC");
  const std::string text = records(ideal, 0, "") + records(ideal, 1, "") + records(ideal, 2, "SAH", {30, 0, 0});
  EXPECT_EQ(read(text).residues.size(), 2U);
  EXPECT_EQ(read(text).hetero_dropped, 6U);
  const Structure kept = read(text, true);
  ASSERT_EQ(kept.residues.size(), 3U);
  EXPECT_EQ(kept.residues[2].kind, ResidueKind::other);
  EXPECT_FALSE(has_note(kept, "break"));
}

TEST(ResidueKind, KeepsAModifiedResidueBetweenTwoBreaks) {
  const Structure ideal = build_ideal_protein("ASA", "CCC");
  const Structure s =
      read(records(ideal, 0, "") + records(ideal, 1, "SEP", {0, 30, 0}) + records(ideal, 2, "", {0, 60, 0}));
  ASSERT_EQ(s.residues.size(), 3U);
  EXPECT_TRUE(has_note(s, "chain A: breaks between ALA1 and SEP2, SEP2 and ALA3; no bond across"));
}

TEST(ResidueKind, LeavesOutDummyAtomsAndSaysSo) {
  const Structure ideal = build_ideal_protein("AA", "CC");
  const Structure s =
      read(records(ideal, 0, "") + records(ideal, 1, "") + atom("UNK", "UNX", 9, {20, 0, 0}, "X", "HETATM") +
               atom("N", "DUM", 10, {25, 0, 0}, "N", "HETATM") + atom("O", "DUM", 10, {30, 0, 0}, "O", "HETATM"),
           true);
  EXPECT_EQ(s.residues.size(), 2U);
  EXPECT_TRUE(has_note(s, "3 dummy atoms are left out (first: A:UNX9)"));
}

// Drude models have a particle DN near N, and lone pairs. As an atom, DN would be a deuterium that overlaps N.
TEST(VirtualSites, AreLeftOutWithANote) {
  const Structure ideal = build_ideal_protein("AA", "CC");
  const std::string protein = records(ideal, 0, "") + records(ideal, 1, "");
  const Structure whole = read(protein, true);
  const Structure s =
      read(records(ideal, 0, "") + atom(" DN ", "ALA", 1, {0.1, 0, 0}, "EP") + atom("LPOA", "ALA", 1, {0.2, 0, 0}, "") +
               records(ideal, 1, "") + atom(" LP1", "ALA", 2, {0.3, 0, 0}, ""),
           true);
  EXPECT_EQ(s.models, whole.models);
  EXPECT_EQ(s.bonds.size(), whole.bonds.size());
  EXPECT_EQ(s.atom_records, whole.atom_records + 3);
  EXPECT_TRUE(has_note(s, "3 virtual sites, which have no mass, are left out (first: A:ALA1:DN)"));
}

/// A record of a PDBQT file: a charge in columns 67-76, a type in columns 78-79.
std::string pdbqt(const std::string& name, const std::string& residue, const Vec3& x, const std::string& charge,
                  const std::string& type) {
  return atom(name, residue, 1, x, " " + type).replace(66, 10, std::string(10 - charge.size(), ' ') + charge);
}

// The parser reads the name of a segment in columns 73-76. With charges there, every atom would be a residue.
TEST(Pdbqt, HasChargesThatDoNotSplitResidues) {
  const Structure ideal = build_ideal_protein("S", "C");
  std::string text;
  for (std::uint32_t i = 0; i < ideal.atoms.size(); ++i)
    text += pdbqt(" " + ideal.atoms[i].name, "SER", ideal.models.front()[i], i % 2 == 0 ? "-0.342" : "0.197",
                  ideal.atoms[i].element + (ideal.atoms[i].element == "O" ? "A" : " "));
  const Structure s = read(text);
  EXPECT_EQ(s.residues.size(), 1U);
  EXPECT_EQ(s.bonds.size(), ideal.bonds.size());
  EXPECT_TRUE(s.notes.empty());
}

TEST(Pdbqt, HasPseudoAtomsThatAreLeftOut) {
  const std::string carbons =
      pdbqt(" C1", "LIG", {0, 0, 0}, "0.019", "CG0") + pdbqt(" C2", "LIG", {1.5, 0, 0}, "0.108", "C ");
  const Structure s =
      read(carbons + pdbqt(" *1", "LIG", {0, 1.5, 0}, "0.000", "G0") +
               pdbqt(" WAT", "LIG", {0, -2.8, 0}, "0.000", "W ") + pdbqt(" TZ", "LIG", {0, 0, 2}, "0.000", "TZ"),
           true);
  EXPECT_EQ(s.atoms.size(), 2U);
  EXPECT_EQ(s.bonds.size(), 1U);
  EXPECT_TRUE(has_note(s, "3 virtual sites, which have no mass, are left out (first: A:LIG1:*1)"));
}

// Some programs name all carbons of a ligand C. Without numbers, all but one would be lost.
TEST(Names, OfAtomsCalledByTheirElementsAreNumbered) {
  const std::string text = atom(" C ", "UNL", 1, {0, 0, 0}, "C") + atom(" C1", "UNL", 1, {1.5, 0, 0}, "C") +
                           atom(" C ", "UNL", 1, {2.1, 1.4, 0}, "C") + atom(" O ", "UNL", 1, {3.5, 1.4, 0}, "O") +
                           atom("CL ", "UNL", 1, {-1.2, 1.3, 0}, "CL") + atom("CL ", "UNL", 1, {-1.2, -1.3, 0}, "CL");
  const Structure s = read("MODEL 1\n" + text + "ENDMDL\nMODEL 2\n" + text + "ENDMDL\n", true);
  std::vector<std::string> names;
  for (const Atom& a : s.atoms) names.push_back(a.name);
  EXPECT_EQ(names, (std::vector<std::string>{"C2", "C1", "C3", "O", "CL1", "CL2"}));
  EXPECT_EQ(s.bonds.size(), 5U);
  EXPECT_EQ(s.models.size(), 2U);
  EXPECT_TRUE(has_note(s, "named by their elements alone, which are numbered: 1 (first: A:UNL1)"));
}

TEST(Names, OfOtherAtomsThatOccurTwiceMeanOneAtom) {
  const Structure s = read(atom(" C7", "LIG", 1, {0, 0, 0}, "C") + atom(" C7", "LIG", 1, {0.9, 0, 0}, "C"), true);
  EXPECT_EQ(s.atoms.size(), 1U);
  EXPECT_TRUE(has_note(s, "atoms that repeat a name of their residue and are left out: 1 (first: A:LIG1:C7)"));
}

// A receptor of a docking program, whose first residue in the file belongs between two others.
TEST(Bonds, JoinResiduesThatAreOutOfOrder) {
  const Structure ideal = build_ideal_protein("ASPA", "CCCC");
  const Structure s =
      read(records(ideal, 1, "") + records(ideal, 0, "") + records(ideal, 2, "") + records(ideal, 3, ""));
  EXPECT_EQ(s.bonds.size(), ideal.bonds.size());
  EXPECT_TRUE(bonded(s, "A:ALA1:C", "A:SER2:N"));
  EXPECT_TRUE(bonded(s, "A:SER2:C", "A:PRO3:N"));

  // The same with the hydrogen of SER2's N, which points away from C of ALA1 and CA.
  const std::vector<Vec3>& x = ideal.models.front();
  const auto at = [&](const std::string& name) {
    for (std::uint32_t i = 0; i < ideal.atoms.size(); ++i)
      if (label(ideal, i) == name) return x[i];
    throw std::out_of_range(name);
  };
  const Vec3 n = at("A:SER2:N"), middle = 0.5 * (at("A:ALA1:C") + at("A:SER2:CA"));
  const Vec3 h = n + (n - middle) / norm(Vec3(n - middle));
  const Structure with_hydrogen = read(records(ideal, 1, "") + atom(" H", "SER", 2, h, "H") + records(ideal, 0, "") +
                                       records(ideal, 2, "") + records(ideal, 3, ""));
  EXPECT_EQ(with_hydrogen.bonds.size(), ideal.bonds.size() + 1);
  EXPECT_TRUE(bonded(with_hydrogen, "A:ALA1:C", "A:SER2:N"));
}

// Read as PDB, the chlorine "Cl" would be a carbon.
TEST(Pdbqt, HasTypesThatTellTheElements) {
  const std::vector<std::array<std::string, 2>> expected = {
      {"A", "C"},   {"C", "C"},   {"OA", "O"},  {"HD", "H"},  {"NA", "N"},  {"SA", "S"},  {"P", "P"},
      {"F", "F"},   {"I", "I"},   {"Cl", "Cl"}, {"CL", "Cl"}, {"Br", "Br"}, {"BR", "Br"}, {"Zn", "Zn"},
      {"FE", "Fe"}, {"Mg", "Mg"}, {"MN", "Mn"}, {"Ca", "Ca"}, {"Si", "Si"}, {"Na", "Na"}};
  std::string text;
  for (std::size_t k = 0; k < expected.size(); ++k)
    text += pdbqt(" X" + std::to_string(k), "LIG", {10.0 * static_cast<double>(k), 0, 0}, "-0.250", expected[k][0]);
  const Structure s = read(text, true);
  ASSERT_EQ(s.atoms.size(), expected.size());
  for (std::size_t k = 0; k < expected.size(); ++k) EXPECT_EQ(s.atoms[k].element, expected[k][1]) << expected[k][0];
  EXPECT_THROW(read(atom(" X1", "LIG", 1, {0, 0, 0}, " A"), true), LoadError);  // no charge: not a PDBQT file
}

TEST(Elements, OfCharmmIonsComeFromTheirNames) {
  const Structure ideal = build_ideal_protein("A", "C");
  const Structure s =
      read(records(ideal, 0, "") + atom(" CLA", "CLA", 2, {20, 0, 0}, "", "HETATM") +
               atom(" SOD", "SOD", 3, {30, 0, 0}, "", "HETATM") + atom(" CAL", "CAL", 4, {40, 0, 0}, "", "HETATM"),
           true);
  ASSERT_EQ(s.residues.size(), 4U);
  EXPECT_EQ(s.atoms[s.residues[1].first_atom].element, "Cl");
  EXPECT_EQ(s.atoms[s.residues[2].first_atom].element, "Na");
  EXPECT_EQ(s.atoms[s.residues[3].first_atom].element, "Ca");
}

// Files without elements: the columns of " CA ", " FE " and " BR1" tell carbon, fluorine and boron.
TEST(Elements, OfIonsAndHalogensComeFromTheirNames) {
  const Structure ideal = build_ideal_protein("A", "C");
  const Structure s =
      read(records(ideal, 0, "") + atom(" CA", "CA", 2, {20, 0, 0}, "", "HETATM") +
               atom(" ZN", "ZN2", 3, {30, 0, 0}, "", "HETATM") + atom(" FE", "HEM", 4, {40, 0, 0}, "", "HETATM") +
               atom(" NA", "HEM", 4, {42, 0, 0}, "", "HETATM") + atom(" BR1", "LGD", 5, {50, 0, 0}, "", "HETATM") +
               atom(" CL1", "LGD", 6, {60, 0, 0}, "C", "HETATM"),
           true);
  std::vector<std::string> elements;
  for (std::uint32_t i = s.residues[1].first_atom; i < s.atoms.size(); ++i) elements.push_back(s.atoms[i].element);
  EXPECT_EQ(elements, (std::vector<std::string>{"Ca", "Zn", "Fe", "N", "Br", "C"}));
}

TEST(Bonds, JoinAMetalToItsDonorsOnly) {
  // Calcium bound by a bidentate carboxylate: 2.4 A from both oxygens, 2.75 A from the carbon.
  const std::string ligand = atom(" C", "ACT", 2, {20, 0, 0}, "C", "HETATM") +
                             atom(" O", "ACT", 2, {20.59, 1.10, 0}, "O", "HETATM") +
                             atom(" OXT", "ACT", 2, {20.59, -1.10, 0}, "O", "HETATM");
  const Structure s =
      read(records(build_ideal_protein("A", "C"), 0, "") + ligand + atom("CA", "CA", 3, {22.75, 0, 0}, "CA", "HETATM"),
           true);
  EXPECT_TRUE(bonded(s, "A:ACT2:O", "A:CA3:CA"));
  EXPECT_TRUE(bonded(s, "A:ACT2:OXT", "A:CA3:CA"));
  EXPECT_FALSE(bonded(s, "A:ACT2:C", "A:CA3:CA"));
}

TEST(Bonds, JoinNoTwoCopiesOfAnAtom) {
  const Structure s =
      read(records(build_ideal_protein("A", "C"), 0, "") + atom("CL", "CL", 2, {20, 0, 0}, "CL", "HETATM") +
               atom("CL", "CL", 3, {20, 0, 0}, "CL", "HETATM"),
           true);
  EXPECT_FALSE(bonded(s, "A:CL2:CL", "A:CL3:CL"));
}

TEST(Bonds, CloseABackboneRing) {
  const auto file = test::molecule_file("1sfi.cif");
  const Structure s = read_structure(file);
  EXPECT_TRUE(bonded(s, "I:GLY1:N", "I:ASP14:C"));
  EXPECT_EQ(
      std::count_if(s.bonds.begin(), s.bonds.end(), [](const Bond& b) { return b.origin == BondOrigin::disulphide; }),
      7);
}

TEST(Bonds, GiveEveryHydrogenExactlyOne) {
  for (const char* name : {"1ejg.pdb", "5pti_old.pdb", "adk_closed.pdb", "paper/1vii_3frames.pdb"}) {
    const auto file = test::molecule_file(name);
    if (!std::filesystem::exists(file)) continue;
    const Structure s = read_structure(file);
    const auto neighbours = bonded_neighbours(s);
    for (std::uint32_t i = 0; i < s.atoms.size(); ++i)
      if (s.atoms[i].element == "H") {
        EXPECT_EQ(neighbours[i].size(), 1U) << name << " " << label(s, i);
      }
  }
}

TEST(Models, ThatDifferShareTheirCommonAtoms) {
  const auto file = test::molecule_file("paper/2axd.pdb.gz");
  if (!std::filesystem::exists(file)) GTEST_SKIP() << "shared data not found";
  const Structure s = read_structure(file);
  EXPECT_EQ(s.models.size(), 12U);
  EXPECT_EQ(s.atoms.size(), 1276U);
  EXPECT_NE(
      std::ranges::find_if(s.notes, [](const std::string& note) { return note.find("S:LYS76:OXT") != note.npos; }),
      s.notes.end());
}

TEST(ResidueTable, HasTheBondsOfTheMonomerDictionary) {
  if (!std::filesystem::exists(test::dictionary)) GTEST_SKIP() << "refmac-dictionary is not installed";
  for (const char c : std::string_view("ARNDCQEGHILKMFPSTWYV")) {
    const ResidueTemplate& known = *find_residue_template(c);
    std::set<std::set<std::string>> expected, own;
    for (const auto& bond : test::dictionary_bonds(std::string(known.name)))
      if (!bond.contains("OXT")) expected.insert(bond);
    ASSERT_FALSE(expected.empty()) << known.name;
    const auto add = [&](std::string_view a, std::string_view b) { own.insert({std::string(a), std::string(b)}); };
    for_each_bond("N-CA CA-C C-O", add);
    for_each_bond(known.side_chain, add);
    own.erase({"CG1", "CD"});  // CD is CHARMM's name of CD1 of isoleucine
    EXPECT_EQ(own, expected) << known.name;
  }
}

TEST(IdealProtein, HasNoCloseContactsWhateverTheSideChain) {
  const auto radius = [](const std::string& element) {  // Bondi radii, angstrom
    return element == "C" ? 1.70 : element == "N" ? 1.55 : element == "O" ? 1.52 : 1.80;
  };
  for (const char element : std::string_view("HEC"))
    for (const char letter : std::string_view("ARNDCQEGHILKMFPSTWYV")) {
      if (element == 'H' && letter == 'P') continue;  // no proline in helices
      const Structure s = build_ideal_protein(std::string(12, letter), std::string(12, element));
      const BondExclusions exclusions(s, 4);
      const auto& x = s.models.front();
      int close = 0;
      for (std::uint32_t i = 0; i < x.size(); ++i)
        for (std::uint32_t j = i + 1; j < x.size(); ++j)
          if (exclusions.admits(id<PrimitiveId>(i), id<PrimitiveId>(j)) &&
              (x[i] - x[j]).norm() < 0.8 * (radius(s.atoms[i].element) + radius(s.atoms[j].element)))
            ++close;
      EXPECT_EQ(close, 0) << letter << " in " << element;
    }
}

}  // namespace identify_test
}  // namespace hinge::molecular
