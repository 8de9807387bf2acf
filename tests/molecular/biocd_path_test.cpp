// SPDX-License-Identifier: BSD-3-Clause
// Tests biocd path and PathChecker: verdicts, exit status, JSON contract, ends from lists, files and models, rejected
// input.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>
#include <numbers>
#include <string>
#include <vector>

#include "hinge/core/error.hpp"
#include "hinge/core/vec3.hpp"
#include "hinge/molecular/fit_torsions.hpp"
#include "hinge/molecular/path_checker.hpp"
#include "hinge/molecular/read_structure.hpp"
#include "hinge/molecular/sampler.hpp"
#include "hinge/molecular/selection.hpp"
#include "molecular/run_biocd.hpp"
#include "molecular/test_files.hpp"

namespace hinge::molecular {
namespace biocd_path_test {

using Json = nlohmann::json;
using test::Said;
using test::TemporaryFile;

constexpr double degree = std::numbers::pi / 180.0;

Said path(const std::string& arguments) {
  return test::run_biocd("path " + test::ubiquitin().string() + " --exempt-reference " + arguments);
}

/// Returns the exit status and standard error.
std::string refusal(const std::string& arguments) {
  const Said said = path("--free A:72:psi " + arguments + " 2>&1 >/dev/null");
  return std::to_string(said.status) + ": " + said.out;
}

std::shared_ptr<const Molecule> ubiquitin() {
  return std::make_shared<const Molecule>(read_structure(test::ubiquitin(), test::heavy_atoms()));
}

Checker checker(const std::shared_ptr<const Molecule>& molecule, const char* words) {
  CheckOptions options;
  options.exempt_reference = true;
  return {molecule, molecule->select(select_torsions(*molecule, words, false)), options};
}

TEST(BiocdPath, ExitsWithTheVerdict) {
  const std::string psi = "--free A:72:psi --from reference ";
  EXPECT_EQ(path(psi + "--to 20").status, 0);
  EXPECT_EQ(path(psi + "--to -90").status, 1);
  EXPECT_EQ(path(psi + "--to 20 --sampled 1").status, 0);
  EXPECT_EQ(path(psi + "--to -90 --sampled 1").status, 1);
  // The minimal step is so long that nothing is split: an interval that one test cannot prove stays undecided.
  const Said open = path("--free A:75-76 --from reference --to 179,0,0,0 --min-step 1 --json");
  ASSERT_EQ(open.status, 4);
  const Json json = Json::parse(open.out);
  EXPECT_EQ(json["verdict"], "undecided");
  EXPECT_EQ(json["proved"], false);
  EXPECT_GT(json["half_width"].get<double>(), 0.0);
  EXPECT_FALSE(json["undecided_pair"].at("collides").get<bool>());
  EXPECT_NE(path("--free A:75-76 --from reference --to 179,0,0,0 --min-step 1")
                .out.find("undecided: nothing is proved within"),
            std::string::npos);
}

TEST(BiocdPath, KeepsTheJsonContract) {
  const Said said = path("--free A:72:psi,A:74:phi --from 0,-3 --to 20,+3.5 --json");
  ASSERT_EQ(said.status, 0);
  const Json free = Json::parse(said.out);
  EXPECT_EQ(free["verdict"], "free");
  EXPECT_EQ(free["proved"], true);
  EXPECT_EQ(free["method"], "certified");
  EXPECT_EQ(free["dofs"].size(), 2U);
  EXPECT_EQ(free["from"]["turns"], Json({0.0, -3.0}));
  EXPECT_TRUE(free["parameter"].is_null());
  EXPECT_TRUE(free["from"]["model_rmsd"].is_null());
  EXPECT_TRUE(free["pairs"].empty());
  EXPECT_TRUE(free.contains("constant_contacts"));
  // A sampled path that is free is not proved.
  EXPECT_EQ(Json::parse(path("--free A:72:psi --from reference --to 20 --sampled 5 --json").out)["proved"], false);

  const Json hit = Json::parse(path("--free A:72:psi --from reference --to -90 --json").out);
  EXPECT_EQ(hit["verdict"], "colliding");
  const double t = hit["parameter"].get<double>();
  EXPECT_NEAR(hit["turns"][0].get<double>(), -90.0 * t, 1e-9);
  ASSERT_FALSE(hit["pairs"].empty());
  for (const Json& pair : hit["pairs"]) EXPECT_LT(pair["distance"].get<double>(), pair["threshold"].get<double>());
}

TEST(BiocdPath, NamesItsDofAsInfoDoes) {
  const Json path_json = Json::parse(path("--free A:72-74 --from reference --to reference --json").out);
  const Json info =
      Json::parse(test::run_biocd("info " + test::ubiquitin().string() + " --free A:72-74 --json --atoms").out);
  ASSERT_EQ(info["dofs"].size(), path_json["dofs"].size());
  for (std::size_t k = 0; k < info["dofs"].size(); ++k) EXPECT_EQ(info["dofs"][k]["torsion"], path_json["dofs"][k]);
}

TEST(BiocdPath, TakesEndsFromAFile) {
  const TemporaryFile list("0.5\n -3,\n", ".txt"), empty("", ".txt"), words("1 x\n", ".txt"), comma("1,,2", ".txt");
  const std::string two = "--free A:72:psi,A:74:phi --from reference --to @";
  const Json json = Json::parse(path(two + TemporaryFile("0.5\n-3\n", ".txt").path().string() + " --json").out);
  EXPECT_NEAR(json["to"]["turns"][1].get<double>(), -3.0, 1e-12);
  const auto said = [&](const TemporaryFile& file) {
    const Said outcome = path(two + file.path().string() + " 2>&1 >/dev/null");
    const std::string prefix = "biocd: " + file.path().string() + ": ";
    EXPECT_TRUE(outcome.out.starts_with(prefix)) << outcome.out;
    return std::to_string(outcome.status) + ": " + outcome.out.substr(std::min(prefix.size(), outcome.out.size()));
  };
  EXPECT_EQ(said(list), "3: ends with a comma, expected a value after it\n");
  EXPECT_EQ(said(empty),
            "3: 0 values, expected 2: the change from the reference, in degrees, for each DOF of the selection "
            "(translations of placed parts in angstrom)\n");
  EXPECT_EQ(said(words), "3: value 2 is 'x', expected a finite number of degrees, at most 1e+15\n");
  EXPECT_EQ(said(comma), "3: value 2 is '', expected a finite number of degrees, at most 1e+15\n");
  EXPECT_EQ(path(two + "/nonexistent 2>&1").out, "biocd: /nonexistent: cannot be opened: No such file or directory\n");
  EXPECT_EQ(path(two + "/tmp 2>&1").out, "biocd: /tmp: is a directory, expected a file\n");
}

TEST(BiocdPath, MovesPlacedParts) {
  const std::string u = test::ubiquitin().string();
  const std::string two = u + " --with " + u + " --between A B --free B:48:chi1 ";
  const auto ask = [](const std::string& arguments) {
    const test::Said said = test::run_biocd("path " + arguments + " --json 2>/dev/null");
    return nlohmann::json::parse(said.out);
  };
  // The first path keeps the parts apart, the second crosses the other part. Values are in the order of `dofs`.
  const auto beside = ask(two + "--place B --from 60,0,0,0,0,0,0 --to 60,20,0,90,-30,170,60");
  EXPECT_EQ(beside["dofs"], (std::vector<std::string>{"move B x", "move B y", "move B z", "turn B x", "turn B y",
                                                      "turn B z", "B:LYS48:chi1"}));
  EXPECT_EQ(beside["verdict"], "free");
  EXPECT_EQ(beside["proved"], true);
  EXPECT_EQ(beside["to"]["turns"][1], 20.0);
  EXPECT_NEAR(beside["to"]["turns"][5].get<double>(), 170.0, 1e-9);
  const auto through = ask(two + "--place B --from 60,0,0,0,0,0,0 --to -60,0,0,0,0,0,0");
  EXPECT_EQ(through["verdict"], "colliding");
  EXPECT_FALSE(through["pairs"].empty());
  EXPECT_EQ(ask(two + "--place B --from 60,0,0,0,0,0,0 --to -60,0,0,0,0,0,0 --sampled 30")["verdict"], "colliding");
  EXPECT_NE(test::run_biocd("path " + two + "--place B --from 60,0,0,0,0,0,0 --to 60,20,0,90,0,0,0")
                .out.find("largest turn 90 degrees (turn B x); largest move 20 angstrom (move B y)"),
            std::string::npos);

  // Models are rebuilt with their placements: the models that sample wrote are recovered within the decimals of their
  // file.
  const test::TemporaryFile poses("");
  test::run_biocd("sample " + two + " --place B=40,180 -n 6 --seed 8 --sigma 60 --out " + poses.path().string());
  const std::string models = poses.path().string() + " --place B --free B:48:chi1 --between A B --from model:1 --to ";
  for (int k = 2; k <= 6; ++k) {
    const auto answer = ask(models + "model:" + std::to_string(k));
    EXPECT_LE(answer["to"]["model_farthest"].get<double>(), 0.01) << k;
    for (const auto& turn : answer["from"]["turns"]) EXPECT_NEAR(turn.get<double>(), 0.0, 0.01);
  }
}

TEST(BiocdPath, RefusesEndsThatDoNotFit) {
  EXPECT_EQ(refusal("--from reference --to abc"),
            "2: biocd: --to 'abc': value 1 is 'abc', expected a finite number of degrees, at most 1e+15\n");
  EXPECT_EQ(refusal("--from nan --to 1"),
            "2: biocd: --from 'nan': value 1 is 'nan', expected a finite number of degrees, at most 1e+15\n");
  EXPECT_EQ(
      refusal("--from 1,2 --to 1"),
      "2: biocd: --from '1,2': 2 values, expected 1: the change from the reference, in degrees, for each DOF of the "
      "selection (translations of placed parts in angstrom)\n");
  EXPECT_EQ(refusal("--from model:1 --to model:2"), "2: biocd: --to model '2': expected the number of a model: 1\n");
  EXPECT_EQ(refusal("--from model:x --to 1"), "2: biocd: --from model 'x': expected the number of a model: 1\n");
  for (const char* options : {"--from 0", "--to 0", "--from 0 --to 1 --sampled 0", "--from 0 --to 1 --sampled -1",
                              "--from 0 --to 1 --sampled inf", "--from 0 --to 1 --min-step 0", "--from 0 --to 1 --csv",
                              "--from 0 --to 1 --sampled 1 --min-step 0.1", "--from 0 --to 1 --engine brute"})
    EXPECT_EQ(refusal(options).substr(0, 2), "2:") << options;
}

TEST(BiocdPath, JoinsModelsThatSampleWrote) {
  const auto out = std::filesystem::temp_directory_path() / "hinge-path-models.pdb";
  const std::string free = " --free A:70-76:backbone --omega";
  ASSERT_LE(
      test::run_biocd("sample " + test::ubiquitin().string() + free + " -n 3 --sigma 2 --seed 4 --out " + out.string())
          .status,
      1);
  const auto molecule = ubiquitin();
  const Checker free_end(molecule, molecule->select(select_torsions(*molecule, "A:70-76:backbone", true)), {});
  const Said said = test::run_biocd("path " + out.string() + free + " --from model:2 --to model:3 --json 2>/dev/null");
  ASSERT_LE(said.status, 1);
  const Json json = Json::parse(said.out);
  // Model 1 is the reference of the written file.
  const auto turns = [&](std::uint64_t k) { return sample_configuration({4, 2 * degree}, k, free_end.dof_count()); };
  const std::vector<double> first = turns(0), second = turns(1), third = turns(2);
  ASSERT_EQ(json["from"]["turns"].size(), first.size());
  for (std::size_t k = 0; k < first.size(); ++k) {
    // Coordinates of three decimals change torsions by some tenths of a degree.
    EXPECT_NEAR(json["from"]["turns"][k].get<double>(), (second[k] - first[k]) / degree, 0.5) << k;
    EXPECT_NEAR(json["to"]["turns"][k].get<double>(), (third[k] - first[k]) / degree, 0.5) << k;
  }
  EXPECT_LT(json["from"]["model_rmsd"].get<double>(), 0.01);
  EXPECT_LE(json["from"]["model_rmsd"].get<double>(), json["from"]["model_farthest"].get<double>());
  const std::string note =
      test::run_biocd("path " + out.string() + free + " --from model:2 --to model:3 2>&1 >/dev/null").out;
  EXPECT_NE(note.find("angstrom RMSD over 602 of 602 atoms"), std::string::npos) << note;
  std::filesystem::remove(out);
}

TEST(FitTurns, FindsTheConfigurationThatMadeTheCoordinates) {
  const auto molecule = ubiquitin();
  Checker all = checker(molecule, "all");
  for (std::uint64_t k = 0; k < 5; ++k) {
    const std::vector<double> q = sample_configuration({7, {}}, k, all.dof_count());
    all.check(q, Mode{Mode::Kind::any});
    const std::vector<double> found = fit_torsions(*molecule, all.selection(), all.positions());
    for (std::size_t d = 0; d < q.size(); ++d)
      ASSERT_NEAR(std::remainder(found[d] - q[d], 2 * std::numbers::pi), 0.0, 1e-9) << k << ' ' << d;
  }
  std::vector<Vec3> on_a_line(molecule->structure().atoms.size(), Vec3::Zero());
  EXPECT_THROW(fit_torsions(*molecule, all.selection(), on_a_line), LoadError);
}

TEST(FitTurns, TakesTheShorterWay) {
  const std::vector<double> near{3.0, -3.0, 0.5, 0.0};
  std::vector<double> turns{-3.0, 3.0, 0.4, 20.0};
  take_shorter_way(near, turns);
  const std::vector<double> expected{-3.0 + 2 * std::numbers::pi, 3.0 - 2 * std::numbers::pi, 0.4,
                                     20.0 - 6 * std::numbers::pi};
  for (std::size_t k = 0; k < turns.size(); ++k) EXPECT_NEAR(turns[k], expected[k], 1e-12);
}

/// Each slice tests an eighth of the paths to keep tests short; with HINGE_TEST_ALL 13 000 paths in all.
class PathCheckerSlice : public testing::TestWithParam<std::uint64_t> {};
INSTANTIATE_TEST_SUITE_P(All, PathCheckerSlice, testing::Range<std::uint64_t>(0, 8));

/// Tests free paths at 1000 states, and collisions by brute force at the reported state.
TEST_P(PathCheckerSlice, AgreesWithBruteForce) {
  const auto molecule = ubiquitin();
  const bool all = std::getenv("HINGE_TEST_ALL") != nullptr;
  int free = 0, colliding = 0, undecided = 0;
  struct Case {
    const char* words;
    double sigma;
    std::uint64_t paths;
  };
  for (const Case& c :
       {Case{"A:73-76", 15 * degree, all ? 6400U : 48U}, Case{"A:70-76", 4 * degree, all ? 3200U : 24U},
        Case{"count:5", 0.3 * degree, all ? 3200U : 16U}, Case{"all", 0.15 * degree, all ? 800U : 8U}}) {
    Checker asked = checker(molecule, c.words);
    PathChecker paths(asked);
    CheckOptions options;
    options.exempt_reference = true;
    options.engine = "brute";
    Checker brute(molecule, asked.selection(), options);
    for (std::uint64_t k = GetParam(); k < c.paths; k += 8) {
      SCOPED_TRACE(std::string(c.words) + ", seed 11, path " + std::to_string(k));
      const std::vector<double> from = sample_configuration({11, c.sigma}, 2 * k, asked.dof_count()),
                                to = sample_configuration({11, c.sigma}, 2 * k + 1, asked.dof_count());
      const PathAnswer answer = paths.certify(from, to);
      if (answer.verdict == PathVerdict::colliding) {
        ++colliding;
        EXPECT_TRUE(brute.check(answer.configuration, Mode{Mode::Kind::any}).collides);
      }
      undecided += answer.verdict == PathVerdict::undecided;
      if (!answer.is_free()) continue;
      ++free;
      std::vector<double> q(from);
      for (int state = 0; state < 1000; ++state) {
        for (std::size_t d = 0; d < q.size(); ++d) q[d] = from[d] + state / 999.0 * (to[d] - from[d]);
        // Brute force is a thousand times slower: use it at one state, and the engine, which is tested against it, at
        // all states.
        const Mode any{Mode::Kind::any};
        if (asked.check(q, any).collides || (state == 500 && brute.check(q, any).collides)) {
          ADD_FAILURE() << "called free, collides at state " << state;
          break;
        }
      }
    }
  }
  EXPECT_GT(free, all ? 400 : 2);
  EXPECT_GT(colliding, all ? 100 : 0);
  EXPECT_EQ(undecided, 0);
  RecordProperty("free", free);
  RecordProperty("colliding", colliding);
}

}  // namespace biocd_path_test
}  // namespace hinge::molecular
