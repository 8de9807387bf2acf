// SPDX-License-Identifier: BSD-3-Clause
// Tests PDB files with END between their atoms: files that were joined, and frames.
#include <gtest/gtest.h>

#include <array>
#include <cstdint>
#include <cstdio>
#include <string>

#include "hinge/molecular/ideal_protein.hpp"
#include "hinge/molecular/trajectory.hpp"
#include "molecular/test_files.hpp"

namespace hinge::molecular {
namespace joined_files_test {

using test::TemporaryFile;

/// Returns the records of a protein, moved by `shift`, angstrom. As PQR: with fields that blanks separate.
std::string records(const Structure& s, char chain, double shift, bool pqr = false) {
  std::string text;
  for (std::uint32_t i = 0; i < s.atoms.size(); ++i) {
    const Residue& residue = s.residues[s.atoms[i].residue];
    const Vec3 x = s.models.front()[i] + Vec3(shift, shift, shift);
    std::array<char, 100> line{};
    if (pqr)
      std::snprintf(line.data(), line.size(), "ATOM %u %s %s %c %d %.4f %.4f %.4f 0 1\n", i, s.atoms[i].name.c_str(),
                    residue.name.c_str(), chain, residue.sequence_number, x[0], x[1], x[2]);
    else
      std::snprintf(line.data(), line.size(), "ATOM  %5u  %-3s %3s %c%4d    %8.3f%8.3f%8.3f%6.2f%6.2f          %2s\n",
                    i, s.atoms[i].name.c_str(), residue.name.c_str(), chain, residue.sequence_number, x[0], x[1], x[2],
                    1.0, 0.0, s.atoms[i].element.c_str());
    text += line.data();
  }
  return text;
}

const Structure& receptor() {
  static const Structure s = build_ideal_protein("GASKD", "CCCCC");
  return s;
}
const Structure& ligand() {
  static const Structure s = build_ideal_protein("WV", "CC");
  return s;
}

struct Expected {
  std::size_t models, atoms;
};

/// Compares the structure, its first model alone, and the frames of the file.
void expect(const std::string& text, const Expected& expected, const std::string& extension = ".pdb") {
  const TemporaryFile file(text, extension);
  const Structure all = read_structure(file.path());
  EXPECT_EQ(all.models.size(), expected.models);
  EXPECT_EQ(all.atoms.size(), expected.atoms);
  ReadOptions options;
  options.first_model = true;
  const Structure first = read_structure(file.path(), options);
  EXPECT_EQ(first.models.size(), 1U);
  EXPECT_EQ(first.atoms.size(), expected.atoms);
  EXPECT_EQ(first.more_models, expected.models > 1);
  const Trajectory frames(file.path(), first, {});
  ASSERT_EQ(frames.size(), expected.models);
  for (std::size_t k = 0; k < frames.size(); ++k) EXPECT_EQ(frames.frame(k), all.models[k]) << k;
}

std::string end_notes(const std::string& text) {
  const TemporaryFile file(text);
  std::string notes;
  for (const std::string& note : read_structure(file.path()).notes)
    if (note.find("END") != std::string::npos) notes += note;
  return notes;
}

TEST(JoinedFiles, AreOneModel) {
  const std::size_t atoms = receptor().atoms.size() + ligand().atoms.size();
  const std::string one = records(receptor(), 'A', 0.0), other = records(ligand(), 'B', 30.0);
  for (const char* end : {"END\n", "TER\nEND   \n", "END\nHEADER    OTHER\nREMARK\n", "END\nEND\n"}) {
    SCOPED_TRACE(end);
    expect(one + end + other, {1, atoms});
    expect(one + end + other + end, {1, atoms});
  }
  expect(records(receptor(), 'A', 0.0) + "END\n" + records(receptor(), 'B', 30.0) + "END\n",
         {1, 2 * receptor().atoms.size()});
  const std::size_t line = receptor().atoms.size() + 1;
  EXPECT_EQ(end_notes(one + "END\n" + other + "END\n"),
            "line " + std::to_string(line) + ": atoms follow END; they belong to the same model");
  EXPECT_EQ(end_notes(one + "END\nTEXT\n"), "");
}

TEST(JoinedFiles, OfPqrAreOneModel) {
  expect(records(receptor(), 'A', 0.0, true) + "END\n" + records(ligand(), 'B', 30.0, true) + "END\n",
         {1, receptor().atoms.size() + ligand().atoms.size()}, ".pqr");
}

TEST(JoinedFiles, AreModelsIfTheyBeginWithTheSameAtom) {
  for (const bool pqr : {false, true}) {
    std::string frames, complexes, marked;
    for (int k = 0; k < 3; ++k) {
      const std::string one = records(receptor(), 'A', k, pqr), other = records(ligand(), 'B', 30.0 + k, pqr);
      frames += one + "END\n";
      complexes += one + "END\n" + other + "END\n";
      marked += "MODEL " + std::to_string(k + 1) + "\n" + one + "ENDMDL\nEND\n";
    }
    const char* extension = pqr ? ".pqr" : ".pdb";
    const std::size_t atoms = receptor().atoms.size();
    expect(frames, {3, atoms}, extension);
    expect(frames.substr(0, frames.size() - 4), {3, atoms}, extension);
    expect(complexes, {3, atoms + ligand().atoms.size()}, extension);
    expect(marked, {3, atoms}, extension);
  }
  const std::string one = records(receptor(), 'A', 0.0), other = records(receptor(), 'A', 1.0);
  EXPECT_EQ(end_notes(one + "END\n" + other + "END\n"), "");
}

}  // namespace joined_files_test
}  // namespace hinge::molecular
