// SPDX-License-Identifier: BSD-3-Clause
// Tests code shared by the command-line tools: exit statuses, CSV fields, and files that are complete or absent.
#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <stdexcept>
#include <string>

#include "hinge/core/error.hpp"
#include "hinge_tools/complete_file.hpp"
#include "hinge_tools/csv_field.hpp"
#include "hinge_tools/run_tool.hpp"

namespace hinge::tool {
namespace tool_test {

TEST(CsvField, IsQuotedWhereItMustBe) {
  EXPECT_EQ(csv_field("link 7"), "link 7");
  EXPECT_EQ(csv_field(""), "");
  EXPECT_EQ(csv_field("a,b"), "\"a,b\"");
  EXPECT_EQ(csv_field("a\"b"), "\"a\"\"b\"");
  EXPECT_EQ(csv_field("a\nb"), "\"a\nb\"");
}

TEST(RunTool, TurnsErrorsIntoStatuses) {
  EXPECT_EQ(run_tool("x", [] { return Exit::free; }), 0);
  EXPECT_EQ(run_tool("x", [] { return Exit::collision; }), 1);
  EXPECT_EQ(run_tool("x", []() -> Exit { throw ModelError("a rule"); }), 2);
  EXPECT_EQ(run_tool("x", []() -> Exit { throw LoadError("a file"); }), 3);
  EXPECT_EQ(run_tool("x", []() -> Exit { throw ConfigurationError("a joint"); }), 3);
  EXPECT_EQ(run_tool("x", []() -> Exit { throw std::runtime_error("a disk"); }), 3);
}

TEST(CompleteFile, TakesItsNameOnlyWhenComplete) {
  const auto path = std::filesystem::temp_directory_path() / ("hinge-complete-" + std::to_string(getpid()));
  const auto content = [&] {
    std::ifstream in(path);
    return std::string{std::istreambuf_iterator<char>(in), {}};
  };
  std::ofstream(path) << "old";
  {
    CompleteFile abandoned(path.string());
    abandoned.stream() << "new";
    EXPECT_EQ(content(), "old");
  }
  EXPECT_EQ(content(), "old");
  EXPECT_FALSE(std::filesystem::exists(path.string() + ".partial"));
  CompleteFile file(path.string());
  file.stream() << "new";
  file.finish();
  EXPECT_EQ(content(), "new");
  EXPECT_FALSE(std::filesystem::exists(path.string() + ".partial"));
  std::filesystem::remove(path);
  EXPECT_THROW(CompleteFile("/nonexistent/file"), LoadError);
  EXPECT_FALSE(CompleteFile("").wanted());
}

}  // namespace tool_test
}  // namespace hinge::tool
