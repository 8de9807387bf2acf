// SPDX-License-Identifier: BSD-3-Clause
// Tests extremes of files: missing or collinear atoms; truncated and damaged files, and files that claim gigabytes.
#include <gtest/gtest.h>
#include <sys/resource.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>
#include <vector>

#include "engine/random_mechanism.hpp"
#include "hinge/core/error.hpp"
#include "hinge/molecular/ideal_protein.hpp"
#include "hinge/molecular/molecule.hpp"
#include "hinge/molecular/read_structure.hpp"
#include "hinge/molecular/torsions.hpp"
#include "hinge/robotics/read_mesh.hpp"
#include "molecular/test_files.hpp"

namespace hinge {
namespace files_test {

using test::Random;
using test::TemporaryFile;

bool says(const std::vector<std::string>& notes, const std::string& words) {
  return std::ranges::any_of(notes, [&](const std::string& note) { return note.find(words) != std::string::npos; });
}

TEST(Molecules, WithAtomsMissingOrOnALineAreBuiltWithoutTheJointAndSaySo) {
  molecular::Structure whole = molecular::build_ideal_protein("AKA", "CCC");
  const auto chi_of = [](const molecular::Structure& structure, std::vector<std::string>& notes) {
    const auto torsions = molecular::find_torsions(structure, notes);
    return std::ranges::count_if(torsions, [](const auto& t) { return t.name.starts_with("chi"); });
  };
  std::vector<std::string> notes;
  ASSERT_EQ(chi_of(whole, notes), 4);
  molecular::Structure missing = whole, straight = whole;
  for (std::size_t i = 0; i < whole.atoms.size(); ++i) {
    if (whole.atoms[i].name == "CE") missing.atoms[i].name = "XX";
    if (whole.atoms[i].name != "CD") continue;
    // Puts CB, CG and CD on a line.
    std::vector<Vec3>& x = straight.models.front();
    x[i] = x[i - 1] + (x[i - 1] - x[i - 2]);
    ASSERT_EQ(whole.atoms[i - 2].name + whole.atoms[i - 1].name, "CBCG");
  }
  EXPECT_EQ(chi_of(missing, notes), 2);  // chi3 and chi4 need CE
  EXPECT_TRUE(notes.empty());
  EXPECT_EQ(chi_of(straight, notes), 2);  // the torsions about CB-CG and CG-CD are left out
  EXPECT_TRUE(says(notes, "of A:LYS2:"));
  EXPECT_TRUE(says(notes, "lie on a line"));
  EXPECT_TRUE(std::isnan(molecular::dihedral({0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {3, 1, 0})));
  // An unbroken chain has no note about a break.
  molecular::Structure structure = molecular::read_structure(test::ubiquitin());
  EXPECT_FALSE(says(structure.notes, "break"));
}

std::string bytes_of(const std::filesystem::path& path) {
  std::ostringstream text;
  text << std::ifstream(path, std::ios::binary).rdbuf();
  return text.str();
}

/// Returns the peak memory of the process, MiB.
double peak_memory() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return static_cast<double>(usage.ru_maxrss) / 1024;
}

/// Expects that the file is read or rejected with a LoadError that names it. Returns true if it is read.
template <class Read>
bool read_or_refused(const std::string& bytes, const std::string& extension, const Read& read) {
  const TemporaryFile file("", extension);
  std::ofstream(file.path(), std::ios::binary) << bytes;
  try {
    read(file.path());
  } catch (const LoadError& error) {
    EXPECT_NE(std::string(error.what()).find(file.path().filename().string()), std::string::npos) << error.what();
    return false;
  }
  return true;
}

/// Reads the file truncated at many lengths and with flipped bits; expects bounded memory.
template <class Read>
void expect_no_harm(const std::string& whole, const std::string& extension, const Read& read) {
  ASSERT_TRUE(read_or_refused(whole, extension, read));
  const std::size_t trials = std::getenv("HINGE_TEST_ALL") != nullptr ? 2000 : 40;
  const double before = peak_memory();
  std::size_t refused = 0;
  for (std::size_t k = 0; k < trials; ++k)
    refused += read_or_refused(whole.substr(0, whole.size() * k / trials), extension, read) ? 0U : 1U;
  Random random(1);
  for (std::size_t k = 0; k < trials; ++k) {
    std::string damaged = whole;
    for (std::size_t flips = 1 + k % 4; flips-- > 0;)
      damaged[random.below(damaged.size())] ^= static_cast<char>(1U << random.below(8));
    refused += read_or_refused(damaged, extension, read) ? 0U : 1U;
  }
  EXPECT_GT(refused, 0U);
  EXPECT_LT(peak_memory() - before, 256.0);
}

const auto read_molecule = [](const std::filesystem::path& path) { molecular::read_structure(path); };
const auto read_triangles = [](const std::filesystem::path& path) { robotics::read_mesh(path); };

std::string pdb() { return bytes_of(test::ubiquitin()); }

/// Returns an ideal protein as mmCIF.
std::string mmcif() {
  std::ostringstream text;
  text << "data_X\nloop_\n_atom_site.group_PDB\n_atom_site.id\n_atom_site.type_symbol\n_atom_site.label_atom_id\n"
          "_atom_site.label_alt_id\n_atom_site.label_comp_id\n_atom_site.label_asym_id\n_atom_site.label_entity_id\n"
          "_atom_site.label_seq_id\n_atom_site.pdbx_PDB_ins_code\n_atom_site.Cartn_x\n_atom_site.Cartn_y\n"
          "_atom_site.Cartn_z\n_atom_site.occupancy\n_atom_site.B_iso_or_equiv\n_atom_site.auth_seq_id\n"
          "_atom_site.auth_asym_id\n_atom_site.pdbx_PDB_model_num\n";
  const molecular::Structure s = molecular::build_ideal_protein("ACDEFGHIK", "CCCCCCCCC");
  for (std::size_t i = 0; i < s.atoms.size(); ++i) {
    const molecular::Residue& residue = s.residues[s.atoms[i].residue];
    const Vec3& x = s.models.front()[i];
    text << "ATOM " << i + 1 << ' ' << s.atoms[i].element << ' ' << s.atoms[i].name << " . " << residue.name << " A 1 "
         << residue.sequence_number << " ? " << x[0] << ' ' << x[1] << ' ' << x[2] << " 1.0 10.0 "
         << residue.sequence_number << " A 1\n";
  }
  return text.str() + "#\n";
}

std::string binary_stl(std::uint32_t claimed, std::size_t held) {
  std::string bytes(84 + 50 * held, '\0');
  for (std::size_t k = 0; k < 4; ++k) bytes[80 + k] = static_cast<char>(claimed >> 8 * k & 0xffU);
  Random random(2);
  for (std::size_t f = 0; f < held; ++f)
    for (std::size_t k = 0; k < 9; ++k) {
      const auto bits = std::bit_cast<std::uint32_t>(static_cast<float>(random.uniform(-1.0, 1.0)));
      for (std::size_t b = 0; b < 4; ++b)
        bytes[84 + 50 * f + 12 + 4 * k + b] = static_cast<char>(bits >> 8 * b & 0xffU);
    }
  return bytes;
}

TEST(Files, CutShortOrDamagedAreReadOrRefused) {
  expect_no_harm(pdb(), ".pdb", read_molecule);
  expect_no_harm(mmcif(), ".cif", read_molecule);
  expect_no_harm(binary_stl(50, 50), ".stl", read_triangles);
}

TEST(Files, ThatClaimGigabytesAreRefusedInBoundedMemory) {
  const double before = peak_memory();
  EXPECT_FALSE(read_or_refused(binary_stl(0xffffffffU, 0), ".stl", read_triangles));
  EXPECT_FALSE(read_or_refused(binary_stl(0x7fffffffU, 3), ".stl", read_triangles));
  EXPECT_FALSE(
      read_or_refused("solid x\nfacet normal 0 0 1\n outer loop\n vertex 1e999 0 0\n", ".stl", read_triangles));
  EXPECT_FALSE(read_or_refused("v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 2000000000\n", ".obj", read_triangles));
  EXPECT_FALSE(read_or_refused("NUMMDL    999999999\nMODEL     9999999999\n", ".pdb", read_molecule));
  EXPECT_FALSE(read_or_refused("data_x\nloop_\n_atom_site.id\n" + std::string(1U << 20U, '1'), ".cif", read_molecule));
  EXPECT_LT(peak_memory() - before, 256.0);
}

}  // namespace files_test
}  // namespace hinge
