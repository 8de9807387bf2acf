// SPDX-License-Identifier: BSD-3-Clause
// Runs robocd with point clouds as bodies.
#include <gtest/gtest.h>

#include <string>

#include "robotics/robots.hpp"
#include "robotics/run_robocd.hpp"

namespace hinge::robotics {
namespace robocd_points_test {

TEST(RobocdPoints, AreBodies) {
  const test::TemporaryFolder folder;
  const std::string urdf = folder
                               .write("cube.urdf", R"(<robot name="cube"><link name="root"/><link name="cube">
      <collision><geometry><box size="1 1 1"/></geometry></collision></link>
      <joint name="slide" type="prismatic"><parent link="root"/><child link="cube"/>
      <limit lower="-1" upper="1" effort="1" velocity="1"/></joint></robot>)")
                               .string();
  const std::string cloud = folder.write("cloud.xyz", "1 0 0\n3 0 0\n").string();
  const auto run = [&](const std::string& shape) {
    return test::run_robocd("check " + urdf + " --zero --mode closest --env '" + shape + "'");
  };
  EXPECT_NE(run("c=points:" + cloud + " 0.25")
                .out.find("  cube                         c                                    0.25  (closest)\n"),
            std::string::npos);
  EXPECT_EQ(run("c=points:" + cloud + " 0.25").status, 0);
  EXPECT_EQ(run("points:" + cloud + " 0.5").status, 1);
  EXPECT_EQ(run("points:" + cloud + " 0.25,xyz=-0.5 0 0").status, 1);
  for (const std::string& bad : {cloud, cloud + " ", cloud + " -1", cloud + " 1,scale=2", std::string(" 1")})
    EXPECT_GT(run("points:" + bad).status, 1) << bad;
}

}  // namespace robocd_points_test
}  // namespace hinge::robotics
