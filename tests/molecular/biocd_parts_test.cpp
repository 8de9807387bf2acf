// SPDX-License-Identifier: BSD-3-Clause
// Tests biocd --parts and merge: the bytes of the whole run however it is divided, killed and continued, and refusal of
// what does not belong together.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>
#include <utility>
#include <vector>

#include "hinge/core/philox.hpp"
#include "molecular/run_biocd.hpp"
#include "molecular/test_files.hpp"
#include "tool/temporary_folder.hpp"

namespace hinge::molecular {
namespace biocd_parts_test {

using test::run_biocd;
using test::Said;
using test::TemporaryFolder;

std::string ubiquitin() { return test::ubiquitin().string(); }
const std::string tail = "sample " + ubiquitin() + " --free A:70-76 --exempt-reference --sigma 5 ";

bool has(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

std::string content(const std::filesystem::path& path) {
  std::ifstream in(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

std::size_t count_files(const std::filesystem::path& folder, const std::string& extension) {
  std::size_t count = 0;
  for (const auto& entry : std::filesystem::directory_iterator(folder)) count += entry.path().extension() == extension;
  return count;
}

/// A folder of parts that does not exist yet.
struct Parts {
  TemporaryFolder in;
  std::string path = (in.path() / "made" / "parts").string();
  std::filesystem::path unit(int number) const { return path + "/unit-00000000" + std::to_string(number) + ".part"; }
  std::string question() const { return path + "/question.json"; }
};

TEST(BiocdParts, GiveTheBytesOfTheWholeRun) {
  const TemporaryFolder folder;
  const std::string poses = (folder.path() / "poses.npy").string();
  ASSERT_LE(run_biocd("sample " + ubiquitin() + " -n 12 --seed 4 --sigma 0.4 --exit-zero --out " + poses).status, 0);
  const std::string check = "check " + ubiquitin() + " " + poses;
  const std::vector<std::pair<std::string, std::string>> questions = {
      {check + " --rho 0.7", "json csv npy"},
      {check + " --rules molprobity", "json csv"},
      {check + " --by residue", "json"},
      {"check " + test::molecule_file("1crn.pdb").string() + " --mode within:0.2", "json csv npy"},
      {tail + "-n 12 --torsions", "json csv"},
      {tail + "-n 100 --mode any", "json csv npy"},
      {"sample " + ubiquitin() + " -n 12 --sigma 0.4 --rules posebusters --mode closest", "json csv"},
      {"sample " + ubiquitin() + " --prior uniform --collision-free -n 12 --tries 1",
       "json csv npy"},  // some are missing
      {"sample " + test::molecule_file("1crn.pdb").string() + " -n 12 --sigma 4", "json csv npy"}};
  for (const auto& [question, formats] : questions)
    for (const std::string format : {"json", "csv", "npy"}) {
      if (!has(formats, format)) continue;
      const std::string asked = question + " --" + format;
      const Said whole = run_biocd(asked + " 2>/dev/null");
      ASSERT_FALSE(whole.out.empty()) << asked;
      for (const int unit : {1, 5, 12, 1000}) {
        const Parts parts;
        const std::string divided = asked + " --parts " + parts.path + " --unit " + std::to_string(unit);
        for (const char* how : {" --slice 2/3 --threads 2", " --slice 1/3", " --slice 3/3"})
          EXPECT_EQ(run_biocd(divided + how + " 2>/dev/null").status, 0) << divided;
        const Said merged = run_biocd("merge " + parts.path);
        EXPECT_EQ(merged.status, whole.status) << divided;
        EXPECT_TRUE(merged.out == whole.out) << divided;
        const std::filesystem::path out = parts.in.path() / ("out." + format);
        EXPECT_EQ(run_biocd("merge " + parts.path + " --out " + out.string()).status, whole.status);
        EXPECT_TRUE(content(out) == whole.out) << divided;
      }
    }
}

TEST(BiocdParts, WritesVerdictsAsNumpyArrays) {
  const std::string csv = run_biocd(tail + "-n 50 --mode any --csv 2>/dev/null").out;
  const std::string npy = run_biocd(tail + "-n 50 --mode any --npy 2>/dev/null").out;
  ASSERT_EQ(npy.size(), 128U + 50);
  EXPECT_EQ(npy.substr(0, 8), std::string("\x93NUMPY\x01\x00", 8));
  EXPECT_EQ(npy[8], 118);  // the length of the dictionary
  EXPECT_TRUE(has(npy, "{'descr': '|u1', 'fortran_order': False, 'shape': (50,), }"));
  EXPECT_EQ(npy[127], '\n');
  std::size_t at = csv.find('\n') + 1, colliding = 0;
  for (std::size_t k = 0; k < 50; ++k) {
    const char verdict = csv[csv.find(',', at) + 1];
    EXPECT_EQ(npy[128 + k], verdict - '0') << k;
    colliding += verdict == '1' ? 1U : 0U;
    at = csv.find('\n', at) + 1;
  }
  EXPECT_GT(colliding, 0U);
  EXPECT_LT(colliding, 50U);
  // A sample that was not found is 2.
  const Said some =
      run_biocd("sample " + ubiquitin() + " --prior uniform --collision-free -n 30 --tries 1 --npy 2>/dev/null");
  EXPECT_EQ(some.out.size(), 128U + 30);
  EXPECT_GT(std::count(some.out.begin() + 128, some.out.end(), '\x02'), 0);
}

TEST(BiocdParts, OfNoConformationAreEmpty) {
  const TemporaryFolder folder;
  const std::string none = (folder.path() / "none.npy").string();
  ASSERT_EQ(run_biocd("sample " + ubiquitin() + " -n 1 --rho 5 --filter free --exit-zero --out " + none).status, 0);
  for (const std::string format : {" --json", " --csv", " --npy"}) {
    const Parts parts;
    const std::string asked = "check " + ubiquitin() + " " + none + format;
    const Said whole = run_biocd(asked + " 2>/dev/null");
    EXPECT_EQ(run_biocd(asked + " --parts " + parts.path + " 2>/dev/null").status, 0);
    const Said merged = run_biocd("merge " + parts.path);
    EXPECT_EQ(merged.status, whole.status);
    EXPECT_TRUE(merged.out == whole.out) << whole.out << merged.out;
  }
}

TEST(BiocdParts, SurviveBeingKilledAtAnyTime) {
  const std::string asked = tail + "-n 40000 --csv --mode any";
  const Parts parts;
  const std::string divided = asked + " --unit 500 --parts " + parts.path;
  SampleStream random(2026, 0);
  for (int kill = 0; kill < 12; ++kill) {
    const double seconds = 0.02 + 0.1 * random.uniform();
    const std::string command =
        "timeout -s KILL " + std::to_string(seconds) + " " + HINGE_BIOCD + " " + divided + " >/dev/null 2>&1";
    std::system(command.c_str());
  }
  const Said last = run_biocd(divided + " --slice 1/2 2>&1 >/dev/null");
  EXPECT_EQ(last.out.find("damaged"), std::string::npos) << last.out;  // a killed process leaves no broken unit
  EXPECT_EQ(run_biocd("merge " + parts.path + " 2>/dev/null").out.empty(), count_files(parts.path, ".part") < 80);
  EXPECT_EQ(run_biocd(divided + " 2>/dev/null").status, 0);
  EXPECT_TRUE(run_biocd("merge " + parts.path + " 2>/dev/null").out == run_biocd(asked + " 2>/dev/null").out);
}

TEST(BiocdParts, TwoProcessesMayWorkOnTheSameUnits) {
  const std::string asked = tail + "-n 20000 --json --mode any";
  const Parts parts;
  const std::string program = std::string(HINGE_BIOCD) + " " + asked + " --unit 500 --parts " + parts.path + " 2>&1";
  const Said both = test::run_shell("( " + program + " & " + program + "; wait )");
  EXPECT_EQ(both.status, 0) << both.out;
  EXPECT_TRUE(run_biocd("merge " + parts.path).out == run_biocd(asked + " 2>/dev/null").out);
}

TEST(BiocdParts, RefusesWhatIsMissingOrDamaged) {
  for (const std::string format : {"--json", "--csv", "--npy"}) {
    const std::string asked = tail + "-n 40 " + format;
    const Parts parts;
    const std::string divided = asked + " --unit 10 --parts " + parts.path;
    const auto refused = [&](const std::string& reason) {
      const Said merged = run_biocd("merge " + parts.path + " 2>&1");
      EXPECT_EQ(merged.status, 3) << reason;
      EXPECT_TRUE(merged.out.starts_with("biocd: ")) << merged.out;  // nothing was printed
      EXPECT_EQ(std::count(merged.out.begin(), merged.out.end(), '\n'), 1);
      EXPECT_TRUE(has(merged.out, reason)) << merged.out;
      // The run mends it.
      EXPECT_EQ(run_biocd(divided + " 2>/dev/null").status, 0);
      EXPECT_TRUE(run_biocd("merge " + parts.path).out == run_biocd(asked + " 2>/dev/null").out);
    };
    ASSERT_EQ(run_biocd(divided + " --slice 2/4 2>/dev/null").status, 0);
    refused("3 units of 4 are missing: 0, 2-3");
    const std::string whole = content(parts.unit(2));
    std::ofstream(parts.unit(2), std::ios::binary) << whole.substr(0, whole.size() - 20);
    refused("is damaged: it has no last line, so it is cut short");
    for (const std::size_t at : {whole.find('\n') + 2, whole.rfind("colliding") + 10, whole.size() - 5}) {
      std::string changed = whole;
      changed[at] = changed[at] == '7' ? '8' : '7';
      std::ofstream(parts.unit(2), std::ios::binary) << changed;
      refused("is damaged: ");
    }
    std::filesystem::copy_file(parts.unit(1), parts.unit(2), std::filesystem::copy_options::overwrite_existing);
    refused("its first line is not that of unit 2");
    std::ofstream(parts.unit(2), std::ios::binary) << "";
    refused("is damaged");
    std::filesystem::remove(parts.unit(3));
    refused("1 unit of 4 is missing: 3");
  }
}

TEST(BiocdParts, RefusesAnotherQuestion) {
  const TemporaryFolder folder;
  const std::filesystem::path input = folder.path() / "in.pdb";
  std::filesystem::copy_file(ubiquitin(), input);
  const std::string start = "sample " + input.string() + " --free A:70-76 --exempt-reference --sigma 5 -n 40 ";
  const Parts parts;
  const std::string to = " --parts " + parts.path;
  ASSERT_EQ(run_biocd(start + "--csv --unit 10" + to + " 2>/dev/null").status, 0);
  const auto refused = [&](const std::string& command, const std::string& reason) {
    const Said said = run_biocd(command + to + " 2>&1");
    EXPECT_EQ(said.status, 3) << command;
    EXPECT_TRUE(has(said.out, "is another question") && has(said.out, reason)) << said.out;
  };
  refused(start + "--csv --unit 20", "it has \"unit\": 10, expected \"unit\": 20");
  refused(start + "--json --unit 10", "\"format\": \"csv\", expected \"format\": \"json\"");
  refused(start + "--csv --unit 10 --seed 2", "expected \"--seed\"");
  EXPECT_EQ(run_biocd(start + "--csv --unit=10 --threads 2 --exit-zero" + to + " 2>/dev/null").status, 0);
  // Another monomer dictionary may give other bonds. Only the environment names it, so the model must tell.
  std::string atoms;
  for (const char* atom : {"    1  C1  LIG A   1       0.000   0.000", "    2  C2  LIG A   1       1.500   0.000",
                           "    3  C3  LIG A   1       2.200   1.300"})
    atoms += std::string("HETATM") + atom + "   0.000  1.00  0.00           C\n";
  const std::string ligand = folder.write("ligand.pdb", atoms).string();
  const std::filesystem::path component = folder.write("monomers/l/LIG.cif",
                                                       "data_comp_LIG\nloop_\n_chem_comp_bond.comp_id\n"
                                                       "_chem_comp_bond.atom_id_1\n_chem_comp_bond.atom_id_2\n"
                                                       "_chem_comp_bond.type\nLIG C1 C2 single\nLIG C2 C3 double\n");
  const Parts bonds;
  const std::string check = "check " + ligand + " --hetero --csv --parts " + bonds.path + " 2>&1";
  const std::string monomers = "CLIBD_MON=" + component.parent_path().parent_path().string();
  ASSERT_EQ(run_biocd(check, monomers).status, 0);
  const Said otherwise = run_biocd(check, "CLIBD_MON=" + folder.path().string());
  EXPECT_EQ(otherwise.status, 3);
  EXPECT_TRUE(has(otherwise.out, "is another question: it has \"model\": ")) << otherwise.out;
  EXPECT_EQ(run_biocd(check, monomers).status, 0);
  // A unit of another question.
  const Parts other;
  ASSERT_EQ(run_biocd(start + "--csv --unit 10 --seed 3 --parts " + other.path + " 2>/dev/null").status, 0);
  std::filesystem::copy_file(other.unit(1), parts.unit(1), std::filesystem::copy_options::overwrite_existing);
  const Said mixed = run_biocd("merge " + parts.path + " 2>&1");
  EXPECT_EQ(mixed.status, 3);
  EXPECT_TRUE(has(mixed.out, "is a unit of another question")) << mixed.out;
  // Another content of an input file.
  std::ofstream(input, std::ios::app) << "REMARK\n";
  refused(start + "--csv --unit 10", "sha256");
  EXPECT_EQ(run_biocd("merge " + folder.path().string() + " 2>&1").status, 3);
  std::ofstream(parts.question()) << "{}";
  EXPECT_TRUE(has(run_biocd("merge " + parts.path + " 2>&1").out, "question.json: is damaged"));
  // A file to write has the extension of the format, and is no input.
  for (const std::string name : {"x.npy", "x.json", "x"}) {
    const Said said = run_biocd("merge " + other.path + " --out " + (folder.path() / name).string() + " 2>&1");
    EXPECT_EQ(said.status, 2);
    EXPECT_TRUE(has(said.out, "expected a file name with .csv, the format of the run")) << said.out;
  }
  EXPECT_FALSE(std::filesystem::exists(folder.path() / "x.npy"));
}

TEST(BiocdParts, RefusesOptionsThatDoNotFit) {
  const Parts parts;
  const std::string to = "--parts " + parts.path + " ";
  for (const std::string& words : std::vector<std::string>{
           to, "--csv --out x.pdb " + to, "--csv --report x.html " + to, "--csv --torsions-out x.npy " + to,
           "--csv --max-pairs 3 " + to, "--csv --view pymol " + to, "--csv --collision-free --time 1 " + to,
           "--csv --unit 0 " + to, "--csv --unit 3 ", "--csv --slice 1/2 ", "--csv --serve ", "--csv --npy " + to})
    EXPECT_EQ(run_biocd(tail + "-n 10 " + words + " 2>/dev/null").status, 2) << words;
  for (const char* slice : {"0/3", "4/3", "1", "a/b", "1/0", "-1/2", "1/2/3", "1/9999999"})
    EXPECT_EQ(run_biocd(tail + "-n 10 --csv " + to + "--slice " + slice + " 2>/dev/null").status, 2) << slice;
  EXPECT_FALSE(std::filesystem::exists(parts.path));
  EXPECT_EQ(run_biocd(tail + "-n 10 --csv --parts " + ubiquitin() + " 2>/dev/null").status, 3);  // a file
  EXPECT_EQ(run_biocd(tail + "-n 10 --csv --parts /proc/none 2>/dev/null").status, 3);
}

TEST(BiocdParts, KeepFinishedUnitsOnAFullDisk) {
  const std::string asked = "sample " + ubiquitin() + " --free A:70-76 --seed 2 -n 30 --json";
  const Parts parts;
  const std::string divided = asked + " --unit 10 --parts " + parts.path;
  ASSERT_EQ(run_biocd(divided + " --slice 1/3 2>/dev/null").status, 0);
  // The limit of a file's size stands for a full disk: units are longer.
  const Said full = test::run_shell("( ulimit -f 4; " + std::string(HINGE_BIOCD) + " " + divided + " 2>&1 )");
  EXPECT_EQ(full.status, 3);
  EXPECT_TRUE(has(full.out, "unit-000000001.part: cannot be written: ")) << full.out;
  EXPECT_EQ(count_files(parts.path, ".part"), 1U);
  EXPECT_EQ(count_files(parts.path, ".partial"), 0U);
  ASSERT_EQ(run_biocd(divided + " 2>/dev/null").status, 0);
  EXPECT_TRUE(run_biocd("merge " + parts.path).out == run_biocd(asked + " 2>/dev/null").out);
}

TEST(BiocdParts, UnderstandSlurmArrays) {
  const Parts parts;
  const std::string divided = tail + "-n 60 --csv --unit 10 --parts " + parts.path;
  const std::string slurm = "SLURM_ARRAY_TASK_MIN=4 SLURM_ARRAY_TASK_MAX=6 SLURM_ARRAY_TASK_ID=";
  const Said one = run_biocd(divided + " 2>&1", slurm + "5");
  EXPECT_TRUE(has(one.out, "note: slice 2/3, by SLURM_ARRAY_TASK_ID 5")) << one.out;
  EXPECT_TRUE(std::filesystem::exists(parts.unit(1)) && std::filesystem::exists(parts.unit(4)));
  EXPECT_EQ(count_files(parts.path, ".part"), 2U);
  run_biocd(divided + " --slice 1/6 2>/dev/null", slurm + "5");  // the option has precedence
  EXPECT_EQ(count_files(parts.path, ".part"), 3U);
  run_biocd(divided + " 2>/dev/null", "SLURM_ARRAY_TASK_ID=7");  // not a task of an array
  EXPECT_EQ(count_files(parts.path, ".part"), 6U);
}

TEST(BiocdParts, ServeUnitsOnDemand) {
  const Parts parts;
  const std::string divided = tail + "-n 60 --csv --unit 10 --parts " + parts.path;
  const std::string program = std::string(HINGE_BIOCD) + " " + divided + " --serve 2>&1";
  const Said said = test::run_shell("printf '3\\n0\\n3\\n' | " + program);
  EXPECT_EQ(said.status, 0);
  EXPECT_TRUE(said.out.starts_with("ready 6 ")) << said.out;
  EXPECT_TRUE(has(said.out, "\ndone 3 ") && has(said.out, "\ndone 0 ") && has(said.out, "\nthere 3 ")) << said.out;
  EXPECT_EQ(count_files(parts.path, ".part"), 2U);
  const Said odd = test::run_shell("printf '6\\n' | " + program);
  EXPECT_EQ(odd.status, 2);
  EXPECT_TRUE(has(odd.out, "unit '6': expected a whole number from 0 to 5")) << odd.out;
}

}  // namespace biocd_parts_test
}  // namespace hinge::molecular
