// SPDX-License-Identifier: BSD-3-Clause
// Tests point clouds: against single spheres, as meshes, and from files.
#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "hinge/core/error.hpp"
#include "hinge/core/philox.hpp"
#include "hinge/robotics/environment.hpp"
#include "hinge/robotics/read_points.hpp"
#include "hinge/robotics/robot_checker.hpp"
#include "robotics/robots.hpp"

namespace hinge::robotics {
namespace point_cloud_test {

constexpr std::uint64_t seed = 4711;

std::shared_ptr<const std::vector<Vec3>> points(std::vector<Vec3> all) {
  return std::make_shared<const std::vector<Vec3>>(std::move(all));
}

std::shared_ptr<const Robot> cube() {
  RobotDescription robot{"cube", {{"root"}, {"cube", {{BoxShape{}}}}}, {}};
  robot.joints.push_back({"slide", JointType::prismatic, "root", "cube"});
  return std::make_shared<const Robot>(robot);
}

TEST(PointCloud, AnswersAsItsSpheresDo) {
  const auto robot = cube();
  for (std::uint64_t k = 0; k < 200; ++k) {
    SCOPED_TRACE("seed " + std::to_string(seed) + ", case " + std::to_string(k));
    SampleStream random(seed, k);
    const double radius = k % 5 == 0 ? 0.0 : 0.3 * random.uniform();
    std::vector<Vec3> centers(1 + k % 40);
    for (Vec3& x : centers)
      for (int c = 0; c < 3; ++c) x[c] = 4 * random.uniform() - 2;
    const Pose pose{Mat3::Identity(), Vec3(random.uniform(), random.uniform(), 0)};
    Environment cloud, spheres;
    cloud.add(PointCloudShape{points(centers), radius}, pose);
    for (const Vec3& x : centers) spheres.add(SphereShape{radius}, pose * Pose{Mat3::Identity(), x});
    RobotChecker checker(robot, tested_pairs(*robot), LinkMargins(*robot));
    checker.update(std::vector<double>{random.uniform() - 0.5});
    EXPECT_EQ(checker.collides(cloud), checker.collides(spheres));
    const auto one = checker.closest(cloud), many = checker.closest(spheres);
    ASSERT_TRUE(one && many);
    EXPECT_NEAR(one->distance, many->distance, 1e-15);
  }
}

TEST(PointCloud, HasOneTriangleAPointAndClosedSpheresAsMeshes) {
  const PointCloudShape cloud{points({Vec3(1, 2, 3), Vec3(-4, 5, 6)}), 0.25};
  const Surface exact = tessellate(cloud);
  ASSERT_EQ(exact.triangles.size(), 2U);
  EXPECT_EQ(exact.radius, 0.25);
  EXPECT_EQ(exact.triangles[1].a, Vec3(-4, 5, 6));
  EXPECT_EQ(exact.triangles[1].b, exact.triangles[1].c);
  const Surface meshes = tessellate(cloud, {Tessellation::Manner::inscribed, 1e-3});
  EXPECT_EQ(meshes.triangles.size(), 640U);
  EXPECT_EQ(meshes.radius, 0.0);
  EXPECT_TRUE(closed(meshes.triangles));
  EXPECT_THROW(tessellate(PointCloudShape{points(std::vector<Vec3>(4000, Vec3::Zero())), 1.0},
                          {Tessellation::Manner::inscribed, 1e-3}),
               ModelError);
  EXPECT_EQ(Robot(RobotDescription{"cloud", {{"root", {{cloud}}}}, {}}).radii().size(), 2U);
}

TEST(PointCloud, OfNothingOrWithBadNumbersIsRefused) {
  const auto refused = [](const Shape& shape) {
    try {
      Environment().add(shape);
    } catch (const ModelError& error) {
      return std::string(error.what());
    }
    return std::string();
  };
  EXPECT_EQ(refused(PointCloudShape{}), "body 0: point cloud without points, expected at least one");
  EXPECT_EQ(refused(PointCloudShape{points({}), 1}), "body 0: point cloud without points, expected at least one");
  EXPECT_EQ(refused(PointCloudShape{points({Vec3::Zero()}), -1}),
            "body 0: point cloud of radius -1, expected a finite length of at least 0");
  const std::string said = refused(PointCloudShape{points({Vec3::Zero(), Vec3(0, NAN, 0)}), 1});
  EXPECT_TRUE(said.starts_with("body 0: point cloud: point 1 is ")) << said;
}

TEST(PointCloud, IsReadFromText) {
  const test::TemporaryFolder folder;
  const auto file = folder.write("cloud.xyz", "# x y z\n1 2 3\n\n 4,5.5,-6 , 255 0 0\r\n7 8 9 # last");
  const std::vector<Vec3> read = read_points(file);
  ASSERT_EQ(read.size(), 3U);
  EXPECT_EQ(read[1], Vec3(4, 5.5, -6));
  for (const char* bad : {"", "# nothing\n", "1 2\n", "1 2 nan\n", "1 2 3\nx y z\n", "1 2 1e400\n"})
    EXPECT_THROW(read_points(folder.write("bad.xyz", bad)), LoadError) << bad;
  try {
    read_points(folder.write("bad.xyz", "1 2 3\n1 2\n"));
    FAIL();
  } catch (const LoadError& error) {
    EXPECT_NE(std::string(error.what()).find("bad.xyz:2: '1 2', expected x y z"), std::string::npos) << error.what();
  }
}

}  // namespace point_cloud_test
}  // namespace hinge::robotics
