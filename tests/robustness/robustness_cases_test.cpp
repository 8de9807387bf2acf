// SPDX-License-Identifier: BSD-3-Clause
// Tests the program robustness_cases: exit status, output lines, and messages about invalid files.
#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "tool/run_tool.hpp"

namespace robustness_cases_test {

using hinge::test::Said;

/// A temporary folder; the destructor removes it.
class Folder {
 public:
  Folder() : path_(std::filesystem::temp_directory_path() / ("robustness_cases-" + std::to_string(getpid()))) {
    std::filesystem::create_directories(path_);
  }
  ~Folder() { std::filesystem::remove_all(path_); }
  Folder(const Folder&) = delete;
  Folder& operator=(const Folder&) = delete;

  std::string write(const std::string& name, const std::string& content) const {
    std::ofstream(path_ / name) << content;
    return (path_ / name).string();
  }
  const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
};

Said run(const std::filesystem::path& folder, const char* more = "") {
  std::string arguments = "'";
  arguments.append(folder.string()).append("' ").append(more);
  return hinge::test::run_tool(HINGE_ROBUSTNESS_CASES, arguments);
}

std::vector<std::string> lines_of(const std::string& text) {
  std::vector<std::string> lines;
  for (std::size_t start = 0, end = 0; (end = text.find('\n', start)) != std::string::npos; start = end + 1)
    lines.push_back(text.substr(start, end - start));
  return lines;
}

const std::string triangles =
    R"({"id":"t","kind":"tri_tri",)"
    R"("a":["0x0p+0","0x0p+0","0x0p+0","0x1p+0","0x0p+0","0x0p+0","0x0p+0","0x1p+0","0x0p+0"],)"
    R"("b":["0x0p+0","0x0p+0","0x1p+1","0x1p+0","0x0p+0","0x1p+1","0x0p+0","0x1p+0","0x1p+1"])";

std::string atoms(const std::string& x, const std::string& thresholds, const std::string& more = "") {
  return R"({"id":"p","kind":"atoms","n":2,"x":[)" + x + R"(],"type":[0,0],"group":[0,1],"ntypes":1,"M":[)" +
         thresholds + R"(],"excluded":[])" + more + "}\n";
}
const std::string two_points = R"("0x0p+0","0x0p+0","0x0p+0","0x1p+0","0x0p+0","0x0p+0")";

TEST(RobustnessCases, AnswersWithoutJudgingWhatHoldsNoTruth) {
  const Folder folder;
  folder.write("a.jsonl", triangles + "}\n\n" + atoms(two_points, "\"0x1.8p+0\""));
  folder.write("ignored.txt", "no case");
  const Said said = run(folder.path(), "2>&1");
  EXPECT_EQ(said.status, 0);
  const auto lines = lines_of(said.out);
  ASSERT_EQ(lines.size(), 6U) << said.out;
  EXPECT_EQ(lines[0], R"({"id":"t","engine":"brute","refused":false,"hit":false,"pair_count":0,"distance":"0x1p+1"})");
  EXPECT_EQ(lines[5], R"({"id":"p","engine":"simd","refused":false,"hit":true,"pair_count":1,"distance":"0x1p+0"})");
}

TEST(RobustnessCases, CountsCasesAndEnginesWhereTheTruthIsThere) {
  const Folder folder;
  const std::string right = R"(,"intersect":false,"dist":"0x1p+1"})", wrong = R"(,"intersect":true,"dist":"0x0p+0"})";
  folder.write("a.jsonl", triangles + right + "\n");
  Said said = run(folder.path(), "2>&1");
  EXPECT_EQ(said.status, 0);
  EXPECT_EQ(lines_of(said.out).back(), "passed 3, failed 0");
  folder.write("b.jsonl", triangles + wrong + "\n");
  said = run(folder.path(), "2>/dev/null");
  EXPECT_EQ(said.status, 1);
  EXPECT_EQ(lines_of(said.out).back(), "passed 3, failed 3");
  // The error is more than 16 ulp.
  folder.write("b.jsonl", triangles + R"(,"intersect":false,"dist":"0x1.00000000001p+1"})" + "\n");
  EXPECT_EQ(run(folder.path(), "2>&1 >/dev/null").status, 1);
}

TEST(RobustnessCases, ReportsRefusals) {
  const Folder folder;
  const std::string nan = R"("0x0p+0","nan","0x0p+0","0x1p+0","0x0p+0","0x0p+0")";
  folder.write("a.jsonl", atoms(nan, "\"0x1p+0\"", R"(,"expect":"refuse","why":"NaN coordinate")"));
  Said said = run(folder.path(), "2>&1");
  EXPECT_EQ(said.status, 0);
  auto lines = lines_of(said.out);
  ASSERT_EQ(lines.size(), 4U) << said.out;
  for (std::size_t k = 0; k < 3; ++k) {
    const auto json = nlohmann::json::parse(lines[k]);
    EXPECT_EQ(json["refused"], true);
    EXPECT_NE(json["message"], "");
  }
  EXPECT_EQ(lines[3], "passed 3, failed 0");
  // A refusal fails if the case has an answer.
  folder.write("a.jsonl", atoms(nan, "\"0x1p+0\"", R"(,"collides":false,"pair_count":0,"pairs":[],"min_dist":null)"));
  said = run(folder.path(), "2>&1");
  EXPECT_EQ(said.status, 1);
  EXPECT_NE(said.out.find("p, simd, a link per group: refused: "), std::string::npos) << said.out;
}

TEST(RobustnessCases, NamesFileAndLineOfWhatIsNoCase) {
  const Folder folder;
  const std::string good = triangles + "}\n";
  const auto expect_refusal = [&](const std::string& line, const std::string& what) {
    const std::string file = folder.write("a.jsonl", good + line + "\n" + good);
    const Said said = run(folder.path(), "2>&1");
    EXPECT_EQ(said.status, 3);
    EXPECT_EQ(lines_of(said.out).size(), 1U) << said.out;
    EXPECT_EQ(said.out.find("robustness_cases: " + file + ":2: "), 0U) << said.out;
    EXPECT_NE(said.out.find(what), std::string::npos) << said.out;
  };
  expect_refusal("{\"id\":\"x\"", "parse error");
  expect_refusal("[1, 2]", "expected a JSON object");
  expect_refusal("\xff\xfe", "parse error");
  expect_refusal("{\"kind\":\"tri_tri\"}", "'id' is missing");
  expect_refusal(R"({"id":"x","kind":"spheres"})", "unknown kind 'spheres'");
  expect_refusal(R"({"id":"x","kind":"tri_tri","a":[]})", "'b' is missing");
  expect_refusal(R"({"id":"x","kind":"tri_tri","a":[1.5],"b":[]})", "'a': 1.5, expected a string holding a double");
  expect_refusal(R"({"id":"x","kind":"tri_tri","a":["1 2"],"b":[]})", "'a': 1 2, expected");
  expect_refusal(R"({"id":"x","kind":"tri_tri","a":["1e999"],"b":[]})", "'a': 1e999, expected");
  expect_refusal(R"({"id":"x","kind":"tri_tri","a":[""],"b":[]})", "expected a string holding a double");
  expect_refusal(atoms(two_points, "true"), "'M': true");
  expect_refusal(R"({"id":"x","kind":"chain","links":[{"parent":0.5}]})", "'parent': 0.5, expected a whole number");
  expect_refusal(R"({"id":"x","kind":"chain","links":[7]})", "'parent' is missing");
  expect_refusal(atoms(two_points, "\"1\"", R"(,"expect":"maybe")"), "'expect': \"maybe\"");
}

TEST(RobustnessCases, RefusesWhatIsNoFolderOfCases) {
  const Folder folder;
  Said said = run(folder.path(), "2>&1");
  EXPECT_EQ(said.status, 3);
  EXPECT_EQ(said.out, "robustness_cases: " + folder.path().string() + ": holds no .jsonl file\n");
  said = run(folder.path() / "missing", "2>&1");
  EXPECT_EQ(said.status, 3);
  EXPECT_NE(said.out.find("missing: cannot be read as a folder: "), std::string::npos) << said.out;
  std::filesystem::create_directory(folder.path() / "a.jsonl");
  said = run(folder.path(), "2>&1");
  EXPECT_EQ(said.status, 3);
  EXPECT_NE(said.out.find("a.jsonl:1: cannot be read"), std::string::npos) << said.out;
  EXPECT_EQ(hinge::test::run_tool(HINGE_ROBUSTNESS_CASES, "2>&1").status, 2);
}

}  // namespace robustness_cases_test
