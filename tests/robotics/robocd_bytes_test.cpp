// SPDX-License-Identifier: BSD-3-Clause
// Tests that robocd prints the same bytes on every instruction set, with every number of threads and every engine.
#include <gtest/gtest.h>

#include <string>

#include "hinge/detail/simd/instruction_set.hpp"
#include "robotics/run_robocd.hpp"
#include "tool/foreign_programs.hpp"

namespace hinge::robotics {
namespace robocd_bytes_test {

using test::ArmFolder;
using test::run_robocd;
using test::Said;

TEST(RobocdBytes, AreTheSameForEveryEngineAndThreadCount) {
  const ArmFolder arm;
  arm.write("env.stl", test::cube_stl({0, 1.625, 0}, 0.125));
  for (const char* output : {" --json", " --csv"})
    for (const char* mode : {"any", "all", "within:0.3"}) {
      const std::string command =
          "check" + arm.urdf() + " --random 300 --seed 9 --env" + arm.file("env.stl") + output + " --mode " + mode;
      const Said one = run_robocd(command);
      EXPECT_EQ(one.status, 1);
      for (const char* variation : {" --threads 3", " --engine lazy", " --engine brute --threads 2"})
        EXPECT_TRUE(run_robocd(command + variation).out == one.out) << command << variation;
    }
  const std::string closest = "check" + arm.urdf() + " --random 300 --seed 9 --csv --mode closest";
  EXPECT_TRUE(run_robocd(closest).out == run_robocd(closest + " --threads 3").out);
}

TEST(Robocd, RunsNoProgramOfAnotherBuild) { test::expect_own_build_only(HINGE_ROBOCD); }

TEST(RobocdBytes, AreTheSameOnEveryInstructionSet) {
  const ArmFolder arm;
  std::string compared;
  for (const auto set : {detail::simd::InstructionSet::avx2, detail::simd::InstructionSet::avx512}) {
    const std::string name(detail::simd::name(set)), environment = "HINGE_ISA=" + name;
    if (set > detail::simd::of_this_cpu()) {
      EXPECT_EQ(run_robocd("--version 2>&1", environment).status, 2) << "this CPU lacks " << name;
      continue;
    }
    if (run_robocd("--version", environment).out.find("(" + name + ")") == std::string::npos) continue;
    compared += name;
    for (const char* mode : {"any", "all", "within:0.3", "closest"}) {
      const std::string command = "check" + arm.urdf() + " --random 200 --csv --mode " + mode;
      EXPECT_TRUE(run_robocd(command, environment).out == run_robocd(command, "HINGE_ISA=baseline").out) << command;
    }
    const std::string relax = "relax" + arm.urdf() + " --from zero --env box:'0.5 0.5 0.5' --json";
    EXPECT_TRUE(run_robocd(relax, environment).out == run_robocd(relax, "HINGE_ISA=baseline").out);
  }
  EXPECT_EQ(run_robocd("--version 2>&1", "HINGE_ISA=x").status, 2);
  if (compared.empty()) GTEST_SKIP() << "robocd comes for the baseline only, or the CPU has no more";
}

}  // namespace robocd_bytes_test
}  // namespace hinge::robotics
