// SPDX-License-Identifier: BSD-3-Clause
// Tests biocd check --by: the table against a count of the listed pairs, and against shards that are merged.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <map>
#include <nlohmann/json.hpp>
#include <set>
#include <string>
#include <utility>

#include "molecular/run_biocd.hpp"
#include "molecular/test_files.hpp"
#include "tool/temporary_folder.hpp"

namespace hinge::molecular {
namespace biocd_clash_table_test {

using Json = nlohmann::json;
using test::run_biocd;

/// Frames of a protein that collide here and there.
class Frames {
 public:
  explicit Frames(const std::string& more = "") : file_("") {
    run_biocd("sample " + test::ubiquitin().string() + " --sigma 3 -n 30 --mode any --out " + path() + more +
              " >/dev/null 2>&1");
  }
  std::string path() const { return file_.path().string(); }

 private:
  test::TemporaryFile file_;
};

struct Counts {
  std::set<int> conformations;
  std::uint64_t pairs = 0;
  double overlap = -1e9;
};

TEST(BiocdBy, CountsTheListedPairs) {
  const Frames frames;
  for (const std::string by : {"residue", "chain"}) {
    const Json json = Json::parse(run_biocd("check " + frames.path() + " --json --by " + by + " 2>/dev/null").out);
    std::map<std::pair<std::string, std::string>, Counts> expected;
    for (const Json& row : json.at("conformations"))
      for (const Json& pair : row.at("pairs")) {
        const auto name = [&](const char* key) {
          const auto label = pair.at(key).get<std::string>();
          return label.substr(0, by == "residue" ? label.rfind(':') : label.find(':'));
        };
        Counts& counts = expected[{name("label_i"), name("label_j")}];
        counts.conformations.insert(row.at("index").get<int>());
        ++counts.pairs;
        counts.overlap = std::max(counts.overlap, pair.at("overlap").get<double>());
      }
    ASSERT_GT(expected.size(), by == "residue" ? 20U : 0U);
    const Json& summary = json.at("summary");
    EXPECT_EQ(summary.at("by"), by);
    ASSERT_EQ(summary.at("clashes").size(), expected.size());
    std::pair<std::uint64_t, std::uint64_t> before{1000, 0};
    for (const Json& row : summary.at("clashes")) {
      const Counts& counts = expected.at({row.at("first").get<std::string>(), row.at("second").get<std::string>()});
      EXPECT_EQ(row.at("conformations"), counts.conformations.size());
      EXPECT_EQ(row.at("pairs"), counts.pairs);
      EXPECT_EQ(row.at("overlap"), counts.overlap);
      const std::pair key{row.at("conformations").get<std::uint64_t>(), row.at("pairs").get<std::uint64_t>()};
      EXPECT_GE(before, key) << "most frequent first";
      before = key;
    }
  }
}

TEST(BiocdBy, PrintsOneTableInsteadOfLists) {
  const Frames frames;
  const auto table = run_biocd("check " + frames.path() + " --by residue --max-pairs 3 2>/dev/null");
  EXPECT_EQ(table.status, 1);
  EXPECT_NE(table.out.find("  residue 1    residue 2    conformations      pairs  largest overlap (A)\n"),
            std::string::npos)
      << table.out;
  EXPECT_NE(table.out.find("more; --max-pairs all lists them\n"), std::string::npos) << table.out;
  EXPECT_EQ(table.out.find("atom 1"), std::string::npos) << table.out;
}

TEST(BiocdBy, IsTheSameAfterMerging) {
  const Frames frames;
  const test::TemporaryFolder folder;
  const std::string question = "check " + frames.path() + " --json --by residue", parts = folder.path().string();
  ASSERT_EQ(run_biocd(question + " --unit 2 --parts " + parts + " 2>/dev/null").status, 0);
  EXPECT_EQ(run_biocd("merge " + parts).out, run_biocd(question + " 2>/dev/null").out);
}

TEST(BiocdBy, RefusesWhatHasNoTable) {
  const std::string check = "check " + test::ubiquitin().string() + " --by residue";
  for (const char* more : {" --csv", " --mode any", " --mode closest"}) {
    const auto said = run_biocd(check + more + " 2>&1");
    EXPECT_EQ(said.status, 2);
    EXPECT_NE(said.out.find("--by: expected"), std::string::npos) << said.out;
  }
  EXPECT_EQ(run_biocd("check " + test::ubiquitin().string() + " --by atom 2>&1").status, 2);
}

}  // namespace biocd_clash_table_test
}  // namespace hinge::molecular
