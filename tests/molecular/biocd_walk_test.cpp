// SPDX-License-Identifier: BSD-3-Clause
// Tests biocd walk: every written conformation is free; rejected input; JSON output.
#include <gtest/gtest.h>

#include <cstdlib>
#include <nlohmann/json.hpp>
#include <string>

#include "molecular/run_biocd.hpp"
#include "molecular/test_files.hpp"

namespace hinge::molecular {
namespace biocd_walk_test {

using Json = nlohmann::json;
using test::run_biocd;

std::string file() { return test::ubiquitin().string(); }

TEST(BiocdWalk, WritesFreeConformationsThatDiffer) {
  const test::TemporaryFile models("");
  const std::string path = models.path().string();
  // The file's conformation is free under these rules, so check can verify the written file under the same rules.
  const std::string rules = " --rho 0.7 --hydrogens drop";
  const auto walked = run_biocd("walk " + file() + rules + " --steps 4000 --every 400 --seed 2 --json --out " + path);
  ASSERT_EQ(walked.status, 0);
  const Json json = Json::parse(walked.out);
  const Json& summary = json.at("summary");
  EXPECT_EQ(summary.at("steps"), 4000);
  EXPECT_EQ(summary.at("frames"), 10);
  EXPECT_EQ(summary["accepted"].get<int>() + summary["rejected"].get<int>(), 4000);
  EXPECT_GT(summary["accepted"].get<int>(), 1000);
  EXPECT_GT(summary["rejected"].get<int>(), 100);
  EXPECT_EQ(json.at("seed"), 2);
  EXPECT_EQ(json.at("changes"), 1);
  const auto checked = run_biocd("check " + path + rules + " --json --mode closest");
  const Json verdicts = Json::parse(checked.out).at("conformations");
  ASSERT_EQ(verdicts.size(), 10U);
  // Rounding to three decimals changes a distance by up to 0.0009 angstrom.
  for (const Json& verdict : verdicts)
    EXPECT_GT(verdict["closest"]["distance"].get<double>(), verdict["closest"]["threshold"].get<double>() - 0.001);
  EXPECT_NE(verdicts[0]["closest"], verdicts[9]["closest"]);
}

TEST(BiocdWalk, RefusesWhatCannotWalk) {
  const auto colliding = run_biocd("walk " + file() + " --steps 10 2>&1");
  EXPECT_EQ(colliding.status, 3);
  EXPECT_NE(colliding.out.find("collides in"), std::string::npos) << colliding.out;
  EXPECT_NE(colliding.out.find("--exempt-reference"), std::string::npos) << colliding.out;
  EXPECT_EQ(run_biocd("walk " + file() + " --steps 10 --exempt-reference").status, 0);
  for (const char* wrong : {"--steps 0", "--changes 0", "--every 0", "--free none", "--free A:48 --changes 7",
                            "--engine lazy", "--step-size 0", "--step-size -3", "--steps x"})
    EXPECT_EQ(run_biocd("walk " + file() + " --exempt-reference " + wrong + " 2>&1").status, 2) << wrong;
  EXPECT_EQ(run_biocd("walk " + file() + " --exempt-reference --steps 10 --out /nonexistent/x.pdb 2>&1").status, 3);
}

}  // namespace biocd_walk_test
}  // namespace hinge::molecular
