// SPDX-License-Identifier: BSD-3-Clause
// Tests the command line of biocd: exit status, JSON contract, determinism, messages.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <nlohmann/json.hpp>
#include <set>
#include <string>

#include "hinge/molecular/read_structure.hpp"
#include "hinge/primitive/point.hpp"
#include "molecular/run_biocd.hpp"
#include "molecular/test_files.hpp"

namespace hinge::molecular {
namespace biocd_test {

using Json = nlohmann::json;

using Outcome = test::Said;

/// Returns standard output and exit status; add `2>&1` to the arguments to include standard error.
Outcome biocd(const std::string& arguments) { return test::run_biocd(arguments); }

std::string file() { return test::ubiquitin().string(); }

std::string content(const std::filesystem::path& path) {
  std::ifstream stream(path);
  return {std::istreambuf_iterator<char>(stream), {}};
}

TEST(Biocd, ExitsWithTheDocumentedStatus) {
  EXPECT_EQ(biocd("check " + file()).status, 1);
  EXPECT_EQ(biocd("check " + file() + " --exempt-reference").status, 0);
  EXPECT_EQ(biocd("info " + file()).status, 0);
  EXPECT_EQ(biocd("--version").status, 0);
  EXPECT_EQ(biocd("--help").status, 0);
  EXPECT_EQ(biocd("2>&1").status, 2);
  EXPECT_EQ(biocd("check 2>&1").status, 2);
  EXPECT_EQ(biocd("frobnicate 2>&1").status, 2);
  EXPECT_EQ(biocd("check " + file() + " --free A:5000 2>&1").status, 2);
  EXPECT_EQ(biocd("check " + file() + " --radii x 2>&1").status, 2);
  EXPECT_EQ(biocd("check " + file() + " --mode x 2>&1").status, 2);
  EXPECT_EQ(biocd("sample " + file() + " -n 0 2>&1").status, 2);
  EXPECT_EQ(biocd("sample " + file() + " --sigma -1 2>&1").status, 2);
  EXPECT_EQ(biocd("check /nonexistent.pdb 2>&1").status, 3);
  const test::TemporaryFile empty("");
  const Outcome refused = biocd("check " + empty.path().string() + " 2>&1");
  EXPECT_EQ(refused.status, 3);
  EXPECT_EQ(refused.out, "biocd: " + empty.path().string() + ": is empty, expected a PDB or mmCIF file\n");
}

TEST(Biocd, SaysWhatItRecognised) {
  const std::string dna = HINGE_SOURCE_DIR "/molecular/data/1bna.pdb";
  const Outcome table = biocd("info " + dna);
  EXPECT_NE(table.out.find("DNA: 24 residues, chains A B\n"), std::string::npos) << table.out;
  EXPECT_NE(table.out.find("torsions: alpha 22 beta 22 chi 24 epsilon 22 gamma 24 zeta 22\n"), std::string::npos);
  const Json json = Json::parse(biocd("info " + dna + " --json").out);
  EXPECT_EQ(json["residue_classes"]["DNA"]["residues"], 24);
  EXPECT_EQ(json["residue_classes"]["DNA"]["chains"]["B"], 12);
  EXPECT_EQ(json["torsions"]["gamma"], 24);
  ASSERT_EQ(json["bond_sources"].size(), 4U);
  EXPECT_EQ(json["bond_sources"][0], (Json{{"residue", "DA"}, {"source", "residue table"}, {"count", 4}}));
  const Outcome delta = biocd("check " + dna + " --free A:5:delta 2>&1");
  EXPECT_EQ(delta.status, 2);
  EXPECT_NE(delta.out.find("lies in the sugar ring"), std::string::npos) << delta.out;
}

TEST(Biocd, TakesComponentsFromFilesAndRefusesBadOnes) {
  std::string ligand;
  for (int k = 0; k < 4; ++k) {
    std::array<char, 100> line{};
    std::snprintf(line.data(), line.size(), "HETATM%5d  C%d  LGD B 401    %8.3f%8.3f%8.3f  1.00  0.00           C\n",
                  k + 1, k + 1, 1.2 * k, k % 2 == 0 ? 0.0 : 0.9, 0.0);
    ligand += line.data();
  }
  const test::TemporaryFile molecule(ligand);
  const auto component = [](const char* order) {
    return std::string("data_LGD\nloop_\n_chem_comp_bond.comp_id\n_chem_comp_bond.atom_id_1\n") +
           "_chem_comp_bond.atom_id_2\n_chem_comp_bond.value_order\nLGD C1 C2 SING\nLGD C2 C3 " + order +
           "\nLGD C3 C4 SING\n";
  };
  const test::TemporaryFile single(component("SING"), ".cif"), dual(component("DOUB"), ".cif"),
      bad(component("SOFT"), ".cif");
  const std::string info = "info " + molecule.path().string() + " --hetero --json --dictionary none";
  const auto dof = [&](const std::string& more) { return Json::parse(biocd(info + more).out)["model"]["dof"]; };
  EXPECT_EQ(dof(""), 1);
  EXPECT_EQ(dof(" --free B:401:C3-C2"), 1);
  EXPECT_EQ(dof(" --components " + single.path().string()), 1);
  EXPECT_EQ(dof(" --components " + dual.path().string() + " --components " + single.path().string()), 0);
  EXPECT_EQ(biocd(info + " --free B:401:C1-C2 2>&1").status, 2) << "a terminal bond";
  EXPECT_EQ(biocd(info + " --dictionary /nonexistent 2>&1").status, 2) << "given twice";
  EXPECT_EQ(biocd("info " + molecule.path().string() + " --hetero --dictionary /nonexistent 2>&1").status, 3);
  const Outcome refused = biocd(info + " --components " + bad.path().string() + " 2>&1");
  EXPECT_EQ(refused.status, 3);
  EXPECT_NE(refused.out.find(bad.path().string() + ": chem_comp_bond of order 'soft'"), std::string::npos)
      << refused.out;
}

TEST(Biocd, KeepsTheJsonContractOfInfo) {
  const Outcome outcome = biocd("info " + file() + " --json --atoms --free A:48");
  ASSERT_EQ(outcome.status, 0);
  const Json json = Json::parse(outcome.out);
  for (const char* key :
       {"atoms", "bonds", "residues", "chains", "dof", "rigid_groups", "excluded_pairs", "radii", "rho", "min_bonds"})
    EXPECT_TRUE(json.at("model").contains(key)) << key;
  EXPECT_EQ(json["model"]["atoms"], 602);
  EXPECT_EQ(json["model"]["dof"], 6);
  EXPECT_EQ(json["model"]["rigid_groups"], 7);
  ASSERT_EQ(json["atoms"].size(), 602U);
  for (const char* key :
       {"index", "name", "residue", "seq", "icode", "chain", "element", "type", "x", "y", "z", "group"})
    EXPECT_TRUE(json["atoms"][0].contains(key)) << key;
  EXPECT_EQ(json["atoms"][1]["name"], "CA");
  EXPECT_EQ(json["atoms"][1]["x"], 26.266);
  std::set<int> groups;
  for (const Json& atom : json["atoms"]) groups.insert(atom["group"].get<int>());
  EXPECT_EQ(groups.size(), 7U);
  EXPECT_EQ(json["bonds"].size(), 608U);
  EXPECT_EQ(json["bonds"][0].size(), 2U);
  for (const Json& row : json["thresholds"]) EXPECT_EQ(row.size(), 3U);
  ASSERT_EQ(json["constant_contacts"].size(), 1U);
  for (const char* key : {"i", "j", "distance", "threshold"}) EXPECT_TRUE(json["constant_contacts"][0].contains(key));
}

TEST(Biocd, KeepsTheJsonContractOfCheckAndSample) {
  for (const char* mode : {"any", "all", "within:0.5", "closest"})
    for (const std::string& command : {"check " + file(), "sample " + file() + " -n 5 --sigma 1 --free every:4"}) {
      SCOPED_TRACE(command + " " + mode);
      const Outcome outcome = biocd(command + " --json --mode " + mode);
      const Json json = Json::parse(outcome.out);
      bool collides = false;
      ASSERT_FALSE(json.at("conformations").empty());
      for (const Json& c : json["conformations"]) {
        EXPECT_TRUE(c.contains("index"));
        collides = collides || c.at("collides").get<bool>();
        EXPECT_EQ(c.contains("closest"), std::string(mode) == "closest");
        if (c.contains("closest")) {
          EXPECT_EQ(c["closest"]["collides"], c["collides"]);
        }
        for (const Json& pair : c.value("pairs", Json::array()))
          for (const char* key : {"i", "j", "label_i", "label_j", "distance", "threshold", "collides"})
            EXPECT_TRUE(pair.contains(key)) << key;
      }
      EXPECT_TRUE(json.contains("constant_contacts"));
      EXPECT_EQ(outcome.status, collides ? 1 : 0);
    }
}

TEST(Biocd, GivesIdenticalBytesForAnyThreadCount) {
  const std::string command = "sample " + file() + " -n 1500 --sigma 1 --free count:5 --seed 9 ";
  const auto folder = std::filesystem::temp_directory_path();
  const auto one = folder / "hinge-threads-1.pdb", three = folder / "hinge-threads-3.pdb";
  for (const char* output : {"--json", "--csv"}) {
    const Outcome a = biocd(command + output + " --threads 1 --out " + one.string());
    const Outcome b = biocd(command + output + " --threads 3 --out " + three.string());
    EXPECT_EQ(a.status, 1);
    EXPECT_FALSE(a.out.empty());
    EXPECT_TRUE(a.out == b.out);
    EXPECT_TRUE(content(one) == content(three));
  }
  const Structure written = read_structure(one);
  EXPECT_EQ(written.models.size(), 1500U);
  std::filesystem::remove(one);
  std::filesystem::remove(three);
}

TEST(Biocd, WritesConformationsThatCheckTheSame) {
  const auto out = std::filesystem::temp_directory_path() / "hinge-sampled.pdb";
  const Outcome sampled = biocd("sample " + file() + " -n 20 --sigma 0.3 --free all --json --out " + out.string());
  const Outcome checked = biocd("check " + out.string() + " --json");
  const Json a = Json::parse(sampled.out), b = Json::parse(checked.out);
  ASSERT_EQ(a["conformations"].size(), 20U);
  ASSERT_EQ(b["conformations"].size(), 20U);
  // The file has three decimals, so pairs near their threshold may differ; most pairs may not.
  for (std::size_t k = 0; k < 20; ++k) {
    const auto found = static_cast<double>(a["conformations"][k]["pairs"].size());
    EXPECT_NEAR(found, static_cast<double>(b["conformations"][k]["pairs"].size()), 1.0 + 0.1 * found);
  }
  std::filesystem::remove(out);
}

TEST(Biocd, LeavesNothingHalfWritten) {
  EXPECT_EQ(biocd("sample " + file() + " -n 1 --out /nonexistent/x.pdb 2>&1").status, 3);
  EXPECT_FALSE(std::filesystem::exists("/nonexistent/x.pdb.partial"));
}

TEST(Biocd, InformsAboutOrRefusesEveryFile) {
  for (const std::filesystem::path& file : test::molecule_files()) {
    const std::string extension = file.extension().string();
    if (extension == ".md" || extension == ".dcd" || extension == ".xtc") continue;
    SCOPED_TRACE(file.string());
    const Outcome outcome = biocd("info " + file.string() + " --free none 2>&1 >/dev/null");
    if (outcome.status == 3) {
      EXPECT_TRUE(outcome.out.starts_with("biocd: ")) << outcome.out;
      EXPECT_EQ(std::count(outcome.out.begin(), outcome.out.end(), '\n'), 1) << outcome.out;
    } else {
      EXPECT_EQ(outcome.status, 0) << outcome.out;
    }
  }
}

/// Eighteen pairs of carbons with difference (1.632, 2.176, 0.000): 2.720 A in decimals, equal to 0.8 * (1.70 + 1.70).
std::string ties(bool cif) {
  std::string text;
  if (cif)
    for (const char* tag :
         {"group_PDB", "id", "type_symbol", "label_atom_id", "label_alt_id", "label_comp_id", "label_asym_id",
          "auth_seq_id", "Cartn_x", "Cartn_y", "Cartn_z", "occupancy", "B_iso_or_equiv"})
      text += std::string(text.empty() ? "data_x\nloop_\n" : "") + "_atom_site." + tag + "\n";
  for (int n = 0; n < 36; ++n) {
    const bool second = n % 2 == 1;
    const int cell = n / 2;
    const double x = 0.007 + 10.013 * (cell % 3) + (second ? 1.632 : 0.0),
                 y = 0.003 + 10.037 * (cell / 3 % 3) + (second ? 2.176 : 0.0),
                 z = 0.001 + 10.011 * std::floor(cell / 9.0);
    std::array<char, 100> line{};
    std::snprintf(line.data(), line.size(),
                  cif ? "ATOM %d C CA . GLY A %d %.3f %.3f %.3f 1.00 0.00\n"
                      : "ATOM  %5d  CA  GLY A%4d    %8.3f%8.3f%8.3f  1.00  0.00           C\n",
                  n + 1, n + 1, x, y, z);
    text += line.data();
  }
  return text + (cif ? "#\n" : "END\n");
}

TEST(Biocd, DecidesTiesOfAFileInDecimalsAndSaysTheSameEverywhere) {
  for (const bool cif : {false, true}) {
    SCOPED_TRACE(cif ? "mmCIF" : "PDB");
    const test::TemporaryFile file(ties(cif), cif ? ".cif" : ".pdb");
    const std::string path = file.path().string();
    const auto atoms = read_structure(path).models.front();
    std::size_t below = 0;
    for (std::size_t k = 0; k < atoms.size(); k += 2)
      below += closer_than(Point{atoms[k]}, Point{atoms[k + 1]}, 0.8 * (1.7 + 1.7)) ? 1 : 0;
    ASSERT_GT(below, 0U) << "the doubles are not below their threshold either, so this tests nothing";

    for (const char* mode : {"any", "all", "within:0.01", "closest"}) {
      SCOPED_TRACE(mode);
      const Outcome json = biocd("check " + path + " --json --mode " + mode + " 2>/dev/null");
      EXPECT_EQ(json.status, 0);
      const Json verdict = Json::parse(json.out).at("conformations").at(0);
      EXPECT_FALSE(verdict["collides"].get<bool>());
      for (const Json& pair : verdict.value("pairs", Json::array())) EXPECT_FALSE(pair["collides"].get<bool>());
      const Outcome table = biocd("check " + path + " --mode " + mode + " 2>/dev/null");
      EXPECT_EQ(table.status, 0);
      EXPECT_EQ(table.out.find(" < 2.72"), std::string::npos) << table.out;
      const Outcome csv = biocd("check " + path + " --csv --mode " + mode + " 2>/dev/null");
      EXPECT_EQ(csv.status, 0);
      EXPECT_EQ(csv.out.find(",1\n"), std::string::npos) << csv.out;
    }
    const Outcome within = biocd("check " + path + " --mode within:0.01 2>/dev/null");
    EXPECT_NE(within.out.find("18 pairs closer"), std::string::npos) << within.out;
    EXPECT_NE(within.out.find("2.720 >= 2.720"), std::string::npos) << within.out;
    EXPECT_EQ(Json::parse(biocd("info " + path + " --json 2>/dev/null").out)["model"]["reference_collisions"], 0);
    for (int k = 0; k < 36; k += 2)
      EXPECT_NE(
          biocd("check " + path + " --explain " + std::to_string(k) + "," + std::to_string(k + 1) + " 2>/dev/null")
              .out.find("not closer than"),
          std::string::npos);
  }
}

TEST(Biocd, ExplainsAPair) {
  EXPECT_NE(biocd("check " + file() + " --explain 0,1").out.find("1 bonds apart"), std::string::npos);
  EXPECT_NE(biocd("check " + file() + " --explain 0,500").out.find("kept"), std::string::npos);
  EXPECT_EQ(biocd("check " + file() + " --explain 0,9999 2>&1").status, 2);
  EXPECT_EQ(biocd("check " + file() + " --explain 4,4 2>&1").status, 2);
}

}  // namespace biocd_test
}  // namespace hinge::molecular
