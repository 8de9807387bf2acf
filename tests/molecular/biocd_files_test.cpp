// SPDX-License-Identifier: BSD-3-Clause
// Tests the files of biocd: inputs that --out must not overwrite, and output errors.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <nlohmann/json.hpp>
#include <sstream>
#include <string>
#include <thread>
#include <vector>

#include "molecular/run_biocd.hpp"
#include "molecular/test_files.hpp"

namespace hinge::molecular {
namespace biocd_files_test {

namespace fs = std::filesystem;
using test::run_biocd;
using test::run_tool;

std::string content(const fs::path& path) {
  std::ifstream in(path);
  return {std::istreambuf_iterator<char>(in), {}};
}

/// Has a copy of 1UBQ in a folder of its own.
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
  // demo writes worst.pdb into its folder, so it must not read that file.
  fs::rename(folder / "other.pdb", folder / "worst.pdb");
  EXPECT_EQ(run_biocd("demo" + file("worst.pdb") + " -n 1 --out " + folder.string() + " 2>&1").status, 2);
  EXPECT_EQ(run_biocd("demo" + in + " -n 1 --out" + in + " 2>&1").status, 2);
  EXPECT_EQ(content(folder / "worst.pdb"), before);
}

TEST_F(BiocdFiles, ResultsAndConformationsDoNotMix) {
  EXPECT_EQ(run_biocd(sample + " --out" + file("x.pdb") + " >" + file("x.pdb")).status, 2);
  EXPECT_EQ(run_biocd(sample + " --out " + folder.string() + " 2>/dev/null").status, 2);
  fs::remove(folder / "x.pdb");
  // Standard output is closed: the results are lost, and this is reported.
  const test::Said said = run_biocd(sample + " --json --out" + file("x.pdb") + " 2>&1 >&-");
  EXPECT_EQ(said.status, 3);
  EXPECT_EQ(said.out, "biocd: standard output: cannot be written: Bad file descriptor; the output is cut short\n");
  EXPECT_FALSE(fs::exists(folder / "x.pdb"));
  EXPECT_EQ(run_biocd(sample + " --out" + file("x.pdb") + " >/dev/null 2>&- <&-").status, 1);
  EXPECT_NE(content(folder / "x.pdb").find("\nMODEL"), std::string::npos);
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
  // 10 million conformations would take hours: the error must end the run.
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
      "biocd: standard output: cannot be written: No space left on device; the output is cut short\n"))
      << full.out;
  // The JSON is complete and contains the error.
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
  for (const char* arguments : {"frobnicate", "check", "sample --nonsense", "check --json --csv x.pdb", "merge",
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
  EXPECT_EQ(said("merge /dev/zero"), "biocd: /dev/zero/question.json: cannot be read, expected a folder of --parts\n");
  EXPECT_EQ(said("path" + in + " --from reference --to @/dev/zero"),
            "biocd: /dev/zero: is a device, expected a file\n");
}

TEST_F(BiocdFiles, NamesNeedNotBeText) {
  std::string text = content(folder / "in.pdb");
  // Residue names and the file name contain Latin-1 characters.
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

std::string pdb_atom(int serial, const std::string& name, const std::string& residue, int number, double x, double y,
                     double z, const std::string& element, const std::string& record = "ATOM  ") {
  char line[100];
  std::snprintf(line, sizeof line, "%s%5d  %-3s %3s A%4d    %8.3f%8.3f%8.3f  1.00  0.00          %2s\n", record.c_str(),
                serial, name.c_str(), residue.c_str(), number, x, y, z, element.c_str());
  return line;
}

std::string alanine() {
  return pdb_atom(1, "N", "ALA", 1, 0, 0, 0, "N") + pdb_atom(2, "CA", "ALA", 1, 1.46, 0, 0, "C") +
         pdb_atom(3, "C", "ALA", 1, 2.0, 1.42, 0, "C") + pdb_atom(4, "O", "ALA", 1, 1.25, 2.39, 0, "O") +
         pdb_atom(5, "CB", "ALA", 1, 1.99, -0.77, -1.2, "C");
}

TEST_F(BiocdFiles, FormatsFollowTheExtensionInEveryCommand) {
  const std::string walk = "walk" + in + " --exempt-reference --steps 20 --every 10";
  for (const std::string& command : {sample, walk, "check" + in}) {
    ASSERT_LE(run_biocd(command + " --out" + file("x.dcd") + " 2>&1").status, 1) << command;
    EXPECT_EQ(content(folder / "x.dcd").substr(4, 4), "CORD") << command;
    ASSERT_LE(run_biocd(command + " --out" + file("x.npy") + " 2>&1").status, 1) << command;
    EXPECT_EQ(content(folder / "x.npy").substr(1, 5), "NUMPY") << command;
    ASSERT_LE(run_biocd(command + " --out" + file("x.cif") + " 2>&1").status, 1) << command;
    EXPECT_EQ(content(folder / "x.cif").substr(0, 5), "data_") << command;
    ASSERT_LE(run_biocd(command + " --out" + file("x.pdb") + " 2>&1").status, 1) << command;
    EXPECT_EQ(run_biocd("info" + file("x.pdb") + " 2>&1").status, 0) << command;
    const test::Said said = run_biocd(command + " --out" + file("x.xyz") + " 2>&1");
    EXPECT_EQ(said.status, 2) << command;
    EXPECT_NE(said.out.find("x.xyz: expected a file name with .pdb, .cif, .dcd, .xtc or .npy"), std::string::npos)
        << said.out;
    EXPECT_EQ(std::count(said.out.begin(), said.out.end(), '\n'), 1) << said.out;  // one line: rejected before any work
    EXPECT_FALSE(fs::exists(folder / "x.xyz"));
  }
}

TEST_F(BiocdFiles, NothingFreeIsAFileOfNoFramesOrNoFile) {
  const std::string none = "sample" + in + " -n 3 --free backbone --seed 3 --filter free --out";
  for (const std::string name : {"none.npy", "none.dcd"}) {
    const test::Said said = run_biocd(none + file(name) + " 2>&1");
    ASSERT_EQ(said.status, 1);
    EXPECT_NE(said.out.find("no conformation is free: the file holds 0 frames"), std::string::npos) << said.out;
    const test::Said read = run_biocd("check" + in + file(name) + " 2>&1");
    EXPECT_EQ(read.status, 0) << read.out;
    EXPECT_NE(read.out.find(name + ": holds 0 frames"), std::string::npos) << read.out;
  }
  std::ofstream(folder / "old.pdb") << "old";
  const test::Said said = run_biocd(none + file("old.pdb") + " 2>&1");
  EXPECT_NE(said.out.find("no file is written"), std::string::npos) << said.out;
  EXPECT_EQ(content(folder / "old.pdb"), "old");
  EXPECT_EQ(std::distance(fs::directory_iterator(folder), fs::directory_iterator{}), 4);
}

TEST_F(BiocdFiles, ModelsThatDifferAreCheckedAsWhatTheyAre) {
  // The second model also has an OXT; it overlaps an oxygen of residue 2, which all models have.
  const std::string far = pdb_atom(6, "N", "GLY", 2, 9, 9, 9, "N") + pdb_atom(7, "CA", "GLY", 2, 10.4, 9, 9, "C") +
                          pdb_atom(8, "C", "GLY", 2, 11, 10.4, 9, "C") + pdb_atom(9, "O", "GLY", 2, 10.2, 11.4, 9, "O"),
                    end = pdb_atom(10, "OXT", "GLY", 2, 1.46, 0.5, 0.5, "O");
  std::ofstream(folder / "nmr.pdb") << "MODEL        1\n"
                                    << alanine() << far << "ENDMDL\nMODEL        2\n"
                                    << alanine() << far << end << "ENDMDL\nMODEL        3\n"
                                    << alanine() << far << "ENDMDL\nEND\n";
  const test::Said said = run_biocd("check" + file("nmr.pdb") + " 2>&1");
  EXPECT_EQ(said.status, 1) << said.out;
  EXPECT_NE(said.out.find("model 1: free"), std::string::npos) << said.out;
  EXPECT_NE(said.out.find("model 2: collides"), std::string::npos) << said.out;
  EXPECT_NE(said.out.find("model 3: free"), std::string::npos) << said.out;
  EXPECT_NE(
      said.out.find(
          "model 2 has other atoms than the first model: A:GLY2:OXT is additional (10 atoms, 9 in the first model)"),
      std::string::npos)
      << said.out;
  const test::Said written = run_biocd("check" + file("nmr.pdb") + " --out" + file("all.pdb") + " 2>&1");
  EXPECT_EQ(written.status, 0) << written.out;
  EXPECT_NE(written.out.find("models differ: 1 atoms"), std::string::npos) << written.out;
  const test::Said path = run_biocd("path" + file("nmr.pdb") + " --from reference --to model:2 2>&1");
  EXPECT_NE(path.out.find("models differ: 1 atoms"), std::string::npos) << path.out;
  EXPECT_EQ(run_biocd("check" + file("nmr.pdb") + " --rigid-from" + file("nmr.pdb") + " 2>&1").status, 1);
  // As a trajectory of another file, these models are rejected.
  std::ofstream(folder / "top.pdb") << alanine() << far;
  const test::Said frames = run_biocd("check" + file("top.pdb") + file("nmr.pdb") + " 2>&1");
  EXPECT_EQ(frames.status, 3) << frames.out;
  EXPECT_NE(frames.out.find("A:GLY2:OXT is additional"), std::string::npos) << frames.out;
}

/// Converts the ATOM records of the models to mmCIF.
std::string cif_of(const std::vector<std::string>& models) {
  std::string text = "data_nmr\nloop_\n";
  for (const char* tag : {"group_PDB", "id", "type_symbol", "label_atom_id", "label_alt_id", "label_comp_id",
                          "label_asym_id", "label_seq_id", "Cartn_x", "Cartn_y", "Cartn_z", "occupancy",
                          "B_iso_or_equiv", "auth_seq_id", "auth_asym_id", "pdbx_PDB_model_num"})
    text += std::string("_atom_site.") + tag + "\n";
  std::size_t id = 0, model = 0;
  for (const std::string& atoms : models) {
    ++model;
    std::istringstream lines(atoms);
    for (std::string line; std::getline(lines, line);) {
      const auto field = [&](std::size_t column, std::size_t size) { return " " + line.substr(column - 1, size); };
      text += "ATOM " + std::to_string(++id) + field(77, 2) + field(13, 4) + " . " + field(18, 3) + " A" +
              field(23, 4) + field(31, 8) + field(39, 8) + field(47, 8) + " 1 0" + field(23, 4) + " A " +
              std::to_string(model) + "\n";
    }
  }
  return text;
}

TEST_F(BiocdFiles, ModelsThatDifferMayBeMmcif) {
  const std::string far = pdb_atom(6, "N", "GLY", 2, 9, 9, 9, "N") + pdb_atom(7, "CA", "GLY", 2, 10.4, 9, 9, "C") +
                          pdb_atom(8, "C", "GLY", 2, 11, 10.4, 9, "C") + pdb_atom(9, "O", "GLY", 2, 10.2, 11.4, 9, "O"),
                    end = pdb_atom(10, "OXT", "GLY", 2, 1.46, 0.5, 0.5, "O");
  std::ofstream(folder / "nmr.cif") << cif_of({alanine() + far, alanine() + far + end, alanine() + far});
  const test::Said said = run_biocd("check" + file("nmr.cif") + " 2>&1");
  EXPECT_EQ(said.status, 1) << said.out;
  for (const char* words : {"model 1: free", "model 2: collides", "model 3: free",
                            "model 2 has other atoms than the first model: A:GLY2:OXT is additional"})
    EXPECT_NE(said.out.find(words), std::string::npos) << words << "\n" << said.out;
  for (const std::string& command : {"info" + file("nmr.cif"), "sample" + file("nmr.cif") + " -n 1",
                                     "path" + file("nmr.cif") + " --from reference --to model:2",
                                     "check" + file("nmr.cif") + " --out" + file("all.cif")}) {
    const test::Said common = run_biocd(command + " 2>&1");
    EXPECT_LE(common.status, 1) << common.out;
    EXPECT_NE(common.out.find("models differ: 1 atoms"), std::string::npos) << command << "\n" << common.out;
  }
  // The written file has the same atoms in every model.
  const test::Said again = run_biocd("check" + file("all.cif") + " 2>&1");
  EXPECT_EQ(again.status, 0) << again.out;
  EXPECT_NE(again.out.find("0 of 3 models collide"), std::string::npos) << again.out;
  EXPECT_EQ(again.out.find("other atoms"), std::string::npos) << again.out;
}

TEST_F(BiocdFiles, SaysWhatWasLeftOut) {
  std::ofstream(folder / "wet.pdb") << alanine() << pdb_atom(6, "O", "HOH", 2, 9, 9, 9, "O", "HETATM")
                                    << pdb_atom(7, "ZN", "ZN", 3, 20, 9, 9, "ZN", "HETATM");
  const std::string line =
      "left out: ZN x1, 1 water (--hetero keeps ligands and ions, --hetero waters also keeps waters)";
  for (const std::string command :
       {"check", "sample -n 1", "path --from reference --to reference", "check --csv", "sample -n 1 --csv", "info"}) {
    const test::Said said = run_biocd(command + " " + file("wet.pdb") + " 2>&1");
    EXPECT_NE(said.out.find(line), std::string::npos) << command << said.out;
  }
  const test::Said json = run_biocd("check --json" + file("wet.pdb") + " 2>/dev/null");
  EXPECT_NE(json.out.find("\"waters_left_out\": 1"), std::string::npos) << json.out;
  const test::Said kept = run_biocd("check" + file("wet.pdb") + " --hetero 2>&1");
  EXPECT_NE(kept.out.find("left out: 1 water (--hetero waters keeps them)"), std::string::npos) << kept.out;
  EXPECT_NE(run_biocd("check --hetero" + file("wet.pdb") + " 2>&1").out.find("6 atoms"), std::string::npos);
  for (const std::string words : {"--hetero waters", "--hetero=waters"}) {
    const test::Said all = run_biocd("check " + words + file("wet.pdb") + " 2>&1");
    EXPECT_NE(all.out.find("7 atoms"), std::string::npos) << all.out;
    EXPECT_EQ(all.out.find("left out"), std::string::npos) << all.out;
  }
  const test::Said info = run_biocd("info --json --hetero waters" + file("wet.pdb") + " 2>/dev/null");
  EXPECT_NE(info.out.find("\"water\":"), std::string::npos) << info.out;
  EXPECT_NE(info.out.find("\"ion\":"), std::string::npos) << info.out;
  EXPECT_EQ(run_biocd("check --hetero=salt" + file("wet.pdb") + " 2>&1").status, 2);
}

TEST_F(BiocdFiles, OfWatersAloneAreCheckedThoughNothingTurns) {
  std::ofstream(folder / "waters.pdb") << pdb_atom(1, "O", "HOH", 1, 0, 0, 0, "O", "HETATM")
                                       << pdb_atom(2, "O", "HOH", 2, 2, 0, 0, "O", "HETATM");
  const test::Said said = run_biocd("check" + file("waters.pdb") + " 2>&1");
  EXPECT_EQ(said.status, 1) << said.out;  // 2.000 < 0.8 * (1.52 + 1.52)
  EXPECT_NE(said.out.find("the file holds only waters"), std::string::npos) << said.out;
  EXPECT_EQ(run_biocd("check --free phi" + file("waters.pdb") + " 2>&1").status, 2);
}

TEST_F(BiocdFiles, SamplesSayTheTorsionsTheyDrew) {
  const std::string command = "sample" + in + " --free A:20-22:phi -n 6 --seed 4 --mode any --torsions";
  const test::Said csv = run_biocd(command + " --csv --torsions-out" + file("t.npy") + " 2>/dev/null"),
                   json = run_biocd(command + " --json --threads 2 2>/dev/null");
  ASSERT_LE(csv.status, 1);
  const std::string head = csv.out.substr(0, csv.out.find('\n'));
  EXPECT_NE(head.find(",A:THR22:phi,A:ASP21:phi,A:SER20:phi"), std::string::npos) << head;
  const std::size_t row = csv.out.find('\n') + 1;
  std::string last = csv.out.substr(row, csv.out.find('\n', row) - row);
  for (int k = 0; k < 7; ++k) last.erase(0, last.find(',') + 1);
  while (std::count(last.begin(), last.end(), ',') > 2) last.erase(0, last.find(',') + 1);
  EXPECT_NE(json.out.find("\"torsions\":[" + last + "]"), std::string::npos) << last << json.out;
  const std::string npy = content(folder / "t.npy");
  EXPECT_NE(npy.find("'shape': (6, 3)"), std::string::npos);
  ASSERT_EQ(npy.size(), 128U + 6 * 3 * 8);
  double first = 0.0;
  std::memcpy(&first, npy.data() + 128, sizeof first);
  EXPECT_NEAR(first, std::stod(last), 1e-12);
  // The torsions are the dihedral angles of the written coordinates: info finds them as the reference of that file.
  ASSERT_LE(run_biocd("sample" + in + " --free A:20-22:phi -n 1 --seed 4 --out" + file("s.cif") + " 2>&1").status, 1);
  const test::Said info = run_biocd("info --json --atoms" + file("s.cif") + " --free A:20-22:phi 2>/dev/null");
  const std::size_t at = info.out.find("\"reference_degrees\": ");
  ASSERT_NE(at, std::string::npos);
  EXPECT_NEAR(std::stod(info.out.substr(at + 21)), first, 1e-6);
  EXPECT_EQ(run_biocd(command + " 2>&1").status, 2);
}

}  // namespace biocd_files_test
}  // namespace hinge::molecular
