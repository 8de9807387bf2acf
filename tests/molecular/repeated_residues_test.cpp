// SPDX-License-Identifier: BSD-3-Clause
// Tests residues of one chain with the same name and number, such as those of a dimer without chain names.
#include <gtest/gtest.h>

#include <array>
#include <cstdint>
#include <cstdio>
#include <sstream>
#include <string>

#include "hinge/molecular/ideal_protein.hpp"
#include "hinge/molecular/write_structure.hpp"
#include "molecular/test_files.hpp"

namespace hinge::molecular {
namespace repeated_residues_test {

using test::TemporaryFile;

Structure read(const std::string& text) {
  const TemporaryFile file(text);
  ReadOptions options;
  options.hetero = true;
  return read_structure(file.path(), options);
}

std::string record(const std::string& name, const std::string& residue, int number, const Vec3& x,
                   const std::string& element, char altloc = ' ') {
  std::array<char, 100> line{};
  std::snprintf(line.data(), line.size(), "ATOM  %5d  %-3s%c%3s  %4d    %8.3f%8.3f%8.3f%6.2f%6.2f          %2s\n", 1,
                name.c_str(), altloc, residue.c_str(), number, x[0], x[1], x[2], 1.0, 0.0, element.c_str());
  return line.data();
}

/// Returns the records of a protein without a chain name, of the elements that are chosen.
std::string records(const Structure& s, double shift, bool carbons = true, bool others = true, char altloc = ' ') {
  std::string text;
  for (std::uint32_t i = 0; i < s.atoms.size(); ++i) {
    const Residue& residue = s.residues[s.atoms[i].residue];
    if (s.atoms[i].element == "C" ? carbons : others)
      text += record(s.atoms[i].name, residue.name, residue.sequence_number,
                     s.models.front()[i] + Vec3(shift, shift, shift), s.atoms[i].element, altloc);
  }
  return text;
}

TEST(RepeatedResidues, OfADimerWithoutChainNamesStaySeparate) {
  const Structure s = build_ideal_protein("GASKD", "CCCCC");
  for (const char* between : {"", "TER\n"}) {
    SCOPED_TRACE(between);
    const Structure dimer = read(records(s, 0.0) + between + records(s, 50.0) + "END\n");
    ASSERT_EQ(dimer.atoms.size(), 2 * s.atoms.size());
    EXPECT_EQ(dimer.residues.size(), 2 * s.residues.size());
    EXPECT_EQ(dimer.bonds.size(), 2 * s.bonds.size());
    for (std::size_t i = 0; i < dimer.atoms.size(); ++i) {
      const Vec3 x = s.models.front()[i % s.atoms.size()];
      const double shift = i < s.atoms.size() ? 0.0 : 50.0;
      EXPECT_EQ(dimer.atoms[i].name, s.atoms[i % s.atoms.size()].name);
      EXPECT_LT((dimer.models.front()[i] - x - Vec3(shift, shift, shift)).norm(), 1e-3);
    }
  }
}

TEST(RepeatedResidues, AreWrittenAndReadAgain) {
  const Structure s = build_ideal_protein("GASKD", "CCCCC");
  const Structure dimer = read(records(s, 0.0) + records(s, 50.0));
  std::ostringstream pdb, cif;
  write_pdb_head(pdb, dimer);
  write_pdb_model(pdb, dimer, dimer.models.front(), 1);
  write_pdb_tail(pdb, dimer);
  write_cif_head(cif, dimer);
  write_cif_model(cif, dimer, dimer.models.front(), 1, 1);
  for (const std::string& text : {pdb.str(), cif.str()}) {
    const Structure again = read(text);
    EXPECT_EQ(again.atoms.size(), dimer.atoms.size());
    EXPECT_EQ(again.bonds.size(), dimer.bonds.size());
  }
}

TEST(RepeatedResidues, OfLigandsThatAreSeparatedByTerStaySeparate) {
  const std::string ligand = record("C1", "LIG", 1, {0, 0, 0}, "C") + record("C2", "LIG", 1, {1.5, 0, 0}, "C"),
                    other = record("C1", "LIG", 1, {0, 9, 0}, "C") + record("C2", "LIG", 1, {1.5, 9, 0}, "C");
  const Structure s = read(ligand + "TER\n" + other);
  EXPECT_EQ(s.atoms.size(), 4U);
  EXPECT_EQ(s.bonds.size(), 2U);
}

// Some programs add hydrogens, or the atoms of a second conformer, at the end of the file.
TEST(RepeatedResidues, AreJoinedWhereTheirAtomsDiffer) {
  const Structure s = build_ideal_protein("GASKD", "CCCCC");
  for (const char* between : {"", "TER\n"}) {
    const Structure joined = read(records(s, 0.0, true, false) + between + records(s, 0.0, false, true));
    EXPECT_EQ(joined.atoms.size(), s.atoms.size());
    EXPECT_EQ(joined.residues.size(), s.residues.size());
    EXPECT_EQ(joined.bonds.size(), s.bonds.size());
  }
  const Structure one = read(records(s, 0.0, true, true, 'A') + records(s, 0.5, true, true, 'B'));
  EXPECT_EQ(one.atoms.size(), s.atoms.size());
  EXPECT_EQ(one.residues.size(), s.residues.size());
}

}  // namespace repeated_residues_test
}  // namespace hinge::molecular
