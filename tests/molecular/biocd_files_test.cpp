// SPDX-License-Identifier: BSD-3-Clause
// biocd and the files around it: what --out may not destroy, and how outputs fail.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>
#include <thread>

#include "molecular/run_biocd.hpp"
#include "molecular/test_files.hpp"

namespace hinge::molecular {
namespace {

namespace fs = std::filesystem;
using test::run_biocd;

std::string content(const fs::path& path) {
  std::ifstream in(path);
  return {std::istreambuf_iterator<char>(in), {}};
}

/// A copy of 1UBQ in a folder of its own.
class BiocdFiles : public testing::Test {
 protected:
  BiocdFiles() {
    fs::remove_all(folder);
    fs::create_directories(folder);
    fs::copy_file(test::ubiquitin(), folder / "in.pdb");
  }
  ~BiocdFiles() override { fs::remove_all(folder); }
  std::string file(const std::string& name) const { return " " + (folder / name).string(); }

  const fs::path folder = fs::temp_directory_path() / ("hinge-biocd-files-" + std::to_string(getpid()));
  const std::string in = file("in.pdb");
  const std::string sample = "sample" + in + " -n 2 --free count:1";
};

TEST_F(BiocdFiles, NoInputIsWrittenOver) {
  const std::string before = content(folder / "in.pdb");
  fs::copy_file(folder / "in.pdb", folder / "other.pdb");
  fs::create_symlink("in.pdb", folder / "link.pdb");
  std::ofstream(folder / "parts.cif") << "data_X\n";
  std::ofstream(folder / "ends.pdb") << "0";
  const std::string other = file("other.pdb");
  for (const std::string& command :
       {sample + " --out" + in, sample + " --out" + file("link.pdb"), "check" + in + " --out" + in,
        "walk" + in + " --steps 10 --out" + in, "check" + in + other + " --out" + other,
        sample + " --with" + other + " --out" + other, sample + " --rigid-from" + other + " --out" + other,
        sample + " --components" + file("parts.cif") + " --out" + file("parts.cif")}) {
    const test::Said said = run_biocd(command + " 2>&1");
    EXPECT_EQ(said.status, 2) << command;
    EXPECT_NE(said.out.find(": is the input "), std::string::npos) << command << said.out;
    EXPECT_EQ(std::count(said.out.begin(), said.out.end(), '\n'), 1) << said.out;
  }
  EXPECT_EQ(content(folder / "in.pdb"), before);
  EXPECT_EQ(content(folder / "other.pdb"), before);
  EXPECT_EQ(content(folder / "parts.cif"), "data_X\n");
  // demo writes worst.pdb into its folder.
  fs::rename(folder / "other.pdb", folder / "worst.pdb");
  EXPECT_EQ(run_biocd("demo" + file("worst.pdb") + " -n 1 --out " + folder.string() + " 2>&1").status, 2);
  EXPECT_EQ(run_biocd("demo" + in + " -n 1 --out" + in + " 2>&1").status, 2);
  EXPECT_EQ(content(folder / "worst.pdb"), before);
}

TEST_F(BiocdFiles, ResultsAndConformationsDoNotMix) {
  EXPECT_EQ(run_biocd(sample + " --out" + file("x.pdb") + " >" + file("x.pdb")).status, 2);
  EXPECT_EQ(run_biocd(sample + " --out " + folder.string() + " 2>/dev/null").status, 2);
  fs::remove(folder / "x.pdb");
  // Standard output is closed: the results go nowhere, and that is said.
  const test::Said said = run_biocd(sample + " --json --out" + file("x.pdb") + " 2>&1 >&-");
  EXPECT_EQ(said.status, 3);
  EXPECT_EQ(said.out,
            "biocd: standard output: cannot be written: Bad file descriptor; what was written is cut short\n");
  EXPECT_FALSE(fs::exists(folder / "x.pdb"));
  EXPECT_EQ(run_biocd(sample + " --out" + file("x.pdb") + " >/dev/null 2>&- <&-").status, 1);
  EXPECT_TRUE(content(folder / "x.pdb").starts_with("MODEL"));
}

TEST_F(BiocdFiles, RunsToOneNameDoNotMeet) {
  const std::string command =
      "sample" + in + " -n 60 --sigma 1 --free count:5 --json --out" + file("x.pdb") + " --seed ";
  const auto conformations = [&](const char* seed) {
    run_biocd(command + seed + " >/dev/null");
    return content(folder / "x.pdb");
  };
  const std::string first = conformations("1"), second = conformations("2");
  ASSERT_NE(first, second);
  for (int race = 0; race < 3; ++race) {
    fs::remove(folder / "x.pdb");
    std::thread other([&] { EXPECT_EQ(run_biocd(command + "1 >/dev/null").status, 1); });
    EXPECT_EQ(run_biocd(command + "2 >/dev/null").status, 1);
    other.join();
    const std::string written = content(folder / "x.pdb");
    EXPECT_TRUE(written == first || written == second);
    EXPECT_EQ(std::distance(fs::directory_iterator(folder), fs::directory_iterator()), 2);
  }
}

}  // namespace
}  // namespace hinge::molecular
