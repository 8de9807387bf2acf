// SPDX-License-Identifier: BSD-3-Clause
// Tests PQR files, whose fields are separated by blanks, as PDB2PQR, APBS and PyMOL write them.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstdio>
#include <string>

#include "hinge/core/error.hpp"
#include "hinge/molecular/ideal_protein.hpp"
#include "hinge/molecular/trajectory.hpp"
#include "molecular/test_files.hpp"

namespace hinge::molecular {
namespace pqr_test {

using test::TemporaryFile;

Structure read(const std::string& text, const std::string& extension = ".pqr") {
  const TemporaryFile file(text, extension);
  ReadOptions options;
  options.hetero = true;
  return read_structure(file.path(), options);
}

/// Returns the error without the path; empty: the text was read.
std::string refusal(const std::string& text) {
  const TemporaryFile file(text, ".pqr");
  try {
    read_structure(file.path());
  } catch (const LoadError& error) {
    return std::string(error.what()).substr(file.path().string().size());
  }
  return "";
}

std::string number(const char* format, double x) {
  std::array<char, 60> text{};
  std::snprintf(text.data(), text.size(), format, x);
  return text.data();
}

/// Returns a protein as PQR. chain: with blanks around it. format: of a coordinate.
std::string pqr(const Structure& s, const std::string& chain, const char* format = " %.9f", double shift = 0.0) {
  std::string text = "REMARK   1 PQR file\n";
  for (std::uint32_t i = 0; i < s.atoms.size(); ++i) {
    const Residue& residue = s.residues[s.atoms[i].residue];
    text += "ATOM " + std::to_string(i + 1) + " " + s.atoms[i].name + " " + residue.name + chain +
            std::to_string(residue.sequence_number);
    for (int k = 0; k < 3; ++k) text += number(format, s.models.front()[i][k] + shift);
    text += " -0.4157 1.8240\n";
  }
  return text;
}

void expect_same(const Structure& read, const Structure& s, const std::string& chain) {
  ASSERT_EQ(read.atoms.size(), s.atoms.size());
  ASSERT_EQ(read.bonds.size(), s.bonds.size());
  for (std::uint32_t i = 0; i < s.atoms.size(); ++i) {
    EXPECT_EQ(read.atoms[i].name, s.atoms[i].name);
    EXPECT_EQ(read.atoms[i].element, s.atoms[i].element);
    EXPECT_EQ(read.atoms[i].serial, static_cast<int>(i) + 1);
    EXPECT_EQ(residue_label(read, read.atoms[i].residue).substr(2), residue_label(s, s.atoms[i].residue).substr(2));
    EXPECT_LT((read.models.front()[i] - s.models.front()[i]).norm(), 2e-9);
  }
  EXPECT_EQ(read.chains.front().name, chain);
}

TEST(Pqr, HasTheAtomsOfAProteinWithOrWithoutAChain) {
  const Structure s = build_ideal_protein("ACDEFGHIKLMNPQRSTVWY", "CCHHHHHHHHHHCCCCEEEE");
  for (const auto& [between, chain] : {std::pair(" ", ""), {" A ", "A"}, {" A", "A"}, {" 1 ", "1"}, {"\tB\t", "B"}}) {
    SCOPED_TRACE(between);
    expect_same(read(pqr(s, between)), s, chain);
  }
  expect_same(read(pqr(s, " A "), ".PQR"), s, "A");
  expect_same(read(test::gzipped(pqr(s, " A ")), ".pqr.gz"), s, "A");
  const Structure noted = read(pqr(s, " "));
  EXPECT_TRUE(std::any_of(noted.notes.begin(), noted.notes.end(), [](const std::string& note) {
    return note == "PQR file: its charges and radii are not used";
  }));
}

TEST(Pqr, HasFieldsThatTouch) {
  const Structure s = read(
      "ATOM      1  N   ALA A1001    1999.3232998.770-900.490  0.1414 1.8240\n"
      "ATOM      2  CA  ALA A1001    1999.9993000.064-900.490  0.0962 1.9080\n"
      "HETATM10000 HH11 LIG  1002B   2000.0003001.000-900.000  0.0962 1.9080\n"
      "HETATM10001 CL1 LIG 1002B 2001.5 +3002.25 -9e2 1 2 further words\n");
  ASSERT_EQ(s.atoms.size(), 4U);
  EXPECT_EQ(label(s, 0), "A:ALA1001:N");
  EXPECT_EQ(s.models.front()[0], Vec3(1999.323, 2998.770, -900.490));
  EXPECT_EQ(label(s, 2), "_:LIG1002B:HH11");
  EXPECT_EQ(s.atoms[2].serial, 10000);
  EXPECT_EQ(s.atoms[3].element, "Cl");
  EXPECT_EQ(s.models.front()[3], Vec3(2001.5, 3002.25, -900.0));
}

TEST(Pqr, HasElementsInItsNames) {
  const Structure s = read(
      "ATOM 1 K K 1 0 0 0 1 1\nATOM 2 I ION 2 10 0 0 1 1\nATOM 3 CA CA 3 20 0 0 1 1\nATOM 4 CA LIGA 4 30 0 0 1 1\n"
      "ATOM 5 C LIGB 5 40 0 0 1 1\nATOM 6 C LIGB 5 41.5 0 0 1 1\nATOM 7 O5' LIGB 5 43 0 0 1 1\n");
  std::string elements, names;
  for (const Atom& atom : s.atoms) elements += atom.element + ' ', names += atom.name + ' ';
  EXPECT_EQ(elements, "K I Ca C C C O ");
  EXPECT_EQ(names, "K I CA CA C1 C2 O5' ");
}

// PDB2PQR drops the names of chains unless it is told to keep them.
TEST(Pqr, OfADimerHasTheAtomsOfBothMolecules) {
  const Structure s = build_ideal_protein("GAS", "CCC");
  for (const char* between : {"", "TER\n"}) {
    const Structure dimer = read(pqr(s, " ") + between + pqr(s, " ", " %.3f", 50.0));
    EXPECT_EQ(dimer.atoms.size(), 2 * s.atoms.size());
    EXPECT_EQ(dimer.residues.size(), 2 * s.residues.size());
    EXPECT_EQ(dimer.bonds.size(), 2 * s.bonds.size());
  }
  EXPECT_EQ(read("ATOM 1 C LIG 1 0 0 0 0 1\nTER\nATOM 2 C LIG 1 9 0 0 0 1\n").residues.size(), 2U);
}

// With CHARMM's names, PDB2PQR gives the atoms of a patch its name: here CA is of the patch TER.
TEST(Pqr, HasResiduesWithTheNamesOfPatches) {
  const Structure s = build_ideal_protein("TC", "CC");
  std::string text = pqr(s, " ");
  text.replace(text.find(" CA THR "), 8, " CA TER ");  // between N and C of THR
  const Structure read_again = read(text);
  EXPECT_EQ(read_again.residues.size(), s.residues.size());
  EXPECT_EQ(read_again.residues.front().name, "THR");
  EXPECT_EQ(read_again.bonds.size(), s.bonds.size());
  // Residues of one number that do not take turns have their own names.
  EXPECT_EQ(read("ATOM 1 C1 LIG 1 0 0 0 0 1\nATOM 2 C1 MOL 1 9 0 0 0 1\n").residues.size(), 2U);
}

TEST(Pqr, HasModels) {
  const Structure s = build_ideal_protein("GAS", "CCC");
  const std::string text = pqr(s, " ") + "END\n" + pqr(s, " ", " %.3f", 1.0) + "END\n";
  EXPECT_EQ(read(text).models.size(), 2U);
  const TemporaryFile file(text, ".pqr");
  const Trajectory frames(file.path(), s, {});
  ASSERT_EQ(frames.size(), 2U);
  EXPECT_LT((frames.frame(1)[0] - s.models.front()[0] - Vec3(1, 1, 1)).norm(), 1e-3);
}

TEST(Pqr, WithErrorsIsRefused) {
  const std::string good = "ATOM 1 N GLY 1 0 0 0 0 1\n";
  const std::string expected =
      ": expected a record of PQR: ATOM serial name residue [chain] number x y z charge radius, separated by blanks";
  EXPECT_EQ(refusal(good), "");
  for (const char* bad : {"ATOM 2 CA GLY 1 nan 0 0 0 1\n", "ATOM 2 CA GLY 1 1.5 x 0 0 1\n", "ATOM 2 CA GLY 1 1.5 0\n",
                          "ATOM 2 CA GLY 1 1.5 0 0 0\n", "ATOM 2 CA GLY A B 1.5 0 0 0 1\n", "ATOM\n",
                          "ATOM 2 CA GLY 99999999999 1.5 0 0 0 1\n", "ATOM 2 CA GLY 1 1e999 0 0 0 1\n"})
    EXPECT_EQ(refusal(good + bad), ":2" + expected) << bad;
  EXPECT_EQ(refusal(good + std::string("ATOM 2 C\0 GLY 1 0 0 0 0 1\n", 26)), ":2" + expected);
  EXPECT_EQ(refusal("REMARK\n"), ": has no ATOM or HETATM records, expected a PQR file");
}

}  // namespace pqr_test
}  // namespace hinge::molecular
