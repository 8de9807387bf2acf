// SPDX-License-Identifier: BSD-3-Clause
// Tests what biocd prints for people: tables, lists that are cut, --exit-zero, and viewer scripts.
#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <cstddef>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <nlohmann/json.hpp>
#include <string>

#include "molecular/run_biocd.hpp"
#include "molecular/test_files.hpp"

namespace hinge::molecular {
namespace biocd_output_test {

namespace fs = std::filesystem;
using Json = nlohmann::json;
using test::run_biocd;
using test::Said;

std::string file() { return " " + test::ubiquitin().string() + " "; }

/// Returns the number of lines.
std::size_t lines(const std::string& text) {
  return static_cast<std::size_t>(std::count(text.begin(), text.end(), '\n'));
}

bool has(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

/// A temporary folder, and the tool run in it.
class Folder {
 public:
  Folder() {
    static int number = 0;
    path_ = fs::temp_directory_path() / ("hinge_output_" + std::to_string(getpid()) + "_" + std::to_string(number++));
    fs::create_directories(path_);
  }
  Folder(const Folder&) = delete;
  Folder& operator=(const Folder&) = delete;
  ~Folder() { fs::remove_all(path_); }
  Said run(const std::string& arguments) const {
    return test::run_tool("sh", "-c 'cd " + path_.string() + " && " + HINGE_BIOCD + " " + arguments + "'");
  }
  std::string content(const std::string& name) const {
    std::ifstream in(path_ / name, std::ios::binary);
    return {std::istreambuf_iterator<char>(in), {}};
  }
  bool holds(const std::string& name) const { return fs::exists(path_ / name); }
  const fs::path& path() const { return path_; }

 private:
  fs::path path_;
};

TEST(BiocdTables, HaveUnitsAndSingulars) {
  const Said said = run_biocd("check" + file());
  EXPECT_TRUE(has(said.out, "76 residues, 1 chain, 608 bonds\n")) << said.out;
  EXPECT_TRUE(has(said.out, "reference: 1 colliding pair; constant contacts"));
  EXPECT_TRUE(has(said.out,
                  "model 1: collides, 1 pair\n"
                  "  atom 1             atom 2             distance (A)   threshold (A)  overlap (A)\n"
                  "  A:ARG72:O          A:ARG72:CG                2.380 < 2.576                0.840\n"
                  "1 of 1 model collides\n"))
      << said.out;
  const Said path = run_biocd("path" + file() + "--free A:72:psi --exempt-reference --from reference --to -90");
  EXPECT_TRUE(has(path.out, "\n  atom 1 ")) << path.out;
  const std::size_t t = path.out.find("collides at t = ");
  ASSERT_NE(t, std::string::npos) << path.out;
  EXPECT_LE(path.out.find(',', t) - t, std::string("collides at t = 0.12345").size()) << path.out;
  EXPECT_TRUE(
      has(run_biocd("sample" + file() + "-n 5").out, "\n  atom 1             atom 2             conformations\n"));
}

TEST(BiocdMaxPairs, CutsTablesAndSaysSo) {
  const std::string within = "check" + file() + "--mode within:1 ";
  const Said usual = run_biocd(within), three = run_biocd(within + "--max-pairs 3"),
             all = run_biocd(within + "--max-pairs all");
  const Json json = Json::parse(run_biocd(within + "--json").out);
  const std::size_t pairs = json["conformations"][0]["pairs"].size();
  ASSERT_GT(pairs, 20U);
  EXPECT_FALSE(json["conformations"][0].contains("pairs_left_out"));
  EXPECT_TRUE(has(usual.out, "  ... and " + std::to_string(pairs - 20) + " more; --max-pairs all lists them\n"));
  EXPECT_TRUE(has(three.out, "  ... and " + std::to_string(pairs - 3) + " more;")) << three.out;
  EXPECT_FALSE(has(all.out, "more;"));
  EXPECT_EQ(lines(all.out), lines(three.out) + pairs - 4);
  EXPECT_EQ(run_biocd(within + "--max-pairs 0").out, all.out);
  EXPECT_TRUE(has(three.out, ", " + std::to_string(pairs) + " pairs closer"));  // all of them are counted
}

TEST(BiocdMaxPairs, CutsJsonAndCsvOnlyIfGiven) {
  for (const std::string& command : {"check" + file(), "sample" + file() + "-n 3 --sigma 10 "}) {
    const std::string within = command + "--mode within:1 ";
    const Json whole = Json::parse(run_biocd(within + "--json").out);
    const Json cut = Json::parse(run_biocd(within + "--json --max-pairs 2").out);
    EXPECT_EQ(whole["summary"], cut["summary"]);
    std::size_t left_out = 0;
    for (std::size_t k = 0; k < whole["conformations"].size(); ++k) {
      const Json &a = whole["conformations"][k], &b = cut["conformations"][k];
      EXPECT_EQ(b["pairs"].size(), 2U);
      EXPECT_EQ(b["pairs"][1], a["pairs"][1]);
      EXPECT_EQ(b["pairs_left_out"], a["pairs"].size() - 2);
      left_out += a["pairs"].size() - 2;
    }
    const Said csv = run_biocd(within + "--csv --max-pairs 2 2>&1 | grep -v left.out");
    EXPECT_EQ(lines(run_biocd(within + "--csv --max-pairs 2 2>/dev/null").out), 1 + 2 * whole["conformations"].size());
    EXPECT_TRUE(has(csv.out, "note: --max-pairs 2: " + std::to_string(left_out) + " pairs without a row\n")) << csv.out;
    EXPECT_EQ(run_biocd(within + "--csv --max-pairs 2 --parts /tmp/parts 2>/dev/null").status, 2);
  }
  const Json path = Json::parse(
      run_biocd("path" + file() + "--from 0 --to 180 --free A:30:psi --exempt-reference --json --max-pairs 1").out);
  EXPECT_EQ(path["pairs"].size(), 1U);
  EXPECT_TRUE(path["pairs_left_out"].is_number());
}

TEST(BiocdExitZero, HidesVerdictsButNoErrors) {
  const std::string path = "path" + file() + "--exempt-reference --free A:72:psi --from reference --to -90 ";
  for (const std::string& command : {"check" + file(), "sample" + file() + "-n 5 ", path}) {
    EXPECT_EQ(run_biocd(command).status, 1) << command;
    EXPECT_EQ(run_biocd(command + "--exit-zero").status, 0) << command;
    EXPECT_EQ(run_biocd(command).out.substr(0, 300), run_biocd(command + "--exit-zero").out.substr(0, 300));
  }
  // Nothing is split, so an interval that one test cannot prove stays undecided.
  const std::string undecided =
      "path" + file() + "--exempt-reference --free A:75-76 --from reference --to 179,0,0,0 --min-step 1 ";
  EXPECT_EQ(run_biocd(undecided).status, 4);
  EXPECT_EQ(run_biocd(undecided + "--exit-zero").status, 0);
  EXPECT_EQ(run_biocd("walk" + file() + "--steps 5 --exempt-reference --exit-zero").status, 0);
  EXPECT_EQ(run_biocd("walk" + file() + "--steps 5 --exit-zero 2>/dev/null").status, 3);
  EXPECT_EQ(run_biocd("check /nonexistent --exit-zero 2>/dev/null").status, 3);
  EXPECT_EQ(run_biocd("check" + file() + "--mode some --exit-zero 2>/dev/null").status, 2);
}

TEST(BiocdView, WritesAScriptAndTheStructureItOpens) {
  const Folder folder;
  const Said check = folder.run("check" + file() + "--view chimerax");
  EXPECT_TRUE(has(check.out, "view: 1ubq_clashes.cxc shows model 1 with 1 pair\n")) << check.out;
  const std::string script = folder.content("1ubq_clashes.cxc");
  EXPECT_TRUE(script.starts_with("open \"1ubq_clashes.pdb\"\n")) << script;
  EXPECT_TRUE(
      has(script, "style #1/A:72@O #1/A:72@CG sphere\ndistance #1/A:72@O #1/A:72@CG color red radius 0.1 dashes 5\n"))
      << script;
  const Said again = folder.run("check 1ubq_clashes.pdb");
  EXPECT_TRUE(has(again.out, "A:ARG72:CG                2.380 <"));

  const Said sample =
      folder.run("sample" + file() + "-n 20 --sigma 20 --seed 3 --mode any --view pymol --json 2>notes");
  EXPECT_EQ(sample.status, 1);
  EXPECT_TRUE(has(folder.content("notes"), "note: view: 1ubq_clashes.pml shows conformation "));
  EXPECT_TRUE(folder.content("1ubq_clashes.pml").starts_with("load 1ubq_clashes.pdb, conformation\n"));
  EXPECT_TRUE(has(folder.content("1ubq_clashes.pml"), "\ndistance clash100, "));
  EXPECT_FALSE(has(folder.content("1ubq_clashes.pml"), "clash101"));

  const std::string path = "path" + file() + "--free A:72:psi --exempt-reference --from reference ";
  EXPECT_TRUE(has(folder.run(path + "--to -90 --view pymol").out, "shows t = "));
  EXPECT_TRUE(has(folder.content("1ubq_clashes.pml"), "distance clash1"));
  EXPECT_TRUE(has(folder.run(path + "--to 0.1 --view pymol").out, "shows the end of the path with 0 pairs"));
  EXPECT_FALSE(has(folder.content("1ubq_clashes.pml"), "distance clash1"));
}

TEST(BiocdView, OpensTheFileOfOut) {
  const Folder folder;
  const auto run = [&](const std::string& out, const std::string& viewer) {
    const Said said = folder.run("sample" + file() + "-n 3 --sigma 20 --out " + out + " --view " + viewer);
    EXPECT_EQ(said.status, 1);
    const std::string stem = out.substr(0, out.find('.')) + "_clashes";
    EXPECT_TRUE(folder.holds(stem + ".pdb"));
    return folder.content(stem + (viewer == "pymol" ? ".pml" : ".cxc"));
  };
  EXPECT_TRUE(has(run("a.dcd", "chimerax"), "open \"a_clashes.pdb\"\nopen \"a.dcd\" structureModel #2\n"));
  EXPECT_TRUE(has(run("b.xtc", "pymol"), "load b_clashes.pdb, ensemble\nload_traj b.xtc, ensemble, 1\n"));
  EXPECT_TRUE(has(run("c.cif", "chimerax"), "open \"c.cif\" coordsets true\n"));
  EXPECT_TRUE(has(run("d.npy", "pymol"), "numpy.load(r'd.npy')"));
  EXPECT_FALSE(has(run("e.npy", "chimerax"), "structureModel"));
  EXPECT_TRUE(has(folder.run("walk" + file() + "--exempt-reference --steps 200 --out w.pdb --view pymol").out,
                  "view: w_clashes.pml shows the end of the walk"));
  EXPECT_TRUE(has(folder.content("w_clashes.pml"), "load w.pdb, ensemble\n"));
}

/// PyMOL reads "/A/-2/O" as a range of residues.
TEST(BiocdView, EscapesNegativeNumbersForPyMol) {
  const Folder folder;
  std::ifstream in(test::ubiquitin());
  std::ofstream out(folder.path() / "negative.pdb");
  for (std::string line; std::getline(in, line);) {
    if (!line.starts_with("ATOM")) continue;
    std::string number = std::to_string(std::stoi(line.substr(22, 4)) - 74);
    out << line.replace(22, 4, number.insert(0, 4 - number.size(), ' ')) << "\n";
  }
  out.close();
  EXPECT_TRUE(has(folder.run("check negative.pdb --view pymol").out, "A:ARG-2:O "));
  EXPECT_TRUE(has(folder.content("negative_clashes.pml"), "show spheres, /conformation//A/\\-2/O or "));
}

TEST(BiocdView, SpareInputs) {
  const Folder folder;
  fs::copy_file(test::ubiquitin(), folder.path() / "1ubq_clashes.pdb");
  const std::string before = folder.content("1ubq_clashes.pdb");
  const Said said = folder.run("check 1ubq_clashes.pdb --out 1ubq.dcd --view pymol 2>&1");
  EXPECT_EQ(said.status, 2);
  EXPECT_TRUE(has(said.out, "--view 1ubq_clashes.pdb: is the input 1ubq_clashes.pdb")) << said.out;
  EXPECT_EQ(folder.content("1ubq_clashes.pdb"), before);
  EXPECT_FALSE(folder.holds("1ubq.dcd"));
}

TEST(BiocdDemo, DrawsThePictureOfReadme) {
  const Folder folder;
  const Said said = folder.run("demo" + file() + "-n 1 --out .");
  EXPECT_EQ(said.status, 0) << said.out;
  std::ifstream shown(HINGE_SOURCE_DIR "/docs/images/tail.svg", std::ios::binary);
  EXPECT_TRUE(folder.content("tail.svg") == std::string(std::istreambuf_iterator<char>(shown), {}))
      << "copy the new picture";
}

TEST(BiocdDemo, TakesAChainWithoutAName) {
  const Folder folder;
  std::ifstream in(test::ubiquitin());
  std::ofstream out(folder.path() / "1ubq.pdb");
  for (std::string line; std::getline(in, line);) {
    if (line.starts_with("ATOM") || line.starts_with("TER")) line[21] = ' ';
    if (line.starts_with("ATOM") || line.starts_with("TER")) out << line << '\n';
  }
  out << "END\n";
  out.close();
  const Said said = folder.run("demo 1ubq.pdb -n 1 --out . 2>&1");
  EXPECT_EQ(said.status, 0) << said.out;
  EXPECT_TRUE(has(folder.content("tail.svg"), "19 of 40 samples free"));
}

}  // namespace biocd_output_test
}  // namespace hinge::molecular
