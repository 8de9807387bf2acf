// SPDX-License-Identifier: BSD-3-Clause
// Tests that rows of JSON, whose lists of pairs are written without nlohmann's library, have the bytes that it writes.
#include <gtest/gtest.h>

#include <cstddef>
#include <nlohmann/json.hpp>
#include <sstream>
#include <string>

#include "molecular/run_biocd.hpp"
#include "molecular/test_files.hpp"

namespace hinge::molecular {
namespace biocd_json_test {

using Json = nlohmann::ordered_json;

/// Expects the bytes of dump() in every row, and returns the number of pairs.
std::size_t pairs_in_rows(const std::string& arguments) {
  const test::Said said = test::run_biocd(arguments + " --json 2>/dev/null");
  EXPECT_TRUE(said.status == 0 || said.status == 1) << arguments;
  std::istringstream lines(said.out);
  std::size_t pairs = 0, rows = 0;
  for (std::string line; std::getline(lines, line);) {
    if (line.rfind("{\"index\":", 0) != 0) continue;
    if (line.back() == ',') line.pop_back();
    const Json row = Json::parse(line);
    EXPECT_EQ(row.dump(), line) << arguments;
    const bool lists = arguments.find("closest") == std::string::npos && arguments.find("any") == std::string::npos;
    EXPECT_EQ(row.contains("pairs"), lists) << arguments;
    if (lists) {
      EXPECT_TRUE(row.at("pairs").is_array());
      for (const Json& pair : row.at("pairs")) EXPECT_TRUE(pair.at("i") < pair.at("j"));
      pairs += row.at("pairs").size();
    }
    ++rows;
  }
  EXPECT_GT(rows, 0U) << arguments;
  const Json all = Json::parse(said.out);
  EXPECT_EQ(all.at("conformations").size(), rows) << arguments;
  return pairs;
}

TEST(BiocdJson, RowsHaveTheBytesOfTheLibrary) {
  const std::string file = test::ubiquitin().string();
  for (const char* rules :
       {"", " --rules molprobity", " --rules chimerax", " --rules posebusters", " --rules severe"}) {
    EXPECT_GT(pairs_in_rows("sample " + file + " -n 5 --sigma 20 --mode within:0.5" + rules), 50U) << rules;
    pairs_in_rows("check " + file + " --mode within:0.5" + rules);
  }
  EXPECT_GT(pairs_in_rows("sample " + file + " -n 5 --sigma 20 --torsions --mode all --threads 2"), 50U);
  EXPECT_EQ(pairs_in_rows("sample " + file + " -n 3 --sigma 0.01 --free A:3:chi1 --exempt-reference"), 0U);
  pairs_in_rows("sample " + file + " -n 3 --mode closest");
  pairs_in_rows("sample " + file + " -n 3 --mode any");
}

}  // namespace biocd_json_test
}  // namespace hinge::molecular
