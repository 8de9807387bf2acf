// SPDX-License-Identifier: BSD-3-Clause
// Tests bonds between residues found by distance alone: accepted and noted if valences and angles allow them. Any other
// close pair is a collision.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdio>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "hinge/molecular/checker.hpp"
#include "hinge/molecular/join_structures.hpp"
#include "molecular/run_biocd.hpp"
#include "molecular/test_files.hpp"

namespace hinge::molecular {
namespace bonds_by_distance_test {

struct Placed {
  const char* name;
  double x, y, z;
};

/// Returns the atom records of one residue: HETATM for ligands and ZN, otherwise ATOM. The element is the first letter
/// of the name, except for ZN.
std::string residue(const char* name, char chain, const std::vector<Placed>& atoms, const Vec3& move = Vec3::Zero()) {
  const bool is_ligand = std::string(name) == "LIG" || std::string(name) == "KNI" || std::string(name) == "ZN";
  std::string text;
  for (const Placed& a : atoms) {
    const std::string atom = a.name;
    const bool metal = atom == "ZN";
    std::array<char, 100> line{};
    std::snprintf(line.data(), line.size(), "%-6s%5d %-4s %3s %c   1    %8.3f%8.3f%8.3f  1.00  0.00          %2s\n",
                  is_ligand ? "HETATM" : "ATOM", 1, metal || atom.size() == 4 ? a.name : (" " + atom).c_str(), name,
                  chain, a.x + move[0], a.y + move[1], a.z + move[2], metal ? "ZN" : atom.substr(0, 1).c_str());
    text += line.data();
  }
  return text;
}

/// Phe53 of chain B and KNI-272 of 1HPX. The inhibitor is moved: O2 is 1.703 A from CD1, all other distances are at
/// least 2.6 A.
const std::vector<Placed> phenylalanine{
    {"N", 3.564, -4.083, 3.657},   {"CA", 2.370, -3.252, 3.390},  {"C", 1.161, -4.145, 3.375},
    {"O", 1.188, -5.220, 2.788},   {"CB", 2.435, -2.498, 2.007},  {"CG", 3.313, -1.277, 2.078},
    {"CD1", 4.685, -1.401, 1.972}, {"CD2", 2.757, -0.047, 2.382}, {"CE1", 5.526, -0.323, 2.204},
    {"CE2", 3.595, 1.034, 2.598},  {"CZ", 4.985, 0.905, 2.520}};
const std::vector<Placed> inhibitor{
    {"C1", 7.246, -2.598, -8.911},  {"C2", 6.701, -1.762, -7.954},  {"C3", 7.284, -0.506, -7.707},
    {"C4", 8.389, -0.187, -8.457},  {"C5", 8.866, -1.130, -9.425},  {"C6", 6.750, 0.391, -6.723},
    {"C7", 7.398, 1.609, -6.549},   {"C8", 8.507, 1.936, -7.296},   {"C9", 9.027, 1.067, -8.254},
    {"C10", 5.538, 0.596, -4.718},  {"C11", 4.465, -0.096, -3.964}, {"N1", 8.305, -2.320, -9.643},
    {"O1", 5.633, 0.012, -5.988},   {"O3", 3.725, 0.518, -3.218},   {"N2", 4.353, -1.395, -4.177},
    {"C26", 3.426, -2.176, -3.374}, {"C12", 2.342, -2.778, -4.235}, {"S1", 1.066, -3.344, -3.077},
    {"C27", 0.240, -1.723, -2.910}, {"C13", 4.181, -3.237, -2.613}, {"O6", 4.156, -4.408, -2.959},
    {"C17", 5.737, -5.165, 1.260},  {"N3", 4.894, -2.797, -1.578},  {"O4", 6.722, -5.013, 1.975},
    {"C15", 5.103, -3.959, 0.572},  {"C28", 7.770, -2.879, -2.094}, {"C16", 7.173, -3.125, -0.723},
    {"C31", 8.863, -2.460, -4.624}, {"C14", 5.748, -3.697, -0.796}, {"O2", 5.347, -2.845, 1.357},
    {"C29", 7.799, -1.613, -2.644}, {"C33", 8.297, -3.925, -2.825}, {"C30", 8.347, -1.411, -3.899},
    {"C32", 8.835, -3.713, -4.077}, {"N4", 5.140, -6.344, 0.994},   {"C20", 3.942, -6.443, 0.154},
    {"C18", 5.771, -7.598, 1.436},  {"C19", 4.825, -8.772, 1.188},  {"S2", 3.661, -8.219, -0.097},
    {"C21", 7.051, -7.758, 0.671},  {"O5", 7.144, -7.353, -0.482},  {"N5", 8.035, -8.354, 1.333},
    {"C22", 9.411, -8.418, 0.822},  {"C23", 9.954, -7.028, 0.472},  {"C24", 9.495, -9.346, -0.392},
    {"C25", 10.278, -8.962, 1.951}};

Structure read(const std::string& text, BondSearch bonds = BondSearch::geometry) {
  const test::TemporaryFile file(text + "END\n");
  ReadOptions options;
  options.hetero = true;
  options.bonds = bonds;
  return read_structure(file.path(), options);
}

/// Returns the bonds between residues by labels, such as "A:SER1:OG - B:LIG1:C1".
std::vector<std::string> bonds_between(const Structure& s) {
  std::vector<std::string> found;
  for (const Bond& bond : s.bonds)
    if (s.atoms[bond.first].residue != s.atoms[bond.second].residue)
      found.push_back(label(s, bond.first) + " - " + label(s, bond.second));
  return found;
}

std::string notes_of(const Structure& s) {
  std::string text;
  for (const std::string& note : s.notes) text += note + '\n';
  return text;
}

/// Returns the colliding pairs of the first model by labels.
std::vector<std::string> collisions(Structure s, const char* rules = "auto") {
  const auto molecule = std::make_shared<const Molecule>(std::move(s));
  CheckOptions options;
  options.thresholds.rules = rules;
  Checker checker(molecule, molecule->select({}), options);
  const Structure& read = molecule->structure();
  std::vector<std::string> found;
  for (const Contact& pair : checker.check_coordinates(read.models.front(), Mode::parse("all")).pairs)
    found.push_back(label(read, static_cast<std::uint32_t>(index(pair.hit.first))) + " - " +
                    label(read, static_cast<std::uint32_t>(index(pair.hit.second))));
  return found;
}

bool has(const std::vector<std::string>& list, const std::string& word) {
  return std::find(list.begin(), list.end(), word) != list.end();
}

TEST(BondsByDistance, ALigandInARingIsACollisionAndNoBond) {
  const std::string ring = residue("PHE", 'B', phenylalanine), ligand = residue("KNI", 'L', inhibitor);
  const Structure one = read(ring + ligand);
  EXPECT_TRUE(bonds_between(one).empty());
  EXPECT_NE(notes_of(one).find("B:PHE1:CD1 - L:KNI1:O2, 1.703 angstrom: "), std::string::npos) << notes_of(one);
  for (const char* rules : {"auto", "severe", "biocd", "molprobity", "posebusters"}) {
    const auto found = collisions(one, rules);
    EXPECT_TRUE(has(found, "B:PHE1:CD1 - L:KNI1:O2")) << rules;
    // The same coordinates in two files.
    std::vector<Structure> two;
    two.push_back(read(ring));
    two.push_back(read(ligand));
    EXPECT_EQ(collisions(join_structures(std::move(two)), rules), found) << rules;
  }
  const test::TemporaryFile file(ring + ligand + "END\n");
  EXPECT_EQ(test::run_biocd("check " + file.path().string() + " --hetero --dictionary none 2>/dev/null").status, 1);
  EXPECT_EQ(
      test::run_biocd("check " + file.path().string() + " --hetero --dictionary none --rules posebusters 2>/dev/null")
          .status,
      1);
}

/// Side chain of a serine whose oxygen bears an acyl group of a ligand. acyl(): C1 with its O and its CH3; length: O-C1
/// distance, angstrom.
const std::vector<Placed> serine{{"CA", -2.043, 1.935, 0.0}, {"CB", -0.541, 1.322, 0.4}, {"OG", 0.0, 0.0, 0.0}};
std::vector<Placed> acyl(double length, double x = 1.0) {
  // Planar, with O-C=O 124 and O-C-C 111 degrees.
  return {{"C1", x * length, 0.0, 0.0},
          {"O1", x * length + 1.22 * 0.559, 1.22 * 0.829, 0.0},
          {"C2", x * length + 1.51 * 0.358, -1.51 * 0.934, 0.0}};
}

TEST(BondsByDistance, CovalentLigandsAreBondedByNameAndLength) {
  const std::string text = residue("SER", 'A', serine) + residue("LIG", 'B', acyl(1.35));
  const Structure s = read(text);
  EXPECT_EQ(bonds_between(s), std::vector<std::string>{"A:SER1:OG - B:LIG1:C1"});
  EXPECT_NE(notes_of(s).find("bond found by distance, not recorded in the file: A:SER1:OG - B:LIG1:C1, 1.350 angstrom"),
            std::string::npos)
      << notes_of(s);
  EXPECT_TRUE(collisions(s).empty());

  const Structure recorded = read(text, BondSearch::recorded);
  EXPECT_TRUE(bonds_between(recorded).empty());
  EXPECT_TRUE(has(collisions(recorded), "A:SER1:OG - B:LIG1:C1"));

  const test::TemporaryFile file(text + "END\n");
  const std::string check = "check " + file.path().string() + " --hetero --dictionary none --free none";
  const auto said = test::run_biocd(check + " 2>&1");
  EXPECT_EQ(said.status, 0);
  EXPECT_NE(said.out.find("A:SER1:OG - B:LIG1:C1, 1.350 angstrom"), std::string::npos) << said.out;
  EXPECT_EQ(test::run_biocd(check + " --bonds recorded 2>/dev/null").status, 1);
  EXPECT_NE(test::run_biocd(check + " --json 2>/dev/null").out.find("A:SER1:OG - B:LIG1:C1, 1.350 angstrom"),
            std::string::npos);
}

TEST(BondsByDistance, AreRefusedWithoutRoomOrWithTheWrongLengthOrAngles) {
  const auto refused = [](const std::string& text) {
    const Structure s = read(text);
    EXPECT_TRUE(bonds_between(s).empty()) << text;
    EXPECT_FALSE(collisions(s).empty()) << text;
  };
  const std::string bearer = residue("SER", 'A', serine);
  refused(bearer + residue("LIG", 'B', acyl(1.66)));  // 0.24 A longer than the sum of the radii
  refused(bearer + residue("LIG", 'B', acyl(0.95)));
  // The hydroxyl already has its hydrogen.
  auto with_hydrogen = serine;
  with_hydrogen.push_back({"HG", 0.3, -0.6, -0.7});
  refused(residue("SER", 'A', with_hydrogen) + residue("LIG", 'B', acyl(1.35)));
  // First an acyl carbon that already has three bonds, then an angle of 180 degrees at the oxygen.
  auto full = acyl(1.35);
  full.push_back({"C3", 1.35 + 0.3, 0.2, 1.45});
  full[1] = {"C4", 1.35 + 1.45 * 0.559, 1.45 * 0.829, 0.3};
  full.push_back({"C5", 1.35 + 0.3, 0.2, -1.45});
  refused(bearer + residue("LIG", 'B', full));
  refused(residue("SER", 'A', {{"CA", -2.0, 1.4, 0.0}, {"CB", -1.43, 0.0, 0.0}, {"OG", 0.0, 0.0, 0.0}}) +
          residue("LIG", 'B', acyl(1.35)));
  // A carbon of an amino acid has no free valence, at any angles.
  refused(residue("ALA", 'A', {{"CA", -0.541, 1.322, 0.4}, {"CB", 0.0, 0.0, 0.0}}) + residue("LIG", 'B', acyl(1.5)));
}

// An isopeptide bond of lysine. The file may hold the one hydrogen that is left; an amine with two has no room.
TEST(BondsByDistance, AnAmideNitrogenMayHaveItsHydrogenInTheFile) {
  std::vector<Placed> lysine{{"CD", -2.1, 0.9, 0.9}, {"CE", -0.75, 1.25, 0.0}, {"NZ", 0.0, 0.0, 0.0}};
  lysine.push_back({"HZ1", -0.5, -0.87, 0.0});
  EXPECT_EQ(bonds_between(read(residue("LYS", 'A', lysine) + residue("LIG", 'B', acyl(1.34)))),
            std::vector<std::string>{"A:LYS1:NZ - B:LIG1:C1"});
  lysine.push_back({"HZ2", -0.3, -0.2, 0.95});
  EXPECT_TRUE(bonds_between(read(residue("LYS", 'A', lysine) + residue("LIG", 'B', acyl(1.34)))).empty());
}

/// Returns CB and SG of two cysteines. length: from SG to SG, angstrom. bent: the angle at both sulphurs is 104
/// degrees, otherwise one is 180.
std::string cysteines(bool bent, double length = 2.05) {
  const Placed sulphur{"SG", length, 0.0, 0.0};
  const Placed carbon = bent ? Placed{"CB", length + 0.438, 0.0, 1.756} : Placed{"CB", length + 1.81, 0.0, 0.0};
  return residue("CYS", 'A', {{"CB", -0.438, 1.756, 0.0}, {"SG", 0.0, 0.0, 0.0}}) +
         residue("CYS", 'B', {carbon, sulphur});
}

TEST(BondsByDistance, DisulphidesWithoutARecord) {
  const Structure s = read(cysteines(true));
  ASSERT_EQ(bonds_between(s), std::vector<std::string>{"A:CYS1:SG - B:CYS1:SG"});
  EXPECT_EQ(std::count_if(s.bonds.begin(), s.bonds.end(),
                          [](const Bond& bond) { return bond.origin == BondOrigin::disulphide; }),
            1);
  EXPECT_NE(notes_of(s).find("A:CYS1:SG - B:CYS1:SG, 2.050 angstrom"), std::string::npos) << notes_of(s);
  EXPECT_TRUE(bonds_between(read(cysteines(false))).empty());
  for (const auto& [length, bonds] :
       {std::pair(1.79, 0U), std::pair(1.81, 1U), std::pair(2.29, 1U), std::pair(2.31, 0U)})
    EXPECT_EQ(bonds_between(read(cysteines(true, length))).size(), bonds) << length;
  EXPECT_TRUE(bonds_between(read(cysteines(true), BondSearch::recorded)).empty());
  // A third sulphur nearby finds no free partner.
  const std::string third = residue("CYS", 'C', {{"CB", -0.438, -1.756, 0.3}, {"SG", -2.0, -0.9, 0.2}});
  EXPECT_EQ(bonds_between(read(cysteines(true) + third)).size(), 1U);
}

TEST(BondsByDistance, MetalsBindDonorsAndNothingElse) {
  const auto beside = [](const char* name, double length) {
    const Placed far{"C9", length + 0.6, 1.3, 0.0};
    return residue("LIG", 'B', {{name, length, 0.0, 0.0}, far, {"C8", length + 0.7, -1.3, 0.1}});
  };
  const std::string zinc = residue("ZN", 'A', {{"ZN", 0.0, 0.0, 0.0}});
  EXPECT_EQ(bonds_between(read(zinc + beside("N1", 2.05))).size(), 1U);
  for (const auto& [name, length] : {std::pair("C1", 2.05), std::pair("N1", 1.2)}) {
    const Structure s = read(zinc + beside(name, length));
    EXPECT_TRUE(bonds_between(s).empty()) << name;
  }
}

TEST(BondsByDistance, AFoldedLigandCollidesWithItself) {
  // The side chain of a benzene ring folds back over it: O1 is 1.70 A above C4.
  std::vector<Placed> atoms{{"C1", 1.39, 0.0, 0.0},  {"C2", 0.695, 1.204, 0.0},   {"C3", -0.695, 1.204, 0.0},
                            {"C4", -1.39, 0.0, 0.0}, {"C5", -0.695, -1.204, 0.0}, {"C6", 0.695, -1.204, 0.0},
                            {"C7", 2.2, 0.0, 1.27},  {"C8", 1.2, 0.0, 2.5},       {"C9", -0.28, 0.0, 2.55},
                            {"O1", -1.4, 0.0, 1.7}};
  const Structure s = read(residue("LIG", 'A', atoms));
  EXPECT_EQ(s.bonds.size(), 10U);  // six in the ring, four in the chain
  EXPECT_TRUE(has(collisions(s), "A:LIG1:C4 - A:LIG1:O1"));
}

}  // namespace bonds_by_distance_test
}  // namespace hinge::molecular
