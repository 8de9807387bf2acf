// SPDX-License-Identifier: BSD-3-Clause
// Tests biocd sample with --loop and --closures: written files, reports, rejected input.
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <map>
#include <nlohmann/json.hpp>
#include <set>
#include <string>
#include <vector>

#include "hinge/detail/simd/instruction_set.hpp"
#include "molecular/run_biocd.hpp"
#include "molecular/test_files.hpp"

namespace hinge::molecular {
namespace biocd_loop_test {

using Json = nlohmann::json;
using test::run_biocd;

std::string file() { return test::ubiquitin().string(); }

/// Returns, per model, the coordinates of each atom by its name and residue, as text columns.
std::vector<std::map<std::string, std::string>> models_of(const std::filesystem::path& path) {
  std::ifstream stream(path);
  std::vector<std::map<std::string, std::string>> models(1);
  for (std::string line; std::getline(stream, line);) {
    if (line.starts_with("ENDMDL")) models.emplace_back();
    if (line.starts_with("ATOM")) models.back()[line.substr(12, 15)] = line.substr(30, 24);
  }
  if (models.back().empty()) models.pop_back();
  return models;
}

TEST(BiocdLoop, MovesTheLoopAndNothingElse) {
  const test::TemporaryFile out("");
  const auto said =
      run_biocd("sample " + file() + " --loop A:7-11 -n 20 --json --out " + out.path().string() + " 2>&1");
  ASSERT_TRUE(said.status == 0 || said.status == 1) << said.out;
  const auto reference = models_of(file()).front();
  const auto models = models_of(out.path());
  ASSERT_EQ(models.size(), 20U);
  std::set<std::string> moved;
  for (const auto& model : models)
    for (const auto& [atom, x] : model)
      if (x != reference.at(atom)) moved.insert(atom.substr(10, 5));  // residue number and insertion code
  for (const std::string& residue : moved) {
    const int number = std::stoi(residue);
    EXPECT_GE(number, 7);
    EXPECT_LE(number, 11);
  }
  EXPECT_EQ(moved.size(), 5U);
}

TEST(BiocdLoop, ReportsEachClosureByName) {
  const auto said = run_biocd("sample " + file() + " --loop A:7-11,A:45-50 -n 10 --json 2>/dev/null");
  const Json json = Json::parse(said.out);
  EXPECT_EQ(json.at("model").at("closures"), 2);
  EXPECT_EQ(json.at("model").at("loops"), "A:7-11,A:45-50");
  EXPECT_EQ(json.at("model").at("free"), "none");
  ASSERT_EQ(json.at("conformations").size(), 10U);
  for (const Json& row : json.at("conformations")) {
    ASSERT_EQ(row.at("closures").size(), 2U);
    EXPECT_EQ(row.at("closures")[0].at("bond"), "A:LYS11:CA - A:LYS11:C");
    for (const Json& closure : row.at("closures")) EXPECT_LE(closure.at("residual").get<double>(), 1e-6);
  }
  const Json& end = json.at("summary");
  EXPECT_EQ(end.at("missing"), 0);
  EXPECT_EQ(end.at("closed_refused"), 0);
  EXPECT_GE(end.at("starts_unclosed").get<int>(), 0);
  EXPECT_EQ(end.at("checked"), 10);
}

TEST(BiocdLoop, LeavesOutWhatDidNotCloseAndSaysSo) {
  // One start per sample: some fail, and failed starts must not appear as samples.
  const test::TemporaryFile out("");
  const auto said = run_biocd("sample " + file() + " --loop A:8-11 -n 60 --tries 1 --json --out " +
                              out.path().string() + " 2>/dev/null");
  const Json json = Json::parse(said.out);
  const auto missing = json.at("summary").at("missing").get<std::size_t>();
  ASSERT_GT(missing, 0U);
  ASSERT_LT(missing, 60U);
  EXPECT_EQ(json.at("summary").at("starts_unclosed"), missing);
  EXPECT_EQ(json.at("conformations").size(), 60 - missing);
  EXPECT_EQ(models_of(out.path()).size(), 60 - missing);
  std::set<int> indices;
  for (const Json& row : json.at("conformations")) indices.insert(row.at("index").get<int>());
  EXPECT_EQ(indices.size(), 60 - missing);
  const auto note = run_biocd("sample " + file() + " --loop A:8-11 -n 60 --tries 1 2>&1 >/dev/null");
  EXPECT_NE(note.out.find(std::to_string(missing) + " of 60 samples are missing: for " + std::to_string(missing) +
                          " of them, none of 1 starts closed"),
            std::string::npos)
      << note.out;
}

TEST(BiocdLoop, GivesCollisionFreeOnesOnRequest) {
  const auto said = run_biocd(
      "sample " + file() + " --loop A:7-11 --collision-free --tries 500 -n 10 --exempt-reference --json 2>/dev/null");
  EXPECT_EQ(said.status, 0);
  const Json json = Json::parse(said.out);
  ASSERT_EQ(json.at("conformations").size(), 10U);
  for (const Json& row : json.at("conformations")) EXPECT_FALSE(row.at("collides").get<bool>());
  EXPECT_EQ(json.at("prior"), "ramachandran");
}

TEST(BiocdLoop, WritesCollisionFreeLoopsWithoutFurtherOptions) {
  const test::TemporaryFile out("");
  const auto said = run_biocd("sample " + file() + " --loop A:8-17 --collision-free --exempt-reference -n 12 --out " +
                              out.path().string() + " 2>&1");
  EXPECT_EQ(said.status, 0) << said.out;
  EXPECT_EQ(models_of(out.path()).size(), 12U);
  EXPECT_NE(said.out.find("(A:8-17) and chi"), std::string::npos) << said.out;
  // Read again, the models are free: coordinates of a file have three decimals.
  const auto again = run_biocd("check " + out.path().string() + " --json 2>/dev/null");
  const Json checked = Json::parse(again.out);
  ASSERT_EQ(checked.at("conformations").size(), 12U);
  const Json reference = Json::parse(run_biocd("check " + file() + " --json 2>/dev/null").out);
  for (const Json& row : checked.at("conformations"))
    EXPECT_LE(row.at("pairs").size(), reference.at("conformations")[0].at("pairs").size());
}

TEST(BiocdLoop, SaysHowManySamplesAreMissingAndWhy) {
  const std::string question = "sample " + file() + " --free A:70-76 --rules biocd --rho 3 --collision-free -n 4";
  const auto said = run_biocd(question + " --tries 3 2>&1 >/dev/null");
  EXPECT_EQ(said.status, 5);
  EXPECT_NE(said.out.find("4 of 4 samples are missing: for 4 of them, none of 3 starts gave a conformation without a "
                          "collision; most often in the way: A:"),
            std::string::npos)
      << said.out;
  EXPECT_EQ(run_biocd(question + " --tries 3 --exit-zero >/dev/null 2>&1").status, 0);
  const Json json = Json::parse(run_biocd(question + " --tries 3 --json 2>/dev/null").out);
  EXPECT_EQ(json.at("summary").at("missing"), 4);
  EXPECT_EQ(json.at("summary").at("closed_refused"), 12);
  EXPECT_EQ(json.at("summary").at("out_of_time"), 0);
  const Json& pairs = json.at("summary").at("in_the_way");
  ASSERT_GT(pairs.size(), 1U);
  ASSERT_LE(pairs.size(), 10U);
  const auto often = [&](std::size_t k) { return pairs[k].at("count").get<std::uint64_t>(); };
  for (std::size_t k = 1; k < pairs.size(); ++k) EXPECT_GE(often(k - 1), often(k));
  for (const char* residue : {"label_i", "label_j"})
    EXPECT_NE(said.out.find(pairs[0].at(residue).get<std::string>()), std::string::npos) << said.out;
  // The time ends a run that would not end.
  const auto late = run_biocd(question + " --tries 1000000000 --time 0.5 2>&1 >/dev/null");
  EXPECT_EQ(late.status, 5);
  EXPECT_NE(late.out.find("for 4 of them, the time of --time was over"), std::string::npos) << late.out;
}

TEST(BiocdLoop, ChecksSamplesWithoutFreeTorsions) {
  const auto said = run_biocd("sample " + file() + " --free none -n 3 --json 2>/dev/null");
  EXPECT_EQ(said.status, 0);
  EXPECT_EQ(Json::parse(said.out).at("conformations").size(), 3U);
  const auto refused = run_biocd("sample " + file() + " --free none -n 3 --collision-free 2>&1");
  EXPECT_EQ(refused.status, 2);
  EXPECT_NE(refused.out.find("no torsion is free"), std::string::npos) << refused.out;
}

TEST(BiocdLoop, DrawsFromThePriorThatIsAskedFor) {
  const std::string question = "sample " + file() + " --free A:70-76 --exempt-reference -n 20 --collision-free --json";
  const auto row = [&](const std::string& more) {
    const auto said = run_biocd(question + more + " 2>/dev/null");
    EXPECT_EQ(said.status, 0);
    return Json::parse(said.out);
  };
  EXPECT_EQ(row("").at("prior"), "ramachandran");
  EXPECT_EQ(row(" --prior uniform").at("prior"), "uniform");
  EXPECT_EQ(row(" --sigma 5").at("prior"), "gaussian");
  EXPECT_EQ(row("").at("conformations")[0].at("starts"), 1);
  const auto refused = [&](const std::string& arguments, const char* text) {
    const auto said = run_biocd("sample " + file() + arguments + " 2>&1");
    EXPECT_EQ(said.status, 2);
    EXPECT_NE(said.out.find(text), std::string::npos) << said.out;
  };
  refused(" --prior uniform", "--prior: expected with --collision-free only");
  refused(" --time 3", "--time: expected with --collision-free only");
  refused(" --collision-free --prior uniform --sigma 3", "--prior and --sigma are both given");
  refused(" --collision-free --prior flat", "expected ramachandran or uniform");
}

TEST(BiocdLoop, IsNotNeededForCollisionFreeSamples) {
  const auto said = run_biocd("sample " + file() + " --free A:74-76 --collision-free -n 5 --exempt-reference --json" +
                              " 2>/dev/null");
  EXPECT_EQ(said.status, 0);
  const Json json = Json::parse(said.out);
  EXPECT_EQ(json.at("conformations").size(), 5U);
  EXPECT_EQ(json.at("summary").at("colliding"), 0);
  EXPECT_FALSE(json.at("summary").contains("in_the_way"));  // nothing is missing
}

TEST(BiocdLoop, RefusesWhatIsNoLoop) {
  const auto refused = [](const std::string& arguments) {
    const auto said = run_biocd("sample " + file() + " " + arguments + " 2>&1");
    EXPECT_EQ(said.status, 2) << said.out;
    return said.out;
  };
  EXPECT_NE(refused("--loop A:1-8").find("MET1 is the first residue of its chain"), std::string::npos);
  EXPECT_NE(refused("--loop A:70-76").find("GLY76 is the last residue of its chain"), std::string::npos);
  EXPECT_NE(refused("--loop A:36-38").find("has 4 torsions, expected at least 6"), std::string::npos);
  EXPECT_NE(refused("--loop A:10-20,A:15-25").find("shares residues with loop A:GLY10-SER20"), std::string::npos);
  EXPECT_NE(refused("--loop A:10-20 --free backbone").find("only side chains"), std::string::npos);
  EXPECT_NE(refused("--loop A:10").find("torsions"), std::string::npos);
  EXPECT_NE(refused("--loop nonsense").find("CHAIN:RESIDUES"), std::string::npos);
  refused("--closures maybe");
  refused("--loop A:10-20 --tries 0");
}

TEST(BiocdLoop, GivesTheSameBytesEverywhere) {
  const std::string question =
      "sample " + file() + " --loop A:7-11 --free A:7-11:chi -n 10 --collision-free --exempt-reference --json";
  const auto expected = run_biocd(question + " 2>/dev/null", "HINGE_ISA=baseline");
  ASSERT_FALSE(expected.out.empty());
  for (const char* more : {" --threads 2", " --threads 8", " --engine brute"})
    EXPECT_TRUE(run_biocd(question + more + " 2>/dev/null").out == expected.out) << more;
  for (const detail::simd::InstructionSet set :
       {detail::simd::InstructionSet::avx2, detail::simd::InstructionSet::avx512}) {
    const std::string name(detail::simd::name(set)), environment = "HINGE_ISA=" + name;
    if (set > detail::simd::of_this_cpu() ||
        run_biocd("--version", environment).out.find("(" + name + ")") == std::string::npos)
      continue;
    EXPECT_TRUE(run_biocd(question + " 2>/dev/null", environment).out == expected.out) << name;
  }
}

TEST(BiocdLoop, KeepsDisulphidesAndHydrogenBonds) {
  const auto pti = test::molecule_file("5pti.pdb");
  const auto run = [&](const std::string& more) {
    return Json::parse(run_biocd("sample " + pti.string() + " -n 10 --sigma 5 --json " + more + " 2>/dev/null").out);
  };
  const Json open = run("--closures open"), kept = run(""), bonded = run("--keep-hbonds");
  EXPECT_GT(open.at("summary").at("worst_closure_residual").get<double>(), 0.1);
  EXPECT_FALSE(open.at("summary").contains("missing"));
  EXPECT_LE(kept.at("summary").at("worst_closure_residual").get<double>(), 1e-6);
  EXPECT_EQ(kept.at("summary").at("checked"), 10);
  EXPECT_EQ(open.at("summary").at("closures").size(), 3U);
  EXPECT_EQ(open.at("model").at("held_torsions"), 0);
  EXPECT_GT(bonded.at("model").at("held_torsions").get<int>(), 0);
  EXPECT_LT(bonded.at("model").at("rigid_groups").get<int>(), kept.at("model").at("rigid_groups").get<int>());
  EXPECT_LE(bonded.at("summary").at("worst_closure_residual").get<double>(), 1e-6);
}

}  // namespace biocd_loop_test
}  // namespace hinge::molecular
