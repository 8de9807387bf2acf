// SPDX-License-Identifier: BSD-3-Clause
// Tests biocd plan: what it writes is free and reaches the end, failures are said and keep what was found, bad input is
// refused.
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>

#include "molecular/run_biocd.hpp"
#include "molecular/test_files.hpp"

namespace hinge::molecular {
namespace biocd_plan_test {

using Json = nlohmann::json;
using test::run_biocd;

const std::string tail = " " + test::ubiquitin().string() + " --free A:72-76:phi,psi --exempt-reference ";

bool has(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

TEST(BiocdPlan, WritesAFreeMotion) {
  const test::TemporaryFile ends("", ".pdb"), motion("", ".pdb");
  const std::string in = ends.path().string(), out = motion.path().string();
  ASSERT_EQ(run_biocd("sample" + tail + "--collision-free -n 4 --seed 5 --out " + in).status, 0);
  std::size_t found = 0;
  for (int k = 1; k <= 4; ++k) {
    SCOPED_TRACE(k);
    const auto said = run_biocd("plan" + tail + "--tries 3000 --json --to " + in + ":" + std::to_string(k) + " --out " +
                                out + " 2>/dev/null");
    const Json json = Json::parse(said.out);
    EXPECT_EQ(said.status, json.at("reached") ? 0 : 5);
    found += json.at("reached") ? 1 : 0;
    EXPECT_LT(json.at("to").at("model_rmsd"), 0.02);
    EXPECT_EQ(json.at("to").at("model_atoms"), 602);
    const Json check = Json::parse(run_biocd("check " + out + " --exempt-reference --json").out);
    EXPECT_EQ(check.at("conformations").size(), json.at("frames"));
    EXPECT_EQ(check.at("summary").at("colliding"), 0);
    // Each straight piece is free by biocd path as well.
    const auto text = [&](std::size_t w) {
      std::string list;
      for (const Json& value : json.at("waypoints")[w]) list += (list.empty() ? "" : ",") + value.dump();
      return list;
    };
    for (std::size_t w = 1; w < json.at("waypoints").size(); ++w)
      EXPECT_EQ(run_biocd("path" + tail + "--from=" + text(w - 1) + " --to=" + text(w)).status, 0);
  }
  EXPECT_GE(found, 2U);
}

TEST(BiocdPlan, KeepsLoopsClosed) {
  const test::TemporaryFile ends("", ".pdb"), motion("", ".pdb");
  const std::string loop = " " + test::ubiquitin().string() + " --loop A:7-13 --exempt-reference ";
  ASSERT_EQ(run_biocd("sample" + loop + "-n 2 --sigma 8 --filter free --out " + ends.path().string()).status / 2, 0);
  const auto said = run_biocd("plan" + loop + "--to " + ends.path().string() + " --tries 200 --out " +
                              motion.path().string() + " 2>/dev/null");
  EXPECT_TRUE(said.status == 0 || said.status == 5) << said.out;
  EXPECT_TRUE(has(said.out, "closures kept: 1; between waypoints they are open by at most")) << said.out;
  EXPECT_EQ(run_biocd("check " + motion.path().string() + " --exempt-reference").status, 0);
}

TEST(BiocdPlan, SaysWhatFails) {
  const auto colliding = run_biocd("plan" + tail + "--to 0,0,180,0,0,180,0,0,0 2>&1");
  EXPECT_EQ(colliding.status, 2) << colliding.out;  // nine values of ten
  const auto end = run_biocd("plan" + tail + "--to 0,90,-60,100,40,-70,0,0,60,0 2>&1");
  EXPECT_EQ(end.status, 1);
  EXPECT_TRUE(has(end.out, "the end collides in 10 pairs")) << end.out;
  EXPECT_TRUE(has(end.out, "note: a motion needs ends without collisions")) << end.out;
  const auto start = run_biocd("plan " + test::ubiquitin().string() + " --free A:72:chi1 --to 10 2>&1");
  EXPECT_EQ(start.status, 1);
  EXPECT_TRUE(has(start.out, "the start collides in 1 pair")) << start.out;
  // A fitted end that was not moved in time.
  const auto fitted =
      run_biocd("plan " + test::ubiquitin().string() + " --free A:72:chi1 --from model:1 --to 30 --time 1e-9 2>&1");
  EXPECT_EQ(fitted.status, 1);
  EXPECT_TRUE(has(fitted.out, "the start collides in 1 pair")) << fitted.out;
  // phi alone: the chain meets itself on both ways round.
  const test::TemporaryFile part("", ".pdb");
  const std::string none = "plan " + test::ubiquitin().string() +
                           " --free A:60:phi --exempt-reference --tries 50 --to 180 --out " + part.path().string();
  const auto stuck = run_biocd(none + " 2>&1");
  EXPECT_EQ(stuck.status, 5);
  EXPECT_TRUE(has(stuck.out, "no motion was found")) << stuck.out;
  EXPECT_TRUE(has(stuck.out, "angstrom from the end")) << stuck.out;
  EXPECT_TRUE(has(stuck.out, "these pairs collide")) << stuck.out;
  EXPECT_TRUE(has(stuck.out, "note: more free torsions")) << stuck.out;
  EXPECT_EQ(run_biocd("check " + part.path().string() + " --exempt-reference").status, 0);
  EXPECT_EQ(run_biocd(none + " --exit-zero 2>&1").status, 0);
  const auto timed = run_biocd("plan " + test::ubiquitin().string() +
                               " --free A:60:phi --exempt-reference --tries 100000000 --time 0.2 --to 180 2>&1");
  EXPECT_EQ(timed.status, 5);
  EXPECT_TRUE(has(timed.out, "note: --time has passed")) << timed.out;
}

TEST(BiocdPlan, RefusesBadEnds) {
  const std::string plan = "plan" + tail;
  EXPECT_EQ(run_biocd(plan + "2>/dev/null").status, 2);                   // no end
  EXPECT_EQ(run_biocd(plan + "--to missing.pdb 2>/dev/null").status, 3);  // no file
  EXPECT_EQ(run_biocd(plan + "--to model:9 2>/dev/null").status, 2);      // no model
  EXPECT_EQ(run_biocd(plan + "--to reference --step 0 2>/dev/null").status, 2);
  const std::string file = test::ubiquitin().string();
  const auto onto = run_biocd("plan " + file + " --free A:76:phi --to " + file + ":1 --out " + file + " 2>&1");
  EXPECT_EQ(onto.status, 2) << onto.out;
  const test::TemporaryFile end("", ".pdb");
  std::filesystem::copy_file(file, end.path(), std::filesystem::copy_options::overwrite_existing);
  const auto over = run_biocd(plan + "--to " + end.path().string() + ":1 --out " + end.path().string() + " 2>&1");
  EXPECT_EQ(over.status, 2) << over.out;
  EXPECT_EQ(std::filesystem::file_size(end.path()), std::filesystem::file_size(file));
}

}  // namespace biocd_plan_test
}  // namespace hinge::molecular
