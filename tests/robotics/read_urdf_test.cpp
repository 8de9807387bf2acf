// SPDX-License-Identifier: BSD-3-Clause
#include "hinge/robotics/read_urdf.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <string>
#include <variant>
#include <vector>

#include "hinge/core/error.hpp"
#include "robotics/robots.hpp"

namespace hinge::robotics {
namespace {

const std::string one_facet =
    "solid one\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 0\nendloop\nendfacet\n"
    "endsolid one\n";

std::string robot_of(const std::string& body) {
  return "<?xml version='1.0'?>\n<robot name='r'>\n" + body + "</robot>\n";
}

/// Links a and b on lines 3 and 4, then joint j on line 5.
std::string two_links(const std::string& type, const std::string& inside) {
  return robot_of("<link name='a'/>\n<link name='b'/>\n<joint name='j' type='" + type +
                  "'><parent link='a'/><child link='b'/>" + inside + "</joint>\n");
}

/// Link a on line 3, its collision on line 4.
std::string one_shape(const std::string& shape) {
  return robot_of("<link name='a'>\n<collision><geometry>" + shape + "</geometry></collision>\n</link>\n");
}

const std::string limit = "<limit lower='-1' upper='2' effort='1' velocity='1'/>";

std::string refusal(const std::string& urdf, const UrdfOptions& options = {}) {
  const test::TemporaryFolder folder;
  const std::filesystem::path file = folder.write("r.urdf", urdf);
  std::string what = test::refusal(folder, [&] { read_urdf(file, options); });
  EXPECT_EQ(what.find('\n'), std::string::npos) << what;
  return what;
}

RobotDescription read(const std::string& urdf, const UrdfOptions& options = {}) {
  const test::TemporaryFolder folder;
  return read_urdf(folder.write("r.urdf", urdf), options);
}

TEST(ReadUrdf, ReadsLinksAndJointsInTheOrderOfTheFile) {
  const RobotDescription robot = read(robot_of(
      "<link name='z'/><link name='y'/><link name='x'><collision><origin xyz='1 2 3'/><geometry><box size='1 2 3'/>"
      "</geometry></collision><collision><geometry><cylinder radius='2' length='5'/></geometry></collision></link>\n"
      "<joint name='second' type='prismatic'><parent link='y'/><child link='x'/><axis xyz='0 0 -2'/>" +
      limit + "</joint><joint name='first' type='continuous'><parent link='z'/><child link='y'/></joint>"));
  EXPECT_EQ(robot.name, "r");
  ASSERT_EQ(robot.links.size(), 3U);
  EXPECT_EQ(robot.links[0].name, "z");
  ASSERT_EQ(robot.links[2].geometry.size(), 2U);
  EXPECT_EQ(std::get<BoxShape>(robot.links[2].geometry[0].shape).size, Vec3(1, 2, 3));
  EXPECT_EQ(robot.links[2].geometry[0].origin.translation, Vec3(1, 2, 3));
  EXPECT_EQ(std::get<CylinderShape>(robot.links[2].geometry[1].shape).length, 5.0);
  ASSERT_EQ(robot.joints.size(), 2U);
  EXPECT_EQ(robot.joints[0].name, "second");
  EXPECT_EQ(robot.joints[0].type, JointType::prismatic);
  EXPECT_EQ(robot.joints[0].axis, Vec3(0, 0, -2));
  EXPECT_EQ(robot.joints[0].lower, -1.0);
  EXPECT_EQ(robot.joints[0].upper, 2.0);
  EXPECT_EQ(robot.joints[1].type, JointType::continuous);
  EXPECT_EQ(robot.joints[1].axis, Vec3::UnitX());
}

/// Fixed axes: roll about x first, yaw about z last; a permutation tells the order.
TEST(ReadUrdf, TurnsByRollPitchYawAboutFixedAxes) {
  const std::string quarter = "1.5707963267948966";
  const RobotDescription robot =
      read(two_links("fixed", "<origin rpy='" + quarter + " 0 " + quarter + "' xyz='0 0 1'/>"));
  const Pose& origin = robot.joints[0].origin;
  EXPECT_LT((origin * Vec3(1, 0, 0) - Vec3(0, 1, 1)).norm(), 1e-15);
  EXPECT_LT((origin * Vec3(0, 1, 0) - Vec3(0, 0, 2)).norm(), 1e-15);
  EXPECT_LT((origin * Vec3(0, 0, 1) - Vec3(1, 0, 1)).norm(), 1e-15);
}

TEST(ReadUrdf, LooksAtNothingButCollisionGeometry) {
  const RobotDescription robot = read(
      robot_of("<link name='a'><visual><geometry><mesh filename='none.dae'/></geometry><material name='?'/></visual>"
               "<inertial><mass value='heavy'/></inertial></link><transmission><joint name='t'/></transmission>"));
  EXPECT_TRUE(robot.links.at(0).geometry.empty());
  EXPECT_TRUE(robot.joints.empty());
}

TEST(ReadUrdf, NormalisesNoAxisItselfButTheModelDoes) {
  const Robot robot(read(two_links("revolute", "<axis xyz='0 3 4'/>" + limit)));
  EXPECT_LT((robot.model().tree().joint(id<LinkId>(2)).axis - Vec3(0, 0.6, 0.8)).norm(), 1e-15);
}

TEST(ReadUrdf, FindsMeshesBesideTheFileByUriAndInPackages) {
  const test::TemporaryFolder folder;
  folder.write("robot/meshes/a.stl", one_facet);
  const std::filesystem::path absolute = folder.write("packages/arm/b.stl", one_facet);
  for (const std::string& name : {std::string("meshes/a.stl"), std::string("file://meshes/a.stl"), absolute.string(),
                                  "file://" + absolute.string(), std::string("package://arm/b.stl")}) {
    const auto file = folder.write("robot/r.urdf", one_shape("<mesh filename='" + name + "' scale='1 -2 3'/>"));
    for (const char* packages : {"packages", "packages/", "packages/arm", "packages/arm/"}) {
      const RobotDescription robot = read_urdf(file, {{"/nowhere", folder.path() / packages}});
      const auto& mesh = std::get<MeshShape>(robot.links.at(0).geometry.at(0).shape);
      EXPECT_EQ(mesh.mesh->triangles.size(), 1U) << name;
      EXPECT_EQ(mesh.scale, Vec3(1, -2, 3));
    }
  }
}

TEST(ReadUrdf, ReadsAMeshUsedTwiceOnce) {
  const test::TemporaryFolder folder;
  folder.write("a.stl", one_facet);
  const std::string c = "<collision><geometry><mesh filename='a.stl'/></geometry></collision>";
  const RobotDescription robot = read_urdf(folder.write("r.urdf", robot_of("<link name='a'>" + c + c + "</link>")));
  EXPECT_EQ(std::get<MeshShape>(robot.links[0].geometry[0].shape).mesh,
            std::get<MeshShape>(robot.links[0].geometry[1].shape).mesh);
}

TEST(ReadUrdf, TakesRosPackagePathOnlyWhenAsked) {
  ASSERT_EQ(setenv("ROS_PACKAGE_PATH", "/opt/one::/opt/two", 1), 0);
  EXPECT_EQ(ros_package_path(), (std::vector<std::filesystem::path>{"/opt/one", "/opt/two"}));
  EXPECT_TRUE(UrdfOptions{}.package_folders.empty());
  unsetenv("ROS_PACKAGE_PATH");
  EXPECT_TRUE(ros_package_path().empty());
}

/// No part of URDF, but of what Bullet and Drake read; urdfdom alone would refuse it.
TEST(ReadUrdf, ReadsCapsulesBesideOtherShapes) {
  const test::TemporaryFolder folder;
  const std::string urdf = robot_of(
      "<link name='a'>\n<collision><geometry><sphere radius='2'/></geometry></collision>\n"
      "<collision><origin xyz='1 2 3'/><geometry><capsule radius='0.25' length=' 1.5 '/></geometry></collision>\n"
      "<collision><geometry><cylinder radius='3' length='4'/></geometry></collision>\n</link>\n");
  const RobotDescription robot = read_urdf(folder.write("r.urdf", urdf));
  ASSERT_EQ(robot.links.at(0).geometry.size(), 3U);
  EXPECT_EQ(std::get<SphereShape>(robot.links[0].geometry[0].shape).radius, 2.0);
  EXPECT_EQ(std::get<CapsuleShape>(robot.links[0].geometry[1].shape).radius, 0.25);
  EXPECT_EQ(std::get<CapsuleShape>(robot.links[0].geometry[1].shape).length, 1.5);
  EXPECT_EQ(robot.links[0].geometry[1].origin.translation, Vec3(1, 2, 3));
  EXPECT_EQ(std::get<CylinderShape>(robot.links[0].geometry[2].shape).radius, 3.0);
}

TEST(ReadUrdf, RefusesCapsulesThatAreNone) {
  EXPECT_EQ(refusal(one_shape("<capsule radius='0' length='1'/>")),
            "r.urdf:4: link 'a': capsule of radius 0, expected a finite length above 0");
  EXPECT_EQ(refusal(one_shape("<capsule radius='1' length='-1'/>")),
            "r.urdf:4: link 'a': capsule of length -1, expected a finite length above 0");
  EXPECT_EQ(refusal(one_shape("<capsule radius='1'/>")), "r.urdf:4: <capsule> has no attribute 'length'");
  EXPECT_EQ(refusal(one_shape("<capsule radius='1 2' length='1'/>")),
            "r.urdf:4: <capsule> has radius=\"1 2\", expected a finite number");
  EXPECT_EQ(refusal(one_shape("<capsule radius='nan' length='1'/>")),
            "r.urdf:4: <capsule> has radius=\"nan\", expected a finite number");
}

TEST(ReadUrdf, RefusesWhatIsNoUrdf) {
  EXPECT_EQ(refusal(""), "r.urdf: is no XML: XML_ERROR_EMPTY_DOCUMENT");
  EXPECT_EQ(refusal("<robot name='r'>\n<link name='a'></robot>"), "r.urdf:2: is no XML: XML_ERROR_MISMATCHED_ELEMENT");
  EXPECT_EQ(refusal("<sdf/>"), "r.urdf:1: root element is <sdf>, expected <robot>");
  EXPECT_EQ(refusal("<robot name='r'/>"), "r.urdf: the robot has no links");
  const test::TemporaryFolder folder;
  EXPECT_EQ(test::refusal(folder, [&] { read_urdf(folder.path() / "x.urdf"); }),
            "x.urdf: cannot be opened: No such file or directory");
}

TEST(ReadUrdf, SendsXacroInputToXacro) {
  EXPECT_EQ(refusal(robot_of("<link name='a'/>\n<xacro:property name='p' value='1'/>\n")),
            "r.urdf:4: <xacro:property> needs xacro: run `xacro FILE > FILE.urdf` first and read its output");
  EXPECT_EQ(refusal(two_links("fixed", "<origin xyz='${p} 0 0'/>")),
            "r.urdf:5: <origin> needs xacro: run `xacro FILE > FILE.urdf` first and read its output");
  // What xacro leaves behind is fine.
  EXPECT_EQ(refusal("<robot name='r' xmlns:xacro='http://www.ros.org/wiki/xacro'><link name='a'/></robot>"), "");
}

TEST(ReadUrdf, RefusesNamesThatAreMissingTakenOrUnknown) {
  EXPECT_EQ(refusal(robot_of("<link/>\n")), "r.urdf:3: <link> has no attribute 'name'");
  EXPECT_EQ(refusal(robot_of("<link name='a'/>\n<link name='a'/>\n")),
            "r.urdf:4: link 'a': the name is taken, see line 3");
  EXPECT_EQ(
      refusal(robot_of("<link name='b'/>\n<joint name='j' type='fixed'><parent link='a'/><child link='b'/></joint>")),
      "r.urdf:4: joint 'j': its parent link 'a' does not exist");
  EXPECT_EQ(
      refusal(robot_of("<link name='a'/>\n<joint name='j' type='fixed'><parent link='a'/><child link='b'/></joint>")),
      "r.urdf:4: joint 'j': its child link 'b' does not exist");
}

TEST(ReadUrdf, RefusesWhatIsNoTree) {
  EXPECT_EQ(refusal(robot_of("<link name='a'/>\n<joint name='j' type='fixed'><child link='a'/></joint>\n")),
            "r.urdf:4: joint 'j' has no <parent>");
  const std::string k = "<joint name='k' type='fixed'><parent link='b'/><child link='a'/></joint>\n";
  const std::string back = "<joint name='j' type='fixed'><parent link='a'/><child link='b'/></joint>\n" + k;
  EXPECT_EQ(refusal(robot_of("<link name='a'/>\n<link name='b'/>\n")),
            "r.urdf:4: link 'b': has no joint to a parent, but so has link 'a'; expected one root");
  EXPECT_EQ(refusal(robot_of("<link name='a'/>\n<link name='b'/>\n" + back)),
            "r.urdf:3: link 'a': its joints lead in a circle, expected a tree");
  // urdfdom passes over a circle beside the tree.
  EXPECT_EQ(refusal(robot_of("<link name='c'/>\n<link name='a'/>\n<link name='b'/>\n" + back)),
            "r.urdf:5: link 'b': its joints lead in a circle, expected a tree");
  EXPECT_EQ(
      refusal(robot_of("<link name='a'/>\n<link name='b'/>\n<joint name='j' type='fixed'><parent link='a'/>"
                       "<child link='b'/></joint>\n<joint name='k' type='fixed'><parent link='a'/><child link='b'/>"
                       "</joint>\n")),
      "r.urdf:6: joint 'k': its child link 'b' is the child of joint 'j' already");
}

TEST(ReadUrdf, RefusesJointsItCannotMove) {
  EXPECT_EQ(refusal(two_links("floating", "")),
            "r.urdf:5: joint 'j' is floating, expected fixed, revolute, continuous or prismatic");
  EXPECT_EQ(refusal(two_links("planar", "")),
            "r.urdf:5: joint 'j' is planar or of unknown type, expected fixed, revolute, continuous or prismatic");
  EXPECT_NE(refusal(two_links("ball", "")).find("r.urdf:5: Joint [j] has no known type [ball]"), std::string::npos);
  EXPECT_EQ(refusal(two_links("continuous", "<axis xyz='0 0 0'/>")),
            "r.urdf:5: joint 'j': its axis is 0 0 0, expected a finite direction other than 0 0 0");
}

TEST(ReadUrdf, RefusesNumbersThatAreNone) {
  EXPECT_EQ(refusal(two_links("fixed", "<origin xyz='0 nan 0'/>")),
            "r.urdf:5: <origin> has xyz=\"0 nan 0\", expected three finite numbers");
  EXPECT_EQ(refusal(two_links("fixed", "<origin rpy='0 0'/>")),
            "r.urdf:5: <origin> has rpy=\"0 0\", expected three finite numbers");
  for (const char* value : {"nan", "-1e400", "0.5abc", "1,5", "inf"})
    EXPECT_EQ(
        refusal(two_links("revolute", std::string("<limit lower='") + value + "' upper='1' effort='1' velocity='1'/>")),
        std::string("r.urdf:5: lower value (") + value +
            ") is not a valid float; Could not parse limit element for joint [j]");
  EXPECT_EQ(refusal(two_links("revolute", "<limit lower='2' upper='1' effort='1' velocity='1'/>")),
            "r.urdf:5: joint 'j': its lower limit 2 is above its upper limit 1");
  EXPECT_NE(refusal(two_links("revolute", "")).find("does not specify limits"), std::string::npos);
}

/// urdfdom leaves most of these out and goes on.
TEST(ReadUrdf, RefusesShapesThatAreNone) {
  EXPECT_EQ(refusal(one_shape("<box size='1 1'/>")),
            "r.urdf:3: Parser found 2 elements but 3 expected while parsing vector [1 1]; Could not parse collision "
            "element for Link [a]");
  EXPECT_EQ(refusal(one_shape("<box size='1 -1 1'/>")),
            "r.urdf:4: link 'a': box of size 1 -1 1, expected finite lengths above 0");
  EXPECT_EQ(refusal(one_shape("<sphere radius='0'/>")),
            "r.urdf:4: link 'a': sphere of radius 0, expected a finite length above 0");
  EXPECT_NE(refusal(one_shape("<sphere radius='nan'/>")).find("r.urdf:3: radius [nan] is not a valid float"),
            std::string::npos);
  EXPECT_NE(refusal(one_shape("<cone radius='1' length='2'/>")).find("r.urdf:3: Unknown geometry type 'cone'"),
            std::string::npos);
  EXPECT_EQ(refusal(one_shape("<box size='1 1 1'/><sphere radius='1'/>")),
            "r.urdf:4: link 'a': a <geometry> of several shapes, expected one");
  EXPECT_NE(refusal(robot_of("<link name='a'>\n<collision/>\n</link>\n")), "");
}

TEST(ReadUrdf, RefusesMeshesThatAreMissingOrBad) {
  const auto with_mesh = [](const std::string& attributes) { return one_shape("<mesh " + attributes + "/>"); };
  EXPECT_EQ(refusal(with_mesh("filename='no.stl'")), "r.urdf:4: link 'a': mesh 'no.stl': there is no file no.stl");
  EXPECT_EQ(refusal(with_mesh("filename='package://arm/a.stl'")),
            "r.urdf:4: link 'a': mesh 'package://arm/a.stl': not found in any package folder, none was given");
  EXPECT_EQ(refusal(with_mesh("filename='package://arm/a.stl'"), {{"/one", "/two"}}),
            "r.urdf:4: link 'a': mesh 'package://arm/a.stl': not found in the package folders /one, /two");
  EXPECT_EQ(refusal(with_mesh("filename='model://arm/a.stl'")),
            "r.urdf:4: link 'a': mesh 'model://arm/a.stl': expected a path, file:// or package://");
  EXPECT_NE(refusal(with_mesh("filename=''")).find("r.urdf:4: link 'a': mesh '': expected a path"), std::string::npos);
  EXPECT_NE(refusal(with_mesh("")).find("Mesh must contain a filename attribute"), std::string::npos);

  const test::TemporaryFolder folder;
  folder.write("a.stl", one_facet);
  const auto file = folder.write("r.urdf", with_mesh("filename='a.stl' scale='1 0 1'"));
  EXPECT_EQ(test::refusal(folder, [&] { read_urdf(file); }),
            "r.urdf:4: link 'a': mesh 'a.stl': scale 1 0 1, expected finite factors other than 0");
  folder.write("a.stl", one_facet.substr(0, 80));
  EXPECT_EQ(
      test::refusal(folder, [&] { read_urdf(file); }),
      "r.urdf:4: link 'a': a.stl: text STL with 1 facets, 0 of them ended, and no endsolid: cut short or damaged");
}

TEST(ReadUrdf, RefusesMimicsOfNothing) {
  EXPECT_EQ(refusal(two_links("continuous", "<mimic joint='ghost'/>")),
            "r.urdf:5: joint 'j': mimics joint 'ghost', which does not exist");
  EXPECT_EQ(refusal(two_links("continuous", "<mimic joint='j'/>")),
            "r.urdf:5: joint 'j': mimics joint 'j', which leads back to it");
  EXPECT_NE(
      refusal(two_links("continuous", "<mimic joint='j' multiplier='x'/>")).find("r.urdf:5: multiplier value (x)"),
      std::string::npos);
}

}  // namespace
}  // namespace hinge::robotics
