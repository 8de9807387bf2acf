// SPDX-License-Identifier: BSD-3-Clause
// Tests biocd relax: the written file is free, the numbers agree, what is left is said, bad input is refused.
#include <gtest/gtest.h>

#include <array>
#include <fstream>
#include <map>
#include <nlohmann/json.hpp>
#include <string>

#include "hinge/core/vec3.hpp"
#include "molecular/run_biocd.hpp"
#include "molecular/test_files.hpp"

namespace hinge::molecular {
namespace biocd_relax_test {

using Json = nlohmann::json;
using test::run_biocd;

std::string file() { return " " + test::ubiquitin().string() + " "; }

bool has(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

TEST(BiocdRelax, WritesAFileWithoutClashes) {
  // --sigma 30 turns all side chains.
  const test::TemporaryFile turned(""), relaxed("");
  const std::string in = turned.path().string(), out = relaxed.path().string();
  for (const int seed : {1, 2, 3}) {
    SCOPED_TRACE(seed);
    run_biocd("sample" + file() + "--free chi --sigma 30 -n 1 --out " + in + " --seed " + std::to_string(seed));
    const auto before = run_biocd("check " + in + " --json");
    ASSERT_EQ(before.status, 1);
    const auto said = run_biocd("relax " + in + " --json --out " + out);
    ASSERT_EQ(said.status, 0) << said.out;
    const Json json = Json::parse(said.out);
    EXPECT_EQ(json.at("before").at("collisions"), Json::parse(before.out)["conformations"][0]["pairs"].size());
    EXPECT_EQ(json.at("before").at("pairs"), Json::parse(before.out)["conformations"][0]["pairs"]);
    EXPECT_EQ(json.at("after").at("collisions"), 0);
    EXPECT_TRUE(json.at("after").at("largest_overlap").is_null());
    EXPECT_GT(json.at("changes").size(), 5U);
    EXPECT_LE(json.at("rmsd"), json.at("rmsd_moved"));
    EXPECT_LE(json.at("rmsd_moved"), json.at("farthest"));
    EXPECT_EQ(run_biocd("check " + out).status, 0);
    // Relaxing it again moves nothing.
    const Json again = Json::parse(run_biocd("relax " + out + " --json").out);
    EXPECT_EQ(again.at("atoms_moved"), 0);
    EXPECT_TRUE(again.at("changes").empty());
  }
}

TEST(BiocdRelax, SaysWhatIsLeft) {
  // No torsion of residues 1 to 5 mends the clash in residue 72.
  const auto constant = run_biocd("relax" + file() + "--free \"A:1-5 and chi\" 2>&1");
  EXPECT_EQ(constant.status, 1);
  EXPECT_TRUE(has(constant.out, "note: 1 pair collides whatever the free torsions are")) << constant.out;
  EXPECT_EQ(run_biocd("relax" + file() + "--free \"A:1-5 and chi\" --exit-zero 2>/dev/null").status, 0);
  // Radii twice as large: hopeless, but not worse.
  const std::string hopeless = "relax" + file() + "--rho 1.6 --free A:70-76 ";
  const auto table = run_biocd(hopeless + "--tries 3 --max-pairs 2 2>&1");
  EXPECT_EQ(table.status, 1);
  EXPECT_TRUE(has(table.out, "these pairs still collide")) << table.out;
  EXPECT_TRUE(has(table.out, "after 3 restarts")) << table.out;
  const Json json = Json::parse(run_biocd(hopeless + "--tries 3 --json 2>/dev/null").out);
  EXPECT_LE(json.at("after").at("collisions"), json.at("before").at("collisions"));
  EXPECT_EQ(json.at("restarts"), 3);
  const auto timed = run_biocd(hopeless + "--tries 1000000 --time 0.2 2>&1");
  EXPECT_EQ(timed.status, 1);
  EXPECT_TRUE(has(timed.out, "--time has passed")) << timed.out;
}

/// Returns the backbone bonds of a file, from its columns: name of the residue -> distances N-CA, CA-C and C-N of the
/// next residue, angstrom.
std::map<int, std::array<double, 3>> backbone_bonds(const std::string& path) {
  std::map<int, std::map<std::string, Vec3>> atoms;
  std::ifstream in(path);
  for (std::string line; std::getline(in, line);)
    if (line.starts_with("ATOM"))
      atoms[std::stoi(line.substr(22, 4))][line.substr(13, 3)] = {
          std::stod(line.substr(30, 8)), std::stod(line.substr(38, 8)), std::stod(line.substr(46, 8))};
  std::map<int, std::array<double, 3>> bonds;
  for (auto& [number, residue] : atoms)
    if (atoms.contains(number + 1))
      bonds[number] = {norm(Vec3(residue["CA "] - residue["N  "])), norm(Vec3(residue["C  "] - residue["CA "])),
                       norm(Vec3(atoms[number + 1]["N  "] - residue["C  "]))};
  return bonds;
}

TEST(BiocdRelax, KeepsLoopsClosed) {
  const test::TemporaryFile relaxed("");
  const std::string out = relaxed.path().string();
  const auto said = run_biocd("relax" + file() + "--loop A:70-74 --free \"A:70-74 and chi\" --json --out " + out);
  ASSERT_EQ(said.status, 0) << said.out;
  const Json json = Json::parse(said.out);
  EXPECT_EQ(json.at("before").at("collisions"), 1);
  EXPECT_GT(json.at("atoms_moved"), 5);
  EXPECT_EQ(run_biocd("check " + out).status, 0);
  const auto before = backbone_bonds(test::ubiquitin().string()), after = backbone_bonds(out);
  ASSERT_EQ(after.size(), 75U);
  for (const auto& [number, bonds] : before)
    for (std::size_t k = 0; k < 3; ++k) EXPECT_NEAR(after.at(number)[k], bonds[k], 0.002) << number;
  EXPECT_EQ(Json::parse(run_biocd("relax" + file() + "--loop A:70-74 --json").out).at("model").at("free"),
            "(A:70-74) and chi");
}

TEST(BiocdRelax, SaysWhatExemptReferenceLeaves) {
  const auto noted = run_biocd("relax" + file() + "--exempt-reference 2>&1");
  EXPECT_EQ(noted.status, 0);
  EXPECT_TRUE(has(noted.out, "note: 1 pair collides in the file; --exempt-reference leaves")) << noted.out;
}

TEST(BiocdRelax, RefusesWhatCannotBeRelaxed) {
  EXPECT_EQ(run_biocd("relax" + file() + "--free none 2>/dev/null").status, 2);
  EXPECT_EQ(run_biocd("relax" + file() + "--tries 0 2>/dev/null").status, 2);
  EXPECT_EQ(run_biocd("relax" + file() + "--time 0 2>/dev/null").status, 2);
  EXPECT_EQ(run_biocd("relax" + file() + "--out relaxed.txt 2>/dev/null").status, 2);
  EXPECT_EQ(run_biocd("relax" + file() + "--out " + test::ubiquitin().string() + " 2>/dev/null").status, 2);
  EXPECT_EQ(run_biocd("relax no_such_file.pdb 2>/dev/null").status, 3);
}

}  // namespace biocd_relax_test
}  // namespace hinge::molecular
