// SPDX-License-Identifier: BSD-3-Clause
// Tests the floor table and the house rules on every file, and that planted violations are found.
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <regex>
#include <set>
#include <sstream>
#include <string>
#include <vector>

#include "architecture/conventions.hpp"
#include "architecture/floors.hpp"
#include "architecture/public_face.hpp"
#include "architecture/source_tree.hpp"

namespace architecture_test {

using architecture::SourceTree;

const std::filesystem::path root = HINGE_SOURCE_DIR;

SourceTree library() { return architecture::read_sources(root, {"include", "molecular", "robotics", "python"}); }

std::string joined(const std::vector<std::string>& lines) {
  std::string text;
  for (const std::string& line : lines) text += "  " + line + "\n";
  return text;
}

/// If the source tree were not found, all tests below would pass on nothing.
TEST(SourceTree, FindsTheLibrary) {
  const SourceTree tree = library();
  EXPECT_GE(tree.size(), 40U);
  EXPECT_TRUE(tree.contains("include/hinge/hierarchy.hpp"));
  EXPECT_TRUE(tree.contains("python/src/module.cpp"));
}

TEST(Floors, NoIncludeClimbs) { EXPECT_EQ(joined(architecture::floor_violations(library())), ""); }

TEST(Floors, IncludesMakeNoCircle) { EXPECT_EQ(joined(architecture::include_circle(library())), ""); }

TEST(Floors, OraclesStayInTheirFolders) {
  EXPECT_EQ(joined(architecture::oracle_violations(
                architecture::read_sources(root, {"include", "molecular", "robotics", "tests", "bench", "docs"}))),
            "");
}

TEST(PublicFace, NamesNothingPrivate) { EXPECT_EQ(joined(architecture::private_names_in_public(library())), ""); }

TEST(PublicFace, NeedsNothingThatIsNotInstalled) {
  EXPECT_EQ(joined(architecture::headers_left_behind(library())), "");
  const std::vector<std::string> lines = {"#include \"hinge_tools/x.hpp\"", "#include \"hinge/core/vec3.hpp\""};
  EXPECT_EQ(architecture::headers_left_behind({{"molecular/include/hinge/molecular/x.hpp", lines}}).size(), 1U);
  EXPECT_EQ(architecture::headers_left_behind({{"include/hinge/detail/core/x.hpp", lines}}).size(), 1U);
  EXPECT_EQ(architecture::headers_left_behind({{"molecular/src/io/x.hpp", lines}}).size(), 0U);
}

TEST(PublicFace, IsOneIncludeAway) { EXPECT_EQ(joined(architecture::not_under_umbrella(library())), ""); }

/// Checks examples, pages and the program that uses an installed core.
TEST(PublicFace, IsAllThatUsersAreShown) {
  SourceTree shown = architecture::read_sources(root, {"docs", "tests/consumer"}, {".hpp", ".cpp", ".md"});
  EXPECT_GE(shown.size(), 10U);
  std::ifstream in(root / "README.md");
  for (std::string line; std::getline(in, line);) shown["README.md"].push_back(line);
  EXPECT_EQ(joined(architecture::private_includes(shown)), "");
}

TEST(Conventions, EveryFileKeepsThem) { EXPECT_EQ(joined(architecture::convention_violations(library())), ""); }

TEST(Conventions, EveryConceptHasANonModel) {
  EXPECT_EQ(joined(architecture::untested_concepts(library(), architecture::read_sources(root, {"tests/static"}))), "");
  EXPECT_EQ(architecture::untested_concepts({{"x.hpp", {"concept A = true;", "concept B = true;"}}},
                                            {{"y.cpp", {"static_assert(A<int> && !detail::B<int>);"}}})
                .size(),
            1U);
}

TEST(Conventions, TopLevelHoldsNothingElse) { EXPECT_EQ(joined(architecture::strangers_at_top(root)), ""); }

/// Presets with the same build folder would overwrite each other's programs.
TEST(Presets, HaveAFolderEach) {
  std::ifstream in(root / "CMakePresets.json");
  const std::string text{std::istreambuf_iterator<char>(in), {}};
  const auto matches = [&](const std::string& pattern) {
    const std::regex regex(pattern);
    std::vector<std::string> all;
    for (std::sregex_iterator match(text.begin(), text.end(), regex), end; match != end; ++match)
      all.push_back((*match)[1]);
    return all;
  };
  const std::vector<std::string> folders = matches(R"re("binaryDir": "([^"]*)")re");
  EXPECT_EQ(folders.size(), matches(R"re("description": "([^"]*)")re").size()) << "a preset inherits its folder";
  EXPECT_EQ(std::set<std::string>(folders.begin(), folders.end()).size(), folders.size());
  EXPECT_GE(folders.size(), 2U);
}

/// Returns the number of violations after planting one line into a small valid tree.
std::size_t floor_breaches(const std::string& path, const std::string& line) {
  SourceTree tree = {{"include/hinge/version.hpp", {}},
                     {"include/hinge/core/vec3.hpp", {}},
                     {"include/hinge/policy/primitive.hpp", {}},
                     {"include/hinge/kinematics/joint.hpp", {}},
                     {"include/hinge/engine/engine.hpp", {}},
                     {"include/hinge/engine/lazy.hpp", {}},
                     {"include/hinge/hierarchy.hpp", {}},
                     {"molecular/include/hinge/molecular/atom.hpp", {}},
                     {"molecular/src/io/read_file.hpp", {}},
                     {"robotics/include/hinge/robotics/link.hpp", {}},
                     {"python/src/arrays.hpp", {}},
                     {"include/hinge/detail/simd/lanes.hpp", {}}};
  tree[path] = {line};
  return architecture::floor_violations(tree).size();
}

TEST(PlantedInclude, DownwardIsFine) {
  EXPECT_EQ(floor_breaches("include/hinge/policy/x.hpp", "#include \"hinge/core/vec3.hpp\""), 0U);
  EXPECT_EQ(floor_breaches("include/hinge/core/x.hpp", "#include \"hinge/version.hpp\""), 0U);
  EXPECT_EQ(floor_breaches("include/hinge/policy/x.hpp", "#include \"hinge/policy/primitive.hpp\""), 0U);
  EXPECT_EQ(floor_breaches("include/hinge/engine/brute.hpp", "#include \"hinge/engine/engine.hpp\""), 0U);
  EXPECT_EQ(floor_breaches("include/hinge/core/x.hpp", "#include <Eigen/Core>"), 0U);
  EXPECT_EQ(floor_breaches("include/hinge/detail/simd/x.hpp", "#include <immintrin.h>"), 0U);
  EXPECT_EQ(floor_breaches("molecular/src/clash/x.cpp", "#include \"io/read_file.hpp\""), 0U);
  EXPECT_EQ(floor_breaches("molecular/src/io/x.cpp", "#include \"hinge/hierarchy.hpp\""), 0U);
  EXPECT_EQ(floor_breaches("python/src/core/x.cpp", "#include \"arrays.hpp\""), 0U);
  EXPECT_EQ(floor_breaches("python/src/core/x.cpp", "#include \"hinge/molecular/atom.hpp\""), 0U);
}

TEST(PlantedInclude, UpwardIsCaught) {
  EXPECT_EQ(floor_breaches("include/hinge/core/x.hpp", "#include \"hinge/policy/primitive.hpp\""), 1U);
  EXPECT_EQ(floor_breaches("include/hinge/engine/x.hpp", "#include \"hinge/engine/lazy.hpp\""), 1U);
  EXPECT_EQ(floor_breaches("include/hinge/query/x.hpp", "  #  include \"hinge/hierarchy.hpp\"  // why not"), 1U);
  EXPECT_EQ(floor_breaches("include/hinge/hierarchy.hpp", "#include \"hinge/molecular/atom.hpp\""), 1U);
}

TEST(PlantedInclude, PrivateHeadersAreNotForBindings) {
  const std::string line = "#include \"hinge/detail/simd/lanes.hpp\"";
  EXPECT_EQ(floor_breaches("python/src/core/x.cpp", line), 1U);
  EXPECT_EQ(floor_breaches("molecular/src/io/x.cpp", line), 0U);
  EXPECT_EQ(floor_breaches("molecular/src/io/x.cpp", "#include \"arrays.hpp\""), 1U);
}

TEST(PlantedInclude, SidewaysIsCaught) {
  EXPECT_EQ(floor_breaches("include/hinge/policy/x.hpp", "#include \"hinge/kinematics/joint.hpp\""), 1U);
  EXPECT_EQ(floor_breaches("include/hinge/detail/engine/simd/x.hpp", "#include \"hinge/engine/lazy.hpp\""), 1U);
  EXPECT_EQ(floor_breaches("molecular/src/io/x.cpp", "#include \"hinge/robotics/link.hpp\""), 1U);
}

TEST(PlantedInclude, StrangersAreCaught) {
  EXPECT_EQ(floor_breaches("include/hinge/gadgets/x.hpp", ""), 1U);
  EXPECT_EQ(floor_breaches("include/hinge/x.hpp", ""), 1U);
  EXPECT_EQ(floor_breaches("include/hinge/core/x.hpp", "#include \"vec3.hpp\""), 1U);
  EXPECT_EQ(floor_breaches("include/hinge/core/x.hpp", "#include \"hinge/core/absent.hpp\""), 1U);
  EXPECT_EQ(floor_breaches("include/hinge/core/x.hpp", "#include <fmt/format.h>"), 1U);
  EXPECT_EQ(floor_breaches("include/hinge/bounds/x.hpp", "#include <immintrin.h>"), 1U);
}

TEST(PlantedInclude, CircleIsCaught) {
  const SourceTree tree = {{"include/hinge/core/a.hpp", {"#include \"hinge/core/b.hpp\""}},
                           {"include/hinge/core/b.hpp", {"#include \"hinge/core/c.hpp\""}},
                           {"include/hinge/core/c.hpp", {"#include \"hinge/core/a.hpp\""}}};
  EXPECT_EQ(architecture::include_circle(tree).size(), 3U);
}

TEST(PlantedInclude, OracleOutsideItsFolderIsCaught) {
  const std::vector<std::string> lines = {"#include <fcl/fcl.h>"};
  EXPECT_EQ(architecture::oracle_violations({{"tests/engine/x.cpp", lines}}).size(), 1U);
  EXPECT_EQ(architecture::oracle_violations({{"tests/oracle/x.cpp", lines}}).size(), 0U);
}

/// Returns the number of private names in a public header with this text.
std::size_t shown_by(const std::string& text, const std::string& path = "include/hinge/core/x.hpp") {
  std::vector<std::string> lines;
  std::istringstream in(text);
  for (std::string line; std::getline(in, line);) lines.push_back(line);
  return architecture::private_names_in_public({{path, lines}}).size();
}

TEST(PlantedPrivateName, IsCaught) {
  EXPECT_EQ(shown_by("namespace hinge {\ndetail::Frame frame();\n}"), 1U);
  EXPECT_EQ(shown_by("namespace hinge {\ninline void f(const detail::Frame& frame) { g(); }\n}"), 1U);
  EXPECT_EQ(shown_by("namespace hinge {\nusing Frame = detail::Frame;\n}"), 1U);
  EXPECT_EQ(shown_by("namespace hinge {\nstruct A {\n  detail::Frame frame{};\n};\n}"), 1U);
  EXPECT_EQ(shown_by("class A {\n public:\n  A() {}\n  detail::Frame frame() { return f; }\n};"), 1U);
  EXPECT_EQ(shown_by("template <detail::Concept T>\nstruct A {\n  int a;\n};"), 1U);
  EXPECT_EQ(shown_by("detail::Frame f();", "molecular/include/hinge/molecular/x.hpp"), 1U);
}

TEST(PlantedPrivateName, IsFineWhereUsersDoNotSeeIt) {
  EXPECT_EQ(shown_by("detail::Frame f();", "include/hinge/detail/core/x.hpp"), 0U);
  EXPECT_EQ(shown_by("detail::Frame f();", "molecular/src/io/x.hpp"), 0U);
  EXPECT_EQ(shown_by("class A {\n  detail::Frame f_;\n};"), 0U);
  EXPECT_EQ(shown_by("class A {\n public:\n  A() : a_(detail::f()) {}\n private:\n  detail::Frame f_;\n};"), 0U);
  EXPECT_EQ(shown_by("int f() {\n  detail::Frame frame;\n  if (g()) { h(); }\n  return detail::k(frame);\n}"), 0U);
  EXPECT_EQ(shown_by("class A {\n  detail::Frame f();\n};\ninline detail::Frame A::f() { return {}; }"), 0U);
  EXPECT_EQ(shown_by("struct A {\n  double a = detail::one;\n};\n// detail::Frame"), 0U);
}

TEST(PlantedPrivateName, IncludeIsCaught) {
  EXPECT_EQ(architecture::private_includes({{"README.md", {"#include <hinge/detail/core/assert.hpp>"}}}).size(), 1U);
  EXPECT_EQ(architecture::private_includes({{"README.md", {"#include <hinge/hierarchy.hpp>"}}}).size(), 0U);
}

/// Returns the number of violations of a header that is valid except for its name and the added lines.
std::size_t convention_breaches(const std::string& path, const std::vector<std::string>& more) {
  std::vector<std::string> lines = {"// SPDX-License-Identifier: BSD-3-Clause", "// A pin.", "#pragma once"};
  lines.insert(lines.end(), more.begin(), more.end());
  return architecture::convention_violations({{path, lines}}).size();
}

TEST(PlantedBreach, IsCaught) {
  const std::string path = "include/hinge/core/pin.hpp";
  EXPECT_EQ(convention_breaches(path, {"#define HINGE_ASSERT(x)", "// virtual, in words", "#include <cmath>"}), 0U);
  EXPECT_EQ(convention_breaches(path, {"#define PIN 1"}), 1U);
  EXPECT_EQ(convention_breaches(path, {"#ifdef __AVX2__"}), 1U);
  EXPECT_EQ(convention_breaches("include/hinge/detail/simd/pin.hpp", {"#ifdef __AVX2__"}), 0U);
  EXPECT_EQ(convention_breaches(path, {"using namespace hinge;"}), 1U);
  EXPECT_EQ(convention_breaches(path, {"  virtual ~Pin();"}), 1U);
  EXPECT_EQ(convention_breaches(path, std::vector<std::string>(architecture::longest_file, "")), 1U);
  EXPECT_EQ(convention_breaches("include/hinge/core/pin_utils.hpp", {}), 1U);
  EXPECT_EQ(convention_breaches("include/hinge/common/pin.hpp", {}), 1U);
  EXPECT_EQ(architecture::convention_violations({{path, {}}}).size(), 3U);
}

}  // namespace architecture_test
