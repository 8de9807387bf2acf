// SPDX-License-Identifier: BSD-3-Clause
// Tests what both tools print about themselves: the help of every command and its examples, the manual page, and the
// completion script of bash.
#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <set>
#include <string>
#include <vector>

#include "docs/console_blocks.hpp"
#include "tool/run_tool.hpp"

namespace hinge::test {
namespace help_test {

namespace fs = std::filesystem;

const fs::path tools = HINGE_TOOLS_DIR;

struct Case {
  const char* tool;
  std::vector<std::string> commands;
};

const std::vector<Case> cases{
    {"biocd", {"info", "check", "sample", "walk", "relax", "merge", "path", "plan", "dial", "demo"}},
    {"robocd", {"info", "check", "merge", "matrix", "path", "relax", "plan", "dial", "demo"}}};

Said run(const std::string& tool, const std::string& arguments) { return run_tool((tools / tool).string(), arguments); }

/// Returns the lines of a help text below a title.
std::vector<std::string> below(const std::string& help, const std::string& title) {
  std::vector<std::string> found;
  bool inside = false;
  for (const std::string& line : lines_of(help)) {
    if (inside && !line.starts_with("  ")) break;
    if (inside) found.push_back(line.substr(2));
    inside = inside || line == title + ":";
  }
  return found;
}

/// Returns a folder with the data that the examples name.
fs::path make_folder(const std::string& name) {
  fs::path folder = fs::temp_directory_path() / ("hinge_help_" + name + std::to_string(getpid()));
  fs::remove_all(folder);
  fs::create_directories(folder);
  for (const char* data : {"molecular", "robotics"})
    fs::create_directory_symlink(fs::path(HINGE_SOURCE_DIR) / data, folder / data);
  return folder;
}

TEST(Help, FitsAHundredColumnsAndNamesWhatIsExpected) {
  for (const Case& c : cases) {
    std::vector<std::string> all{"--help"};
    for (const std::string& command : c.commands) all.push_back(command + " --help");
    for (const std::string& arguments : all) {
      const Said said = run(c.tool, arguments);
      EXPECT_EQ(said.status, 0) << arguments;
      for (const std::string& line : lines_of(said.out)) EXPECT_LE(line.size(), 100U) << line;
      for (const char* word : {"TEXT", "FLOAT", "INT ", "UINT", "{", "[OPTIONS]", "default: ) "})
        EXPECT_EQ(said.out.find(word), std::string::npos) << c.tool << " " << arguments << ": " << word;
      EXPECT_GE(below(said.out, "Examples").size(), 2U) << c.tool << " " << arguments;
      const std::vector<std::string> general = below(said.out, "General");
      EXPECT_EQ(std::set(general.begin(), general.end()).size(), general.size()) << c.tool << " " << arguments;
    }
  }
  EXPECT_EQ(run("biocd", "help walk").out, run("biocd", "walk --help").out);
}

TEST(Help, ExamplesWork) {
  for (const Case& c : cases) {
    const fs::path folder = make_folder(c.tool);
    for (const std::string& command : c.commands)
      for (const std::string& example : below(run(c.tool, command + " --help").out, "Examples")) {
        const Said said = run_tool(
            "sh", "-c 'cd " + folder.string() + " && PATH=" + tools.string() + ":$PATH && " + example + " 2>&1'");
        EXPECT_TRUE(said.status == 0 || said.status == 1) << example << "\n" << said.out;
      }
    fs::remove_all(folder);
  }
}

TEST(Tools, PrintTheUsageWithoutACommand) {
  for (const Case& c : cases) {
    EXPECT_EQ(run(c.tool, "").status, 2);
    EXPECT_EQ(run(c.tool, "2>/dev/null").out, "");
    EXPECT_TRUE(run(c.tool, "2>&1").out.starts_with("Usage: " + std::string(c.tool) + " COMMAND ...\n"));
    const Said wrong = run(c.tool, "chekc file 2>&1");
    EXPECT_EQ(wrong.status, 2);
    EXPECT_EQ(wrong.out,
              std::string(c.tool) + ": unknown command 'chekc'; did you mean 'check'? See '" + c.tool + " --help'\n");
  }
}

TEST(ManPage, IsSoundAndNamesEveryCommand) {
  const bool has_groff = run_tool("sh", "-c 'command -v groff >/dev/null'").status == 0;
  for (const Case& c : cases) {
    const Said page = run(c.tool, "--man");
    EXPECT_EQ(page.status, 0);
    for (const std::string& command : c.commands) EXPECT_NE(page.out.find(".SS " + command + "\n"), std::string::npos);
    if (!has_groff) continue;
    const std::string check = (tools / c.tool).string() + " --man | groff -man -Tutf8 -ww 2>&1 >/dev/null";
    EXPECT_EQ(run_tool("sh", "-c '" + check + "'").out, "");
  }
  if (!has_groff) GTEST_SKIP() << "groff is not installed";
}

/// Returns what bash offers for the last of the words, in the folder.
std::string offered(const std::string& tool, const std::string& words, const fs::path& folder) {
  const fs::path script = folder / "complete.sh";
  std::ofstream(script) << "source <('" << (tools / tool).string() << "' --completion bash)\ncd '" << folder.string()
                        << "'\nCOMP_WORDS=(" << words << ")\nCOMP_CWORD=$((${#COMP_WORDS[@]}-1))\n_" << tool
                        << "\necho \"${COMPREPLY[*]}\"\n";
  return run_tool("bash", "--norc '" + script.string() + "' 2>&1").out;
}

TEST(Completion, OffersCommandsOptionsValuesAndFiles) {
  const fs::path folder = make_folder("completion");
  const auto biocd = [&](const std::string& words) { return offered("biocd", "biocd " + words, folder); };
  EXPECT_EQ(biocd("''"), "info check sample walk relax merge path plan dial demo\n");
  EXPECT_EQ(biocd("sa"), "sample\n");
  EXPECT_EQ(biocd("check --hb"), "--hbond --hbond-allowance\n");
  EXPECT_EQ(biocd("check --hbond o"), "on off\n");
  EXPECT_EQ(biocd("check --hbond = o"), "on off\n");
  EXPECT_EQ(biocd("check --mode ''"), "any all within: closest\n");
  EXPECT_EQ(biocd("check molecular/data/1u"), "molecular/data/1ubq.pdb\n");
  EXPECT_EQ(biocd("check --with mol"), "molecular\n");
  EXPECT_EQ(biocd("check --free ''"), "\n");
  EXPECT_EQ(biocd("--completion ''"), "bash zsh fish\n");
  EXPECT_EQ(offered("robocd", "robocd check --ma", folder), "--made-for --max-pairs\n");
  EXPECT_EQ(offered("robocd", "robocd check --z", folder), "--zero\n");
  fs::remove_all(folder);
}

}  // namespace help_test
}  // namespace hinge::test
