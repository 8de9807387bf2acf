// SPDX-License-Identifier: BSD-3-Clause
// Tests a tool next to programs of the same name from other builds.
#pragma once

#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>

#include "hinge/detail/simd/instruction_set.hpp"
#include "tool/run_tool.hpp"

namespace hinge::test {

/// Expects the tool to start a program for another instruction set only if it is from the same build.
inline void expect_own_build_only(const std::filesystem::path& tool) {
  namespace fs = std::filesystem;
  const detail::simd::InstructionSet best = detail::simd::of_this_cpu();
  if (best == detail::simd::InstructionSet::baseline) GTEST_SKIP() << "this CPU runs the baseline only";
  const std::string name = tool.filename().string();
  const fs::path folder = fs::temp_directory_path() / ("hinge-programs-" + name + std::to_string(getpid()));
  fs::create_directories(folder);
  const fs::path own = folder / name, other = folder / (name + "-" + std::string(detail::simd::name(best)));
  fs::copy_file(tool, own);
  const auto version = [&](const char* environment = "") {
    return run_tool(own.string(), "--version 2>&1", environment);
  };
  const std::string baseline = version().out;
  EXPECT_EQ(version().status, 0) << "alone";
  EXPECT_NE(baseline.find("(baseline)"), std::string::npos) << baseline;

  const auto expect_refused = [&] {
    const Said said = version();
    EXPECT_EQ(said.status, 3) << said.out;
    for (const std::string& words :
         {other.string(), std::string("not of the same build"), std::string("HINGE_ISA=baseline")})
      EXPECT_NE(said.out.find(words), std::string::npos) << said.out;
    EXPECT_EQ(version("HINGE_ISA=baseline").out, baseline);
  };
  std::ofstream(other) << "#!/bin/sh\necho I am another\n";
  fs::permissions(other, fs::perms::owner_all);
  expect_refused();

  fs::copy_file(tool, other, fs::copy_options::overwrite_existing);
  EXPECT_EQ(version().status, 0) << "the same build";
  EXPECT_EQ(version().out, baseline);

  std::string bytes;
  {
    std::ifstream in(other, std::ios::binary);
    bytes.assign(std::istreambuf_iterator<char>(in), {});
  }
  const std::string mark = "hinge build id: " + name;
  const std::size_t at = bytes.find(mark);
  ASSERT_NE(at, std::string::npos);
  bytes[bytes.find('\0', at) - 1] ^= 1;  // the last digit of the hash of the sources
  std::ofstream(other, std::ios::binary) << bytes;
  expect_refused();
  fs::remove_all(folder);
}

}  // namespace hinge::test
