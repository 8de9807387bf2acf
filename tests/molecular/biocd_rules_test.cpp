// SPDX-License-Identifier: BSD-3-Clause
// Tests biocd --rules: severities in every output, clashscore, rejected input.
#include <gtest/gtest.h>

#include <cstddef>
#include <cstdlib>
#include <memory>
#include <nlohmann/json.hpp>
#include <sstream>
#include <string>
#include <vector>

#include "molecular/run_biocd.hpp"
#include "molecular/test_files.hpp"

namespace hinge::molecular {
namespace biocd_rules_test {

using Json = nlohmann::json;
using test::run_biocd;

std::string file() { return test::ubiquitin().string(); }

std::vector<std::string> split(const std::string& text, char at) {
  std::vector<std::string> parts(1);
  for (const char c : text)
    if (c == at)
      parts.emplace_back();
    else
      parts.back() += c;
  return parts;
}

TEST(BiocdRules, AreNamedWithVersionAndRadii) {
  const Json plain = Json::parse(run_biocd("info " + file() + " --json 2>/dev/null").out)["model"];
  EXPECT_EQ(plain["rules"], "biocd");
  EXPECT_EQ(plain["radii"], "bondi");
  EXPECT_EQ(plain["rho"], 0.8);
  EXPECT_EQ(plain["min_bonds"], 4);
  EXPECT_EQ(plain["min_bonds_hydrogen"], 4);
  const Json model = Json::parse(run_biocd("info " + file() + " --rules molprobity --json 2>/dev/null").out)["model"];
  EXPECT_EQ(model["rules"], "molprobity");
  EXPECT_EQ(model["rules_version"], "2");
  EXPECT_EQ(model["radii"], "probe");
  EXPECT_TRUE(model["rho"].is_null());
  EXPECT_EQ(model["min_bonds"], 4);
  EXPECT_EQ(model["min_bonds_hydrogen"], 5);
  EXPECT_EQ(model["hydrogen_bond_allowance"], 0.6);
  const std::string heading = run_biocd("info " + file() + " --rules chimerax --free none 2>/dev/null").out;
  EXPECT_NE(heading.find("rule: chimerax v1 (chimerax v1 radii), pairs at least 5 bonds apart, not inside residues, "
                         "hydrogen-bond rule on\n"),
            std::string::npos)
      << heading;
}

TEST(BiocdRules, RefuseOptionsThatTheyFix) {
  for (const char* fixed : {"--radii bondi", "--rho 0.8", "--min-bonds 4", "--hbond on", "--hbond-allowance 0.4"}) {
    const auto said = run_biocd("check " + file() + " --rules molprobity " + fixed + " 2>&1");
    EXPECT_EQ(said.status, 2) << fixed;
    EXPECT_NE(said.out.find("clash rules molprobity set"), std::string::npos) << said.out;
  }
  const auto unknown = run_biocd("check " + file() + " --rules whatcheck 2>&1");
  EXPECT_EQ(unknown.status, 2);
  EXPECT_NE(unknown.out.find("expected one of biocd, severe, molprobity, chimerax, posebusters"), std::string::npos);
}

TEST(BiocdRules, SayTheSameInJsonAndCsv) {
  for (const char* rules : {"biocd", "molprobity", "chimerax", "posebusters"}) {
    const std::string question = "check " + file() + " --mode within:0.1 --rules " + rules;
    const Json json = Json::parse(run_biocd(question + " --json 2>/dev/null").out);
    std::vector<std::string> lines = split(run_biocd(question + " --csv 2>/dev/null").out, '\n');
    std::vector<std::string> columns = split(lines.front(), ',');
    columns.resize(columns.size() - 2);  // drops bond_residual and closure_residual, which belong to the conformation
    const Json& pairs = json["conformations"][0]["pairs"];
    ASSERT_GT(pairs.size(), 0U) << rules;
    ASSERT_EQ(lines.size(), pairs.size() + 2) << rules;
    for (std::size_t k = 0; k < pairs.size(); ++k) {
      const std::vector<std::string> row = split(lines[k + 1], ',');
      ASSERT_EQ(row.size(), columns.size() + 2);
      for (std::size_t c = 2; c < columns.size(); ++c) {
        const std::string key = columns[c] == "pair_collides" ? "collides" : columns[c];
        ASSERT_TRUE(pairs[k].contains(key)) << key;
        const Json& value = pairs[k][key];
        if (value.is_boolean())
          EXPECT_EQ(row[c], value.get<bool>() ? "1" : "0");
        else if (value.is_string())
          EXPECT_EQ(row[c], value.get<std::string>());
        else
          EXPECT_EQ(std::strtod(row[c].c_str(), nullptr), value.get<double>()) << key;
      }
    }
    const bool is_molprobity = std::string(rules) == "molprobity";
    EXPECT_EQ(json["summary"].contains("clashscore"), is_molprobity);
    if (is_molprobity) {
      std::size_t clashes = 0;
      for (const Json& pair : pairs) clashes += pair["class"] == "clash" ? 1 : 0;
      const double expected = 1000.0 * static_cast<double>(clashes) / json["model"]["atoms"].get<double>();
      EXPECT_DOUBLE_EQ(json["conformations"][0]["clashscore"].get<double>(), expected);
      EXPECT_DOUBLE_EQ(json["summary"]["clashscore"].get<double>(), expected);
    }
  }
}

TEST(BiocdRules, ExplainPairsInsideResiduesAndWithHydrogens) {
  const auto inside = run_biocd("info " + file() + " --rules chimerax --explain 11,16 2>/dev/null");
  EXPECT_NE(inside.out.find("dropped      both atoms in one residue"), std::string::npos) << inside.out;
  const auto names = run_biocd("info " + file() + " --rules molprobity --explain 0,300 2>/dev/null");
  EXPECT_NE(names.out.find("(probe v5, rules molprobity v2, hydrogen-bond rule on)"), std::string::npos) << names.out;
}

}  // namespace biocd_rules_test
}  // namespace hinge::molecular
