// SPDX-License-Identifier: BSD-3-Clause
// biocd and the files around it: what --out may not destroy, and how outputs fail.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <nlohmann/json.hpp>
#include <sstream>
#include <string>
#include <thread>

#include "molecular/run_biocd.hpp"
#include "molecular/test_files.hpp"

namespace hinge::molecular {
namespace {

namespace fs = std::filesystem;
using test::run_biocd;
using test::run_tool;

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

TEST_F(BiocdFiles, AFullDiskEndsTheRun) {
  // 10 million conformations take hours.
  for (const std::string& command : {"sample" + in + " -n 10000000 --free count:1 --mode any --out",
                                     "walk" + in + " --exempt-reference --steps 1000000000 --every 1 --out"}) {
    fs::create_symlink("/dev/full", folder / "x.pdb");
    const test::Said said = run_biocd(command + file("x.pdb") + " 2>&1 >/dev/null");
    EXPECT_EQ(said.status, 3);
    EXPECT_NE(said.out.find("biocd:" + file("x.pdb") + ": cannot be written: No space left on device\n"),
              std::string::npos)
        << said.out;
    fs::remove(folder / "x.pdb");
    const test::Said limited =
        run_tool("/bin/sh", "-c 'ulimit -f 100; " HINGE_BIOCD " " + command + file("x.pdb") + " 2>&1 >/dev/null'");
    EXPECT_EQ(limited.status, 3);
    EXPECT_NE(limited.out.find(": cannot be written: File too large\n"), std::string::npos) << limited.out;
    EXPECT_FALSE(fs::exists(folder / "x.pdb"));
  }
  const std::string results = "sample" + in + " -n 10000000 --free count:1 ";
  const test::Said full = run_biocd(results + "--csv 2>&1 >/dev/full");
  EXPECT_EQ(full.status, 3);
  EXPECT_TRUE(full.out.ends_with(
      "biocd: standard output: cannot be written: No space left on device; what was written is cut short\n"))
      << full.out;
  // JSON is closed, and says why.
  fs::create_symlink("/dev/full", folder / "x.pdb");
  const auto json = nlohmann::json::parse(run_biocd(results + "--json --out" + file("x.pdb") + " 2>/dev/null").out);
  EXPECT_NE(json["summary"]["error"].get<std::string>().find("No space left"), std::string::npos);
}

TEST_F(BiocdFiles, NumbersAreCheckedBeforeAnythingElse) {
  const auto refused = [&](const std::string& command, const std::string& option, const char* values) {
    std::istringstream words(values);
    for (std::string value; words >> value;) {
      const test::Said said = run_biocd(command + in + " " + option + " " + value + " --out /dev/full 2>&1");
      EXPECT_EQ(said.status, 2) << option << " " << value;
      const std::string name = option == "-n" ? "--count" : option;
      EXPECT_TRUE(said.out.starts_with("biocd: " + name + " '" + value + "': expected ")) << said.out;
      EXPECT_EQ(std::count(said.out.begin(), said.out.end(), '\n'), 1) << said.out;
    }
  };
  constexpr const char* no_count = "-1 0 1.5 1e3 nan 0x10 18446744073709551616";
  constexpr const char* no_length = "nan inf -inf 1e308 0 -1 1e999";
  for (const char* option : {"-n", "--tries", "--threads"}) refused("sample", option, no_count);
  for (const char* option : {"--steps", "--changes", "--every"}) refused("walk", option, no_count);
  refused("demo", "-n", no_count);
  for (const char* command : {"sample", "walk", "demo"}) refused(command, "--seed", "-1 1.5 18446744073709551616");
  refused("sample", "--min-bonds", no_count);
  refused("sample", "--model", "1.5 nan 99999999999");
  for (const char* option : {"--sigma", "--rho", "--rigid-tolerance"}) refused("sample", option, no_length);
  refused("walk", "--step-size", no_length);
  refused("sample", "--hbond-allowance", "nan -1 1e308");
  const std::string ends = " --from reference --to reference ";
  for (const char* option : {"--sampled nan", "--sampled 1e308", "--min-step nan", "--min-step 2", "--min-step -1"})
    EXPECT_EQ(run_biocd("path" + in + ends + option + " 2>/dev/null").status, 2) << option;
  EXPECT_EQ(run_biocd("path" + in + " --free A:5:chi1 --from reference --to 1e308 2>/dev/null").status, 2);
  for (const char* mode : {"within:1e308", "within:nan", "within:-1", "within:1e10"}) {
    const test::Said said = run_biocd("sample" + in + " --json --mode " + mode);
    EXPECT_TRUE(said.status == 2 && said.out.empty()) << mode;
  }
  EXPECT_EQ(run_biocd("sample" + in + " --place A=1e308 2>/dev/null").status, 2);
}

TEST_F(BiocdFiles, UsageErrorsAreOneLine) {
  for (const char* arguments : {"", "frobnicate", "check", "sample --nonsense", "check --json --csv x.pdb", "merge",
                                "check x.pdb --altloc AB", "check x.pdb --hydrogens burn"}) {
    const test::Said said = run_biocd(std::string(arguments) + " 2>&1");
    EXPECT_EQ(said.status, 2) << arguments;
    EXPECT_TRUE(said.out.starts_with("biocd: ")) << said.out;
    EXPECT_EQ(std::count(said.out.begin(), said.out.end(), '\n'), 1) << said.out;
  }
}

TEST_F(BiocdFiles, PipesDevicesAndFoldersAreWhatTheyAre) {
  EXPECT_EQ(run_biocd("info /dev/stdin <" + in + " >/dev/null").status, 0);
  EXPECT_EQ(run_tool("/bin/sh", "-c 'cat " + in + " | " HINGE_BIOCD " info /dev/stdin >/dev/null'").status, 0);
  const auto said = [&](const std::string& arguments) { return run_biocd(arguments + " 2>&1").out; };
  EXPECT_EQ(said("info /dev/zero"), "biocd: /dev/zero: is a device, expected a PDB or mmCIF file\n");
  EXPECT_EQ(said("info /tmp"), "biocd: /tmp: is a directory, expected a PDB or mmCIF file\n");
  EXPECT_NE(said("check" + in + " /dev/zero").find("/dev/zero: is a pipe or device, expected a regular file"),
            std::string::npos);
  EXPECT_NE(run_tool("/bin/sh", "-c 'cat " + in + " | " HINGE_BIOCD " check " + in + " /dev/stdin 2>&1'")
                .out.find("/dev/stdin: is a pipe or device, expected a regular file"),
            std::string::npos);
  EXPECT_EQ(said("merge /dev/zero"), "biocd: /dev/zero: is no regular file, expected one: shards are read twice\n");
  EXPECT_EQ(said("path" + in + " --from reference --to @/dev/zero"),
            "biocd: /dev/zero: is a device, expected a file\n");
}

TEST_F(BiocdFiles, NamesNeedNotBeText) {
  std::string text = content(folder / "in.pdb");
  // A residue's name in Latin-1, everywhere; and the file's.
  for (std::size_t at = 0; (at = text.find("LYS A", at)) != std::string::npos;) text[at + 1] = '\xdc';
  const std::string odd = (folder / "l\xfcs.pdb").string();
  std::ofstream(odd) << text;
  for (const std::string& command :
       {"check " + odd + " --json", "info " + odd + " --json --atoms", "sample " + odd + " --json -n 3 --free count:1",
        "path " + odd + " --free none --from reference --to reference --json"}) {
    const test::Said said = run_biocd(command + " 2>" + (folder / "notes").string());
    EXPECT_LE(said.status, 1) << command;
    const auto json = nlohmann::json::parse(said.out);
    EXPECT_NE(json["model"]["file"].get<std::string>().find("l\xEF\xBF\xBDs.pdb"), std::string::npos);
    EXPECT_NE(content(folder / "notes").find("note: a name or path is not UTF-8"), std::string::npos);
  }
}

}  // namespace
}  // namespace hinge::molecular
