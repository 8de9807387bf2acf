// SPDX-License-Identifier: BSD-3-Clause
// Tests biocd with several molecules: files, placements, scopes of pairs, written files, rejected input.
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <cstddef>
#include <nlohmann/json.hpp>
#include <numbers>
#include <set>
#include <string>

#include "hinge/molecular/read_structure.hpp"
#include "molecular/run_biocd.hpp"
#include "molecular/test_files.hpp"

namespace hinge::molecular {
namespace biocd_scene_test {

using Json = nlohmann::json;
using test::run_biocd;
using test::Said;

std::string file() { return test::ubiquitin().string(); }

/// Arguments for two copies of the file; the second is placed.
std::string two() { return file() + " --with " + file() + " --place file:2=30,180 --free none"; }

TEST(BiocdScene, SamplesPlacementsAndWritesThem) {
  const test::TemporaryFile written("");
  const std::string question = "sample " + two() + " --between file:1 file:2 -n 12 --seed 3 --json";
  const Said said = run_biocd(question + " --out " + written.path().string() + " 2>/dev/null");
  ASSERT_EQ(said.status, 1);
  const Json json = Json::parse(said.out);
  const Json& model = json["model"];
  EXPECT_EQ(model["with"], Json::array({file()}));
  EXPECT_EQ(model["between"], Json::parse(R"([["file:1", "file:2"]])"));
  EXPECT_EQ(model["inside"], Json::array());
  EXPECT_EQ(model["dof"], 6);
  ASSERT_EQ(model["placed"].size(), 1U);
  EXPECT_EQ(model["placed"][0]["part"], "file:2");
  EXPECT_EQ(model["placed"][0]["atoms"], 602);
  EXPECT_EQ(model["placed"][0]["distance"], 30.0);
  EXPECT_NEAR(model["placed"][0]["degrees"].get<double>(), 180.0, 1e-12);
  const Json& c = model["placed"][0]["centre"];
  const Eigen::Vector3d centre(c[0], c[1], c[2]);

  const Structure one = read_structure(file()), samples = read_structure(written.path());
  ASSERT_EQ(samples.models.size(), 12U);
  ASSERT_EQ(samples.atoms.size(), 1204U);
  ASSERT_EQ(samples.chains.size(), 2U);
  EXPECT_EQ(samples.chains[1].name, "B");
  std::size_t colliding = 0;
  for (std::size_t k = 0; k < 12; ++k) {
    const Json& row = json["conformations"][k];
    const Json &move = row["placements"][0]["move"], &turn = row["placements"][0]["turn"];
    EXPECT_EQ(row["placements"][0]["part"], "file:2");
    const auto about = [&](int axis) {
      return Eigen::AngleAxisd(turn[static_cast<std::size_t>(axis)].get<double>() * std::numbers::pi / 180,
                               Eigen::Vector3d::Unit(axis));
    };
    const Eigen::Matrix3d rotation = (about(0) * about(1) * about(2)).toRotationMatrix();
    const Eigen::Vector3d by(move[0], move[1], move[2]);
    for (std::size_t i = 0; i < 602; ++i) {
      ASSERT_LT((samples.models[k][i] - one.models[0][i]).norm(), 1e-9);
      const Eigen::Vector3d expected = rotation * (one.models[0][i] - centre) + centre + by;
      ASSERT_LT((samples.models[k][602 + i] - expected).cwiseAbs().maxCoeff(), 0.0005001);
    }
    // Every pair is between the two copies.
    for (const Json& pair : row["pairs"]) EXPECT_TRUE(pair["i"] < 602 && pair["j"] >= 602);
    colliding += row["collides"].get<bool>() ? 1 : 0;
  }
  EXPECT_EQ(json["summary"]["colliding"], colliding);
  EXPECT_TRUE(colliding > 0 && colliding < 12);
  EXPECT_EQ(run_biocd(question + " --threads 2 2>/dev/null").out, said.out);
  EXPECT_EQ(Json::parse(run_biocd(question + " --engine lazy 2>/dev/null").out)["conformations"],
            json["conformations"]);
}

TEST(BiocdScene, SaysWhatTheGuideSays) {
  const std::string question = " --with " + file() + " --place file:2=40,180 --between file:1 file:2 2>/dev/null";
  EXPECT_NE(run_biocd("sample " + file() + " --free none" + question)
                .out.find("\n428 of 1000 conformations collide (42.80 %)"),
            std::string::npos);
}

TEST(BiocdScene, ChecksPosesOfOneFileAgainstAnother) {
  const test::TemporaryFile poses("");
  run_biocd("sample " + file() + " --place A=40,180 --free none -n 5 --seed 2 --out " + poses.path().string());
  const std::string question = "check " + file() + " --with " + poses.path().string() + " --between file:1 file:2";
  const Json json = Json::parse(run_biocd(question + " --mode closest --json 2>/dev/null").out);
  ASSERT_EQ(json["conformations"].size(), 5U);
  std::set<double> distances;
  for (const Json& row : json["conformations"]) {
    EXPECT_LT(row["closest"]["i"], 602);
    EXPECT_GE(row["closest"]["j"], 602);
    EXPECT_EQ(row["closest"]["label_j"].get<std::string>().substr(0, 2), "B:");
    distances.insert(row["closest"]["distance"].get<double>());
  }
  EXPECT_EQ(distances.size(), 5U);
}

TEST(BiocdScene, AddsColumnsForEachPlacedPart) {
  const Said said = run_biocd("sample " + two() + " -n 3 --csv --mode any 2>/dev/null");
  std::vector<std::string> lines(1);
  for (const char ch : said.out)
    if (ch == '\n')
      lines.emplace_back();
    else
      lines.back() += ch;
  ASSERT_EQ(lines.size(), 5U);
  EXPECT_EQ(lines[0],
            "index,collides,i,j,label_i,label_j,distance,threshold,pair_collides,overlap,file:2.x,file:2.y,file:2.z,"
            "file:2.rx,file:2.ry,file:2.rz");
  for (std::size_t k = 1; k <= 3; ++k) EXPECT_EQ(std::ranges::count(lines[k], ','), 15);
}

TEST(BiocdScene, SaysWhatItIsAbout) {
  const Said info = run_biocd("info " + file() + " --with " + file() + " --place B --between A B --inside B:1-10 2>&1");
  EXPECT_EQ(info.status, 0);
  for (const char* line :
       {"note: chain A of file 2 (1ubq) is called B here: an earlier file has a chain A\n",
        "placed: B, within 10 angstrom and 180 degrees, about (", "pairs: between A and B\n", "pairs: inside B:1-10\n"})
    EXPECT_NE(info.out.find(line), std::string::npos) << line << info.out;
  const Said why = run_biocd("info " + file() + " --inside A:1-10 --explain 0,601");
  EXPECT_NE(why.out.find("dropped      not in a pair of --between or --inside\n"), std::string::npos) << why.out;
  EXPECT_NE(run_biocd("check " + file() + " --with " + file()).out.find("placed: nothing\n"), std::string::npos);
}

TEST(BiocdScene, ExemptsInterfacesOnlyWhenAsked) {
  // The second copy is at the position of the first: nearly all atoms collide with the other copy.
  const auto model = [&](const std::string& options) {
    return Json::parse(
        run_biocd("info " + file() + " --with " + file() + options + " --json 2>/dev/null").out)["model"];
  };
  const Json none = model(""), inside = model(" --exempt-reference"),
             all = model(" --exempt-reference --exempt-interfaces");
  EXPECT_EQ(none["exempted_pairs"], 0);
  EXPECT_EQ(inside["exempted_pairs"], 2);  // one pair in each copy
  EXPECT_GT(all["exempted_pairs"].get<int>(), 600);
  EXPECT_EQ(all["exempted_pairs"], all["reference_collisions"]);
  // Placing one file, or both as one part, does not change the exempt pairs: contacts between files still count.
  const std::string pair = "info " + file() + " --with " + file() + " --exempt-reference --json 2>/dev/null --place ";
  EXPECT_EQ(Json::parse(run_biocd(pair + "file:2").out)["model"]["exempted_pairs"], 2);
  EXPECT_EQ(Json::parse(run_biocd(pair + "file:1+file:2").out)["model"]["exempted_pairs"], 2);
  EXPECT_EQ(run_biocd("info " + file() + " --exempt-interfaces 2>/dev/null").status, 2);
  const std::string table = run_biocd("check " + file() + " --with " + file() + " --exempt-reference --mode any").out;
  EXPECT_NE(table.find(" between molecules (--exempt-interfaces)"), std::string::npos) << table;
}

TEST(BiocdScene, RefusesWhatDoesNotFit) {
  const auto said = [&](const std::string& options) { return run_biocd("info " + file() + " " + options + " 2>&1"); };
  const auto expect = [&](const std::string& options, const std::string& message) {
    const Said outcome = said(options);
    EXPECT_EQ(outcome.status, 2) << options;
    EXPECT_EQ(outcome.out, "biocd: " + message + "\n");
  };
  const std::string chains = "expected a chain (A), the name of a residue, CHAIN:RESIDUES or file:N";
  expect("--place Q", "selection 'Q': " + chains);
  const std::string range =
      ": expected PART=DISTANCE,DEGREES, a distance from 0 to 1e+09 angstrom and an angle from 0 to 180";
  for (const char* bad : {"A=", "A=x", "A=-1", "A=nan", "A=inf", "A=3,", "A=3,181", "A=3,-1", "A=3,4,5", "A=3,nan"})
    expect(std::string("--place ") + bad, "--place '" + std::string(bad) + "'" + range);
  expect("--place A --place A", "placing 'A': A:MET1:N already belongs to placed part 'A'");
  expect("--between rest rest", "--between rest rest: expected at least one part, as in --between A rest");
  expect("--between A rest", "the rest of 'A' is empty: the part holds all residues, expected fewer");
  EXPECT_EQ(said("--between A").status, 2);
  EXPECT_EQ(said("--with /nonexistent.pdb").status, 3);
  EXPECT_NE(said("--place A:1-10").out.find("is bonded to"), std::string::npos);
}

}  // namespace biocd_scene_test
}  // namespace hinge::molecular
