// SPDX-License-Identifier: BSD-3-Clause
// Tests residue names of force fields, and names of four letters in PDB files, whose last letter stands in the column
// that other programs use for chain names of two letters.
#include <gtest/gtest.h>

#include <array>
#include <cstddef>
#include <cstdio>
#include <map>
#include <memory>
#include <sstream>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "chemistry/residue_table.hpp"
#include "hinge/molecular/checker.hpp"
#include "hinge/molecular/torsions.hpp"
#include "hinge/molecular/write_trajectory.hpp"
#include "io/read_file.hpp"
#include "molecular/test_files.hpp"

namespace hinge::molecular {
namespace residue_names_test {

/// Returns the text of a committed structure.
std::string text_of(const char* name) { return read_bytes(test::molecule_file(name)); }

Structure read(const std::string& text, bool hetero = false) {
  const test::TemporaryFile file(text);
  ReadOptions options;
  options.hetero = options.waters = hetero;
  return read_structure(file.path(), options);
}

/// Returns a PDB text in which residues have other names, with the fourth letter in column 21 (columns 15 and 29 of
/// SSBOND). names: new names by the names in the text.
std::string renamed(const std::string& text, const std::map<std::string, std::string>& names) {
  std::istringstream in(text);
  std::string result;
  for (std::string line; std::getline(in, line); result += line + "\n") {
    std::vector<std::size_t> fields;
    if (line.starts_with("ATOM") || line.starts_with("HETATM")) fields = {17};
    if (line.starts_with("SSBOND")) fields = {11, 25};
    for (const std::size_t field : fields)
      if (const auto found = names.find(line.substr(field, 3)); found != names.end())
        line.replace(field, 4, found->second + std::string(4 - found->second.size(), ' '));
  }
  return result;
}

/// Returns a PDB text with this letter in column 21 of atoms whose residue names have three letters.
std::string with_column21(const std::string& text, char letter) {
  std::istringstream in(text);
  std::string result;
  for (std::string line; std::getline(in, line); result += line + "\n")
    if (line.starts_with("ATOM") || line.starts_with("HETATM")) line[20] = letter;
  return result;
}

/// Expects the same bonds, torsions, exclusions and collisions by every rule.
void expect_same(const Structure& a, const Structure& b) {
  ASSERT_EQ(a.atoms.size(), b.atoms.size());
  ASSERT_EQ(a.chains.size(), b.chains.size());
  ASSERT_EQ(a.bonds.size(), b.bonds.size());
  for (std::size_t k = 0; k < a.bonds.size(); ++k) {
    ASSERT_EQ(std::pair(a.bonds[k].first, a.bonds[k].second), std::pair(b.bonds[k].first, b.bonds[k].second));
    EXPECT_EQ(a.bonds[k].origin, b.bonds[k].origin) << label(b, b.bonds[k].first);
  }
  const auto m = std::make_shared<const Molecule>(a), n = std::make_shared<const Molecule>(b);
  ASSERT_EQ(m->torsions().size(), n->torsions().size());
  for (std::size_t k = 0; k < m->torsions().size(); ++k) EXPECT_EQ(m->torsions()[k].name, n->torsions()[k].name);
  for (const char* rules : {"biocd", "severe", "molprobity", "chimerax", "posebusters"}) {
    SCOPED_TRACE(rules);
    CheckOptions options;
    options.thresholds.rules = rules;
    Checker p(m, m->select({}), options), q(n, n->select({}), options);
    EXPECT_EQ(p.exclusions().excluded_pairs(), q.exclusions().excluded_pairs());
    EXPECT_EQ(p.check_coordinates(a.models[0], Mode::parse("all")).pairs,
              q.check_coordinates(b.models[0], Mode::parse("all")).pairs);  // including thresholds
  }
}

TEST(ResidueNames, OfForceFieldsMeanTheirResidue) {
  for (const auto& [name, standard] : std::map<std::string_view, std::string_view>{{"HSE", "HIS"},
                                                                                   {"HISE", "HIS"},
                                                                                   {"LYSH", "LYS"},
                                                                                   {"NALA", "ALA"},
                                                                                   {"CHIE", "HIS"},
                                                                                   {"CCYX", "CYS"},
                                                                                   {"CYS2", "CYS"},
                                                                                   {"ASPP", "ASH"},
                                                                                   {"LSN", "LYN"},
                                                                                   {"ALA", "ALA"},
                                                                                   {"NAG", "NAG"},
                                                                                   {"POPC", "POPC"},
                                                                                   {"CHL1", "CHL1"},
                                                                                   {"NSEP", "SEP"},
                                                                                   {"NME", "NME"},
                                                                                   {"", ""}})
    EXPECT_EQ(pdb_residue_name(name), standard) << name;
  EXPECT_TRUE(is_histidine("HISH"));
  EXPECT_TRUE(is_histidine("HIC"));
  EXPECT_FALSE(is_histidine("ALA"));
  EXPECT_EQ(find_residue_template("ASPH"), find_residue_template("ASP"));
  EXPECT_EQ(find_residue_template("POPC"), nullptr);
}

TEST(ResidueNames, OfForceFieldsChangeNoAnswer) {
  const std::string myoglobin = text_of("1mbn.pdb"), inhibitor = text_of("5pti.pdb");  // the second has hydrogens
  const std::map<std::string, std::string> gromos{{"HIS", "HISE"}, {"LYS", "LYSH"}, {"CYS", "CYS2"}};
  for (const std::string& text : {myoglobin, inhibitor}) {
    const Structure plain = read(text);
    expect_same(plain, read(renamed(text, gromos)));
    expect_same(plain, read(renamed(text, {{"HIS", "HSD"}, {"CYS", "CYX"}})));
  }
  const Structure s = read(renamed(myoglobin, gromos));
  EXPECT_EQ(s.chains.size(), 1U);
  EXPECT_EQ(s.residues[11].name, "HISE");
  EXPECT_EQ(s.chains[0].name, "A");
}

TEST(ResidueNames, OfFourLettersAreReadInChainsWithoutNames) {
  std::string text = renamed(text_of("1mbn.pdb"), {{"HIS", "HISH"}, {"ARG", "ARGN"}});
  for (std::size_t at = text.find("\nATOM"); at != std::string::npos; at = text.find("\nATOM", at + 1))
    text[at + 22] = ' ';
  const Structure s = read(text);
  EXPECT_EQ(s.chains.size(), 1U);
  EXPECT_EQ(s.chains[0].name, "");
  EXPECT_EQ(s.residues[11].name, "HISH");
}

TEST(ResidueNames, OfFourLettersAreReadInEachModel) {
  const std::string model = renamed(text_of("1mbn.pdb"), {{"HIS", "HISE"}});
  std::string atoms;
  std::istringstream in(model);
  for (std::string line; std::getline(in, line);)
    if (line.starts_with("ATOM")) atoms += line + "\n";
  const Structure s = read("MODEL        1\n" + atoms + "ENDMDL\nMODEL        2\n" + atoms + "ENDMDL\nEND\n");
  EXPECT_EQ(s.models.size(), 2U);
  EXPECT_EQ(s.residues[11].name, "HISE");
}

TEST(ResidueNames, OfWatersAndLipidsAreReadWhole) {
  const auto atom = [](int serial, const char* name, const char* residue, char chain, double x) {
    std::array<char, 100> line{};
    std::snprintf(line.data(), line.size(), "ATOM  %5d  %-3s %-4s%c   1    %8.3f   0.000   0.000  1.00  0.00\n", serial,
                  name, residue, chain, x);
    return std::string(line.data());
  };
  const std::string text = atom(1, "N", "ALA", 'P', 0) + atom(2, "CA", "ALA", 'P', 1.46) + "TER\n" +
                           atom(3, "OH2", "TIP3", 'W', 30) + atom(4, "C31", "POPC", 'M', 40) +
                           atom(5, "C1", "DPPC", 'M', 50) + "END\n";
  const Structure s = read(text, true);
  ASSERT_EQ(s.residues.size(), 4U);
  EXPECT_EQ(s.residues[1].name, "TIP3");
  EXPECT_EQ(s.residues[1].kind, ResidueKind::water);
  EXPECT_EQ(s.residues[2].name, "POPC");
  EXPECT_EQ(s.residues[3].name, "DPPC");
  EXPECT_EQ(s.chains[1].name, "W");
  EXPECT_EQ(read(text).waters_dropped, 1U);
}

TEST(ResidueNames, OfThreeLettersLeaveChainNamesOfTwoLetters) {
  const std::string plain = text_of("1mbn.pdb");
  EXPECT_FALSE(has_long_residue_names(plain));
  const Structure s = read(with_column21(plain, 'B'));
  EXPECT_EQ(s.chains[0].name, "BA");
  EXPECT_EQ(s.residues[11].name, "HIS");
  // Two chains one after the other, A and BA, with TER between them.
  EXPECT_FALSE(has_long_residue_names(plain + "TER\n" + with_column21(plain, 'B')));
  // Nucleotides: the name does not fill its columns.
  EXPECT_FALSE(has_long_residue_names(with_column21(text_of("1d66.pdb"), 'B')));
  EXPECT_FALSE(
      has_long_residue_names("HETATM    1  O   HOHBA   1      11.104   6.134  -6.504  1.00  0.00           O\n"));
}

TEST(ResidueNames, OfFourLettersAreWrittenAndReadAgain) {
  for (const char* name : {"1mbn.pdb", "5pti.pdb"}) {
    const Structure s =
        read(renamed(text_of(name), {{"HIS", "HISE"}, {"LYS", "LYSH"}, {"CYS", "CYS2"}, {"MET", "NMET"}}));
    std::ostringstream out;
    TrajectoryWriter writer(out, TrajectoryFormat::pdb, s, s.atoms.size());
    writer.add(s.models.front(), 1);
    writer.finish();
    const Structure other = read(out.str());
    expect_same(s, other);
    for (std::size_t r = 0; r < s.residues.size(); ++r) EXPECT_EQ(s.residues[r].name, other.residues[r].name);
  }
}

}  // namespace residue_names_test
}  // namespace hinge::molecular
