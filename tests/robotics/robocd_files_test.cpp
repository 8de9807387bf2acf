// SPDX-License-Identifier: BSD-3-Clause
// robocd and the files around it: what --out may not destroy, and how outputs fail.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>

#include "robotics/run_robocd.hpp"

namespace hinge::robotics {
namespace {

using test::run_robocd;

std::string content(const std::filesystem::path& path) {
  std::ifstream in(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

TEST(RobocdFiles, NoInputIsWrittenOver) {
  const test::ArmFolder folder;
  folder.write("q.csv", "shoulder,elbow\n0,0\n");
  folder.write("pairs.txt", "base fore\n");
  folder.write("table.stl", test::cube_stl(Vec3(9, 9, 9), 0.1));
  const std::string zero = "check" + folder.urdf() + " --zero";
  for (const auto& [command, out] : {std::pair{"check" + folder.urdf() + " --csv-in" + folder.file("q.csv"), "q.csv"},
                                     {"matrix" + folder.urdf(), "arm.urdf"},
                                     {"matrix" + folder.urdf(), "cube.stl"},
                                     {zero, "arm.urdf"},
                                     {zero, "cube.stl"},
                                     {zero + " --srdf" + folder.file("arm.srdf"), "arm.srdf"},
                                     {zero + " --skip-pairs" + folder.file("pairs.txt"), "pairs.txt"},
                                     {zero + " --env" + folder.file("table.stl"), "table.stl"}}) {
    const std::string before = content(folder.path() / out);
    const test::Said said = run_robocd(command + " --out" + folder.file(out) + " 2>&1");
    EXPECT_EQ(said.status, 2) << command;
    EXPECT_NE(said.out.find(": is the input "), std::string::npos) << command << said.out;
    EXPECT_EQ(std::count(said.out.begin(), said.out.end(), '\n'), 1) << said.out;
    EXPECT_TRUE(content(folder.path() / out) == before) << out;
  }
}

TEST(RobocdFiles, ClosedStandardOutputIsAnError) {
  const test::ArmFolder folder;
  const test::Said said = run_robocd("check" + folder.urdf() + " --zero --out" + folder.file("q.csv") + " 2>&1 >&-");
  EXPECT_EQ(said.status, 3);
  EXPECT_NE(said.out.find("standard output: cannot be written"), std::string::npos) << said.out;
  EXPECT_FALSE(std::filesystem::exists(folder.path() / "q.csv"));
  // A matrix goes to its file alone.
  EXPECT_EQ(run_robocd("matrix" + folder.urdf() + " --samples 10 --cells 0 --out" + folder.file("m.srdf") +
                       " >&- 2>/dev/null")
                .status,
            0);
  EXPECT_TRUE(content(folder.path() / "m.srdf").starts_with("<?xml"));
}

}  // namespace
}  // namespace hinge::robotics
