// SPDX-License-Identifier: BSD-3-Clause
// Tests robocd check --parts and merge: the bytes of the whole run, and refusal of another robot.
#include <gtest/gtest.h>

#include <filesystem>
#include <string>

#include "robotics/run_robocd.hpp"

namespace hinge::robotics {
namespace robocd_parts_test {

using test::ArmFolder;
using test::run_robocd;
using test::Said;

TEST(RobocdParts, GiveTheBytesOfTheWholeRun) {
  const ArmFolder folder;
  const test::TemporaryFolder target;
  const std::string rows = (target.path() / "rows.csv").string();
  ASSERT_EQ(run_robocd("check" + folder.urdf() + " --random 23 --seed 4 --exit-zero --out " + rows).status, 0);
  int number = 0;
  for (const std::string question :
       {" --random 300", " --random 300 --mode any", " --random 40 --mode within:0.1 --env box:1,xyz=1 0 0",
        " --random 40 --mode closest", " --random 100 --contained --env sphere:2", " --zero"})
    for (const std::string format : {" --json", " --csv", " --npy"}) {
      std::string asked = "check" + folder.urdf() + question + format;
      if (const std::size_t env = asked.find("box:1,xyz=1 0 0"); env != std::string::npos)
        asked.replace(env, 15, "'box:1 1 1,xyz=1 0 0'");
      const Said whole = run_robocd(asked + " 2>/dev/null");
      ASSERT_LE(whole.status, 1) << asked;
      for (const int unit : {7, 1000}) {
        const std::string parts = (target.path() / std::to_string(number++)).string();
        const std::string divided = asked + " --unit " + std::to_string(unit) + " --parts " + parts;
        for (const char* slice : {" --slice 2/2 --threads 2", " --slice 1/2"})
          EXPECT_EQ(run_robocd(divided + slice + " 2>/dev/null").status, 0) << divided;
        const Said merged = run_robocd("merge " + parts);
        EXPECT_EQ(merged.status, whole.status) << divided;
        EXPECT_TRUE(merged.out == whole.out) << divided;
      }
    }
  const Said whole = run_robocd("check" + folder.urdf() + " --csv-in " + rows + " --csv 2>/dev/null");
  const std::string parts = (target.path() / "rows").string();
  EXPECT_EQ(run_robocd("check" + folder.urdf() + " --csv-in " + rows + " --csv --unit 5 --parts " + parts).status, 0);
  EXPECT_TRUE(run_robocd("merge " + parts).out == whole.out);
}

TEST(RobocdParts, RefuseAnotherRobotAndOptionsThatDoNotFit) {
  const ArmFolder folder;
  const test::TemporaryFolder target;
  const std::string parts = (target.path() / "parts").string();
  const std::string divided = "check" + folder.urdf() + " --random 50 --csv --unit 10 --parts " + parts;
  ASSERT_EQ(run_robocd(divided + " 2>/dev/null").status, 0);
  // A mesh that changes is another robot.
  folder.write("cube.stl", test::cube_stl(Vec3::Zero(), 0.25));
  const Said other = run_robocd(divided + " 2>&1");
  EXPECT_EQ(other.status, 3);
  EXPECT_NE(other.out.find("is another question: it has \"robot with meshes\""), std::string::npos) << other.out;
  const std::string fresh = " --parts " + (target.path() / "fresh").string();
  for (const std::string words : {" --out x.csv --csv", " --report x.html --csv", " --max-pairs 2 --csv", ""})
    EXPECT_EQ(run_robocd("check" + folder.urdf() + " --zero" + words + fresh + " 2>/dev/null").status, 2) << words;
  EXPECT_EQ(run_robocd("merge " + target.path().string() + " 2>/dev/null").status, 3);
  std::filesystem::remove(parts + "/unit-000000003.part");
  const Said missing = run_robocd("merge " + parts + " 2>&1");
  EXPECT_EQ(missing.status, 3);
  EXPECT_NE(missing.out.find("1 unit of 5 is missing: 3"), std::string::npos) << missing.out;
}

}  // namespace robocd_parts_test
}  // namespace hinge::robotics
