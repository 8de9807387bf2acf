// SPDX-License-Identifier: BSD-3-Clause
// Tests that the output of biocd has the same bytes on every instruction set, with every thread count and engine.
#include <gtest/gtest.h>

#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

#include "hinge/detail/simd/instruction_set.hpp"
#include "hinge/molecular/read_structure.hpp"
#include "molecular/run_biocd.hpp"
#include "molecular/test_files.hpp"
#include "tool/foreign_programs.hpp"

namespace hinge::molecular {
namespace biocd_bytes_test {

using detail::simd::InstructionSet;
using test::run_biocd;
using test::Said;

std::string file() { return test::ubiquitin().string(); }

/// A file of several models, some free and some colliding, written by biocd; removed by the destructor.
class Sampled {
 public:
  Sampled() : file_("") {
    said_ = run_biocd("sample " + file() + " -n 12 --seed 4 --sigma 0.4 --rho 0.7 --csv --mode any --out " + path());
  }
  std::string path() const { return file_.path().string(); }
  const Said& said() const { return said_; }

 private:
  test::TemporaryFile file_;
  Said said_;
};

/// Returns command lines of sample and check in every mode and output: full turns and small ones, selections with small
/// and with large groups.
std::vector<std::string> questions(const std::string& models) {
  std::vector<std::string> all;
  for (const char* output : {"--json", "--csv"})
    for (const char* mode : {"any", "all", "within:0.4", "closest"}) {
      const std::string how = std::string(" --mode ") + mode + " " + output;
      for (const char* what :
           {"-n 40 --seed 3", "-n 60 --seed 5 --sigma 0.5 --free loops --exempt-reference",
            "-n 60 --seed 7 --free count:4 --radii amber", "-n 20 --seed 8 --sigma 2 --free chi --rho 0.9"})
        all.push_back("sample " + file() + " " + what + how);
      all.push_back("check " + models + how);
      all.push_back("check " + models + " --rho 0.7" + how);
    }
  return all;
}

/// Returns command lines of walks with one and with several torsions per step, which also print the written models.
std::vector<std::string> walks(const std::string& models) {
  std::vector<std::string> all;
  for (const char* how : {"--steps 3000 --seed 3", "--steps 1500 --changes 5 --step-size 0.5",
                          "--steps 500 --changes 60 --step-size 0.05 --free backbone"})
    all.push_back("walk " + file() + " --exempt-reference --json --every 500 " + how + " --out " + models + " && cat " +
                  models);
  return all;
}

/// Returns command lines of relaxations by descent alone, with restarts and of a loop, which also print the result.
std::vector<std::string> relaxations(const std::string& models, const std::string& result) {
  std::vector<std::string> all;
  for (const std::string& what : {file() + " --loop A:70-74", models + " --model 2 --free all --tries 3",
                                  models + " --model 5 --free A:20-50 --tries 2 --seed 6"})
    all.push_back("relax " + what + " --json --out " + result + " && cat " + result);
  return all;
}

/// Expects the same bytes and exit status from every variation of a question.
void expect_same(const std::string& question, const std::vector<std::string>& variations,
                 const std::string& environment) {
  const Said expected = run_biocd(question + " 2>/dev/null", "HINGE_ISA=baseline");
  ASSERT_TRUE(expected.status == 0 || expected.status == 1) << question;
  ASSERT_FALSE(expected.out.empty()) << question;
  for (const std::string& variation : variations) {
    const Said said = run_biocd(question + variation + " 2>/dev/null", environment);
    EXPECT_EQ(said.status, expected.status) << environment << ' ' << question << variation;
    // EXPECT_EQ would print megabytes.
    EXPECT_TRUE(said.out == expected.out) << environment << ' ' << question << variation << ": " << said.out.size()
                                          << " bytes, expected " << expected.out.size();
  }
}

TEST(Biocd, RunsNoProgramOfAnotherBuild) { test::expect_own_build_only(HINGE_BIOCD); }

TEST(BiocdBytes, AreTheSameOnEveryInstructionSet) {
  const Sampled sampled;
  ASSERT_NE(sampled.said().out.find(",1,"), std::string::npos) << "no model collides: the comparison says too little";
  ASSERT_NE(sampled.said().out.find(",0,"), std::string::npos) << "no model is free: the comparison says too little";
  std::string compared;
  for (const InstructionSet set : {InstructionSet::avx2, InstructionSet::avx512}) {
    const std::string name(detail::simd::name(set)), environment = "HINGE_ISA=" + name;
    if (set > detail::simd::of_this_cpu()) {
      EXPECT_EQ(run_biocd("--version 2>&1", environment).status, 2) << "this CPU lacks " << name;
      continue;
    }
    // Only Release builds have a program for each instruction set; otherwise the baseline program answers: skip.
    if (run_biocd("--version", environment).out.find("(" + name + ")") == std::string::npos) continue;
    compared += name;
    for (const std::string& question : questions(sampled.path())) expect_same(question, {""}, environment);
    const test::TemporaryFile models("");
    for (const std::string& question : walks(models.path().string())) expect_same(question, {""}, environment);
    for (const std::string& question : relaxations(sampled.path(), models.path().string()))
      expect_same(question, {""}, environment);
  }
  if (compared.empty()) GTEST_SKIP() << "biocd comes for the baseline only, or the CPU has no more";
}

TEST(BiocdBytes, AreTheSameForEveryEngineAndThreadCount) {
  const Sampled sampled;
  for (const std::string& question : questions(sampled.path()))
    expect_same(question, {" --threads 2", " --threads 8", " --engine lazy", " --engine brute --threads 2"}, "");
  const test::TemporaryFile result("");
  for (const std::string& question : relaxations(sampled.path(), result.path().string()))
    for (const char* engine : {" --engine lazy", " --engine brute"}) {
      // The JSON names no engine, so it is the same, too.
      std::string other = question;
      other.insert(other.find(" --json"), engine);
      EXPECT_TRUE(run_biocd(other + " 2>/dev/null").out == run_biocd(question + " 2>/dev/null").out) << other;
    }
}

}  // namespace biocd_bytes_test
}  // namespace hinge::molecular
