// SPDX-License-Identifier: BSD-3-Clause
// Tests robocd's files: output must not overwrite input, and failures of writing are reported.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <nlohmann/json.hpp>
#include <sstream>
#include <string>

#include "robotics/run_robocd.hpp"

namespace hinge::robotics {
namespace robocd_files_test {

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
  // With --out the matrix is not written to standard output, so a closed one does not matter.
  EXPECT_EQ(run_robocd("matrix" + folder.urdf() + " --samples 10 --cells 0 --out" + folder.file("m.srdf") +
                       " >&- 2>/dev/null")
                .status,
            0);
  EXPECT_TRUE(content(folder.path() / "m.srdf").starts_with("<?xml"));
}

TEST(RobocdFiles, AFullDiskEndsTheRunAndJsonSaysSo) {
  const test::ArmFolder folder;
  const std::string command = "check" + folder.urdf() + " --random 100000000 --json --out";
  const test::Said said = run_robocd(command + " /dev/full 2>/dev/null");
  EXPECT_EQ(said.status, 3);
  EXPECT_NE(nlohmann::json::parse(said.out)["summary"]["error"].get<std::string>().find("No space left"),
            std::string::npos);
  const test::Said limited = test::run_tool("/bin/sh", "-c 'ulimit -f 100; " HINGE_ROBOCD " " + command + " " +
                                                           (folder.path() / "q.csv").string() + " 2>&1 >/dev/null'");
  EXPECT_EQ(limited.status, 3);
  EXPECT_NE(limited.out.find("File too large"), std::string::npos) << limited.out;
}

TEST(RobocdFiles, NumbersAreCheckedBeforeAnythingElse) {
  const test::ArmFolder folder;
  const auto refused = [&](const std::string& command, const std::string& option, const char* values) {
    std::istringstream words(values);
    for (std::string value; words >> value;) {
      const test::Said said = run_robocd(command + folder.urdf() + " " + option + " " + value + " 2>&1");
      EXPECT_EQ(said.status, 2) << option << " " << value;
      EXPECT_TRUE(said.out.starts_with("robocd: " + option + " '" + value + "': expected ")) << said.out;
      EXPECT_EQ(std::count(said.out.begin(), said.out.end(), '\n'), 1) << said.out;
    }
  };
  refused("check", "--random", "-1 0 1.5 nan 18446744073709551616");
  refused("check --random 1", "--seed", "-1 1.5 18446744073709551616");
  refused("check --zero", "--threads", "-1 0 1025 1.5");
  refused("check --zero", "--mode", "within:1e308 within:1e10");
  for (const char* command : {"check --zero", "matrix", "path --from zero --to zero"})
    refused(command, "--clearance", "nan inf -1 1e308");
  for (const char* option : {"--samples", "--cells", "--seed"})
    refused("matrix", option, "-1 1.5 nan 18446744073709551616");
  refused("path --from zero --to zero", "--sampled", "nan inf 0 -1 1e308");
  refused("path --from zero --to zero", "--min-step", "nan inf 0 -1 2");
  EXPECT_EQ(run_robocd("path" + folder.urdf() + " --from zero --to 1e308,0 2>/dev/null").status, 2);
  // A valid row, then a value out of range: no output, and an error with file, line and column.
  folder.write("q.csv", "shoulder,elbow\n0,0\n1e308,0\n");
  const std::string json = "check" + folder.urdf() + " --json --csv-in" + folder.file("q.csv");
  EXPECT_EQ(run_robocd(json + " 2>/dev/null").out, "");
  EXPECT_EQ(run_robocd(json + " 2>&1").out, "robocd: " + (folder.path() / "q.csv").string() +
                                                ":3: column 1: joint 'shoulder' is '1e308', expected a finite "
                                                "number, at most 1e+15\n");
}

/// Errors deep in a file, or in a file combined with an option, are found before any output.
TEST(RobocdFiles, ConfigurationsAreCheckedBeforeTheFirstByte) {
  const test::ArmFolder folder;
  std::string rows = "shoulder,elbow\n";
  for (int k = 0; k < 498; ++k) rows += "0.5,0\n";
  const auto with_row = [&](const std::string& row) { folder.write("q.csv", rows + row + "\n0,0\n"); };
  const auto refusal = [&](const std::string& arguments, int status) {
    const test::Said said = run_robocd(arguments);
    EXPECT_EQ(said.out, "") << arguments;
    EXPECT_EQ(said.status, status) << arguments;
    std::string line = run_robocd(arguments + " 2>&1 >/dev/null").out;
    EXPECT_EQ(std::count(line.begin(), line.end(), '\n'), 1) << line;
    EXPECT_LT(line.size(), 300U) << line;
    const std::string path = folder.path().string() + "/";
    if (const std::size_t at = line.find(path); at != std::string::npos) line.erase(at, path.size());
    return line;
  };
  const std::string csv = folder.file("q.csv");
  for (const std::string& command : {"check" + folder.urdf() + " --json --csv-in" + csv,
                                     "check" + folder.urdf() + " --csv --mode closest --csv-in" + csv,
                                     "path" + folder.urdf() + " --json --waypoints" + csv})
    for (const char* value : {"1e308", "nan", "-inf", "1e16", "x"}) {
      with_row(std::string("0,") + value);
      EXPECT_EQ(refusal(command, 3), std::string("robocd: q.csv:500: column 2: joint 'elbow' is '") + value +
                                         "', expected a finite number, at most 1e+15\n");
    }

  // The follower (mast) moves 1e300 times as far as the elbow.
  std::string urdf = test::arm_urdf;
  folder.write("far.urdf", urdf.replace(urdf.find("0.5\" offset"), 3, "1e300"));
  with_row("0,-1e15");
  for (const char* command : {"check --json --csv-in", "check --csv --csv-in", "path --waypoints"})
    EXPECT_EQ(refusal(command + csv + folder.file("far.urdf"), 3),
              "robocd: q.csv:500: column 2: joint 'elbow' is -1e+15, which moves the mimic joint 'follower' to -inf, "
              "expected at most 1e+15\n");
  EXPECT_EQ(
      refusal("path" + folder.file("far.urdf") + " --from zero --to 0,1", 2),
      "robocd: --to '0,1': joint 'elbow' is 1, which moves the mimic joint 'follower' to 1e+300, expected at most "
      "1e+15\n");
  EXPECT_EQ(
      refusal("check" + folder.file("far.urdf") + " --json --random 5", 3),
      "robocd: far.urdf: a joint limit is too large for sampling: joint 'elbow' is -1.5, which moves the mimic joint "
      "'follower' to -1.5e+300, expected at most 1e+15\n");
  EXPECT_EQ(refusal("check --json --state slide/in" + folder.file("far.urdf") + " --srdf" + folder.file("arm.srdf"), 2),
            "robocd: --state 'slide/in': joint 'elbow' is -1.4, which moves the mimic joint 'follower' to -1.4e+300, "
            "expected at most 1e+15\n");
  std::string srdf = test::arm_srdf;
  folder.write("far.srdf", srdf.replace(srdf.find("-1.4"), 4, "1e308"));
  EXPECT_EQ(refusal("check --json --state slide/in" + folder.urdf() + " --srdf" + folder.file("far.srdf"), 3),
            "robocd: far.srdf:5: joint 'elbow' has value \"1e308\", expected one finite number of at most 1e15\n");
  for (const char* limit : {"1e300", "-1e300"}) {
    urdf = test::arm_urdf;
    folder.write("wide.urdf", urdf.replace(urdf.find(limit[0] == '-' ? "-1.5\" upper" : "1\" effort"),
                                           limit[0] == '-' ? 4 : 1, limit));
    EXPECT_EQ(refusal("check" + folder.file("wide.urdf") + " --json --random 5", 3),
              std::string("robocd: wide.urdf: a joint limit is too large for sampling: joint 'elbow' is ") +
                  (limit[0] == '-' ? "-1e+300" : "1e+300") + ", expected at most 1e+15\n");
    EXPECT_EQ(refusal("matrix" + folder.file("wide.urdf"), 3)
                  .find("robocd: wide.urdf: a joint limit is too large for sampling"),
              0U);
    EXPECT_EQ(run_robocd("check" + folder.file("wide.urdf") + " --zero").status, 0);
  }
}

TEST(RobocdFiles, RefusalsAreOneLineThatNamesTheFile) {
  const test::ArmFolder folder;
  for (const std::string& arguments :
       {std::string("check"), "check" + folder.urdf(), "check" + folder.urdf() + " --zero --random 3",
        std::string("info /dev/zero"), std::string("info /tmp"), std::string("info /proc/self/mem"),
        "check" + folder.urdf() + " --csv-in /dev/zero", "check" + folder.urdf() + " --zero --env /proc/self/mem"}) {
    const test::Said said = run_robocd(arguments + " 2>&1");
    EXPECT_GE(said.status, 2) << arguments;
    EXPECT_TRUE(said.out.starts_with("robocd: ")) << said.out;
    EXPECT_EQ(std::count(said.out.begin(), said.out.end(), '\n'), 1) << said.out;
    for (const char* file : {"/dev/zero", "/tmp", "/proc/self/mem"})
      if (arguments.ends_with(file)) {
        EXPECT_NE(said.out.find(std::string(file) + ": "), std::string::npos) << said.out;
      }
  }
}

/// A pipe is read like a file, and reported as empty only if it is.
TEST(RobocdFiles, MayBePipes) {
  const test::ArmFolder folder;
  folder.write("q.csv", "shoulder,elbow\n0,0\n");
  const std::string zero = " | " HINGE_ROBOCD " check /dev/stdin --zero --package-path /tmp --missing-meshes skip 2>&1";
  EXPECT_EQ(test::run_tool("/bin/cat", folder.urdf() + zero).status, 0);
  EXPECT_EQ(
      run_robocd("check" + folder.urdf() + " --csv-in /dev/stdin", "/bin/cat" + folder.file("q.csv") + " |").status, 0);
  const auto said = [&](const std::string& arguments) { return run_robocd(arguments + " 2>&1", "true |").out; };
  EXPECT_EQ(said("info /dev/stdin"), "robocd: /dev/stdin: is empty, expected XML with root element <robot>\n");
  EXPECT_EQ(said("info" + folder.urdf() + " --srdf /dev/stdin"),
            "robocd: /dev/stdin: is empty, expected XML with root element <robot>\n");
  EXPECT_EQ(said("check" + folder.urdf() + " --csv-in /dev/stdin"),
            "robocd: /dev/stdin: is empty, expected a header of joint names\n");
  // Meshes must be regular files, because their readers seek.
  std::string urdf = test::arm_urdf;
  folder.write("arm.urdf", urdf.replace(urdf.find("cube.stl"), 8, "/dev/zero"));
  EXPECT_NE(run_robocd("info" + folder.urdf() + " 2>&1").out.find("/dev/zero is not a regular file"),
            std::string::npos);
}

TEST(RobocdFiles, NamesNeedNotBeText) {
  const test::ArmFolder folder;
  folder.write("l\xfcs.urdf", test::arm_urdf);
  for (const char* command : {"info", "check --zero", "path --from zero --to zero"}) {
    const test::Said said =
        run_robocd(command + folder.file("l\xfcs.urdf") + " --json 2>" + (folder.path() / "notes").string());
    EXPECT_LE(said.status, 1) << command;
    const auto json = nlohmann::json::parse(said.out);
    EXPECT_TRUE(json["robot"]["file"].get<std::string>().ends_with("l\xEF\xBF\xBDs.urdf"));
    EXPECT_NE(content(folder.path() / "notes").find("not UTF-8"), std::string::npos);
  }
}

}  // namespace robocd_files_test
}  // namespace hinge::robotics
