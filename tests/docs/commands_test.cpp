// SPDX-License-Identifier: BSD-3-Clause
// Runs every command of README, the tutorials and two guides as a user does after ./run build, and compares the output
// with the page. HINGE_UPDATE_DOCS=1 writes the new output into the page, with "..." for rates.
#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <cstddef>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <regex>
#include <sstream>
#include <string>
#include <vector>

#include "docs/console_blocks.hpp"
#include "tool/run_tool.hpp"

namespace hinge::test {
namespace commands_test {

namespace fs = std::filesystem;

const fs::path source_folder = HINGE_SOURCE_DIR;
const fs::path tools_folder = HINGE_TOOLS_DIR;

std::vector<std::string> read_lines(const fs::path& path) {
  std::ifstream file(path);
  std::ostringstream text;
  text << file.rdbuf();
  return lines_of(text.str());
}

/// Returns a folder like a clone after ./run build: commands run unchanged and do not write into the source tree.
fs::path make_clone(const std::string& name) {
  fs::path folder = fs::temp_directory_path() / ("hinge_docs_" + name + std::to_string(getpid()));
  fs::remove_all(folder);
  fs::create_directories(folder / "build/release");
  fs::create_directory_symlink(tools_folder, folder / "build/release/bin");
  for (const char* data : {"molecular", "robotics"}) fs::create_directory_symlink(source_folder / data, folder / data);
  return folder;
}

/// Returns standard output and standard error in one text, as a terminal shows them.
Said run(const std::string& command, const fs::path& folder) {
  const fs::path script = folder / "command.sh";
  std::ofstream(script) << "exec 2>&1\ncd '" << folder.string() << "'\n" << command << "\n";
  return run_tool("sh", "'" + script.string() + "'");
}

std::string joined(const std::vector<std::string>& lines) {
  std::string text;
  for (const std::string& line : lines) text += "  " + line + "\n";
  return text;
}

/// Replaces rates by "...", because they differ from run to run.
std::string without_rates(const std::string& line) {
  static const std::regex rate("[0-9]+ ((conformations |steps )?per second)");
  return std::regex_replace(line, rate, "... $1");
}

class DocumentedCommands : public testing::TestWithParam<const char*> {};

TEST_P(DocumentedCommands, PrintWhatThePageShows) {
  const fs::path path = source_folder / GetParam();
  std::vector<std::string> page = read_lines(path);
  const std::vector<ConsoleCommand> commands = console_commands(page);
  ASSERT_FALSE(commands.empty()) << path << " has no command that can be run";
  const fs::path folder = make_clone(path.stem().string());
  std::ptrdiff_t grown = 0;  // lines that updates have added to the page
  for (const ConsoleCommand& shown : commands) {
    const Said said = run(shown.command, folder);
    const std::vector<std::string> output = lines_of(said.out);
    EXPECT_TRUE(said.status == 0 || said.status == 1)
        << GetParam() << ":" << shown.line << ": exit status " << said.status << "\n"
        << joined(output);
    if (output_matches(shown.output, output)) continue;
    if (std::getenv("HINGE_UPDATE_DOCS") == nullptr) {
      ADD_FAILURE() << GetParam() << ":" << shown.line << ": " << shown.command << "\nprints\n"
                    << joined(output) << "but the page shows\n"
                    << joined(shown.output);
      continue;
    }
    const auto begin = page.begin() + static_cast<std::ptrdiff_t>(shown.first_output) + grown;
    const auto after = page.erase(begin, begin + static_cast<std::ptrdiff_t>(shown.output.size()));
    std::transform(output.begin(), output.end(), std::inserter(page, after), without_rates);
    grown += static_cast<std::ptrdiff_t>(output.size()) - static_cast<std::ptrdiff_t>(shown.output.size());
  }
  if (grown != 0 || std::getenv("HINGE_UPDATE_DOCS") != nullptr) {
    std::ofstream file(path);
    for (const std::string& line : page) file << line << '\n';
  }
  fs::remove_all(folder);
}

INSTANTIATE_TEST_SUITE_P(Pages, DocumentedCommands,
                         testing::Values("README.md", "docs/tutorial/first_protein.md", "docs/tutorial/first_robot.md",
                                         "docs/guide/clashes_in_chimerax.md", "docs/guide/mend_clashes.md",
                                         "docs/guide/planner_edge.md"));

TEST(ConsoleBlocks, AreReadAndCompared) {
  const std::vector<std::string> page =
      lines_of("text\n```console\n$ one\nout 1.5 s\n$ two \\\n  more\na\nb\nc\n```\n$ no\n");
  const std::vector<ConsoleCommand> commands = console_commands(page);
  ASSERT_EQ(commands.size(), 2U);
  EXPECT_EQ(commands[0].command, "one");
  EXPECT_EQ(commands[0].first_output, 3U);
  EXPECT_EQ(commands[1].command, "two \\\n  more");
  EXPECT_EQ(commands[1].output, (std::vector<std::string>{"a", "b", "c"}));
  EXPECT_TRUE(output_matches({"out ... s"}, {"out 1.5 s"}));
  EXPECT_FALSE(output_matches({"out ... s"}, {"out 1.5 m"}));
  EXPECT_FALSE(output_matches({"out"}, {"out", "more"}));
  EXPECT_TRUE(output_matches({"a", "...", "c"}, {"a", "b", "b", "c"}));
  EXPECT_TRUE(output_matches({"a", "..."}, {"a"}));
  EXPECT_FALSE(output_matches({"a", "...", "d"}, {"a", "b", "c"}));
}

}  // namespace commands_test
}  // namespace hinge::test
