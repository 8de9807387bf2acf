// SPDX-License-Identifier: BSD-3-Clause
// Tests reading of URDF files: geometry, joints, packages, notes, rejected input.
#include "hinge/robotics/read_urdf.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "hinge/core/error.hpp"
#include "robotics/robots.hpp"

namespace hinge::robotics {
namespace read_urdf_test {

const std::string one_facet =
    "solid one\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 0\nendloop\nendfacet\n"
    "endsolid one\n";

std::string robot_of(const std::string& body) {
  return "<?xml version='1.0'?>\n<robot name='r'>\n" + body + "</robot>\n";
}

/// Links a and b on lines 3 and 4, joint j on line 5.
std::string two_links(const std::string& type, const std::string& inside) {
  return robot_of("<link name='a'/>\n<link name='b'/>\n<joint name='j' type='" + type +
                  "'><parent link='a'/><child link='b'/>" + inside + "</joint>\n");
}

/// Link a on line 3, its collision element on line 4.
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

TEST(ReadUrdf, ReadsTextInMemoryAsTheFile) {
  const test::TemporaryFolder folder;
  const std::string text = one_shape("<mesh filename='none.stl'/>");
  const std::filesystem::path file = folder.write("r.urdf", text), other = folder.path() / "other.urdf";
  const std::string of_file = test::refusal(folder, [&] { read_urdf(file); });
  const std::string of_text = test::refusal(folder, [&] { parse_urdf(text, other); });
  EXPECT_EQ(of_text, "other" + of_file.substr(1));
  EXPECT_EQ(parse_urdf(one_shape("<box size='1 2 3'/>"), other).links.size(), 1U);
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

/// The axes are fixed: roll about x is applied first, yaw about z last. The result permutes the axes, which shows the
/// order.
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
  ASSERT_EQ(setenv("AMENT_PREFIX_PATH", "/opt/ros/humble:/ws", 1), 0);
  EXPECT_EQ(ros_package_path(),
            (std::vector<std::filesystem::path>{"/opt/one", "/opt/two", "/opt/ros/humble/share", "/ws/share"}));
  unsetenv("AMENT_PREFIX_PATH");
  unsetenv("ROS_PACKAGE_PATH");
  EXPECT_TRUE(ros_package_path().empty());
}

/// Capsules are not part of URDF, but Bullet and Drake read them; urdfdom alone would reject them.
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
  EXPECT_EQ(refusal(one_shape("<capsule radius='-1' length='1'/>")),
            "r.urdf:4: link 'a': capsule of radius -1, expected a finite length of at least 0");
  EXPECT_EQ(refusal(one_shape("<capsule radius='1' length='-1'/>")),
            "r.urdf:4: link 'a': capsule of length -1, expected a finite length of at least 0");
  EXPECT_EQ(refusal(one_shape("<capsule radius='1'/>")), "r.urdf:4: <capsule> has no attribute 'length'");
  EXPECT_EQ(refusal(one_shape("<capsule radius='1 2' length='1'/>")),
            "r.urdf:4: <capsule> has radius=\"1 2\", expected a finite number");
  EXPECT_EQ(refusal(one_shape("<capsule radius='nan' length='1'/>")),
            "r.urdf:4: <capsule> has radius=\"nan\", expected a finite number");
}

TEST(ReadUrdf, RefusesWhatIsNoUrdf) {
  EXPECT_EQ(refusal(""), "r.urdf: is empty, expected XML with root element <robot>");
  EXPECT_EQ(refusal("<robot name='r'>\n<link name='a'></robot>"), "r.urdf:2: is not XML: XML_ERROR_MISMATCHED_ELEMENT");
  EXPECT_EQ(refusal("<sdf/>"), "r.urdf:1: root element is <sdf>, expected <robot>");
  EXPECT_EQ(refusal("<robot name='r'/>"), "r.urdf: the robot has no links");
  const test::TemporaryFolder folder;
  EXPECT_EQ(test::refusal(folder, [&] { read_urdf(folder.path() / "x.urdf"); }),
            "x.urdf: cannot be opened: No such file or directory");
}

TEST(ReadUrdf, SendsXacroInputToXacro) {
  for (const char* element : {"<xacro:include filename='arm.xacro'/>", "<xacro:macro name='arm'/>",
                              "<xacro:arm><link name='b'/></xacro:arm>"})
    EXPECT_NE(refusal(robot_of("<link name='a'/>\n" + std::string(element))).find("> needs xacro: run `xacro"),
              std::string::npos)
        << element;
  // An unexpanded macro where geometry belongs may hide geometry, so it is an error.
  EXPECT_EQ(refusal(robot_of("<link name='a'>\n<xacro:foot/></link>\n")),
            "r.urdf:4: <xacro:foot> needs xacro: run `xacro FILE > FILE.urdf` first and read its output");
  EXPECT_NE(refusal(one_shape("<xacro:foot/>")).find("needs xacro"), std::string::npos);
  EXPECT_EQ(refusal(two_links("fixed", "<origin xyz='${p} 0 0'/>")),
            "r.urdf:5: <origin> needs xacro: run `xacro FILE > FILE.urdf` first and read its output");
  // The namespace declaration that xacro leaves in its output is accepted.
  EXPECT_EQ(refusal("<robot name='r' xmlns:xacro='http://www.ros.org/wiki/xacro'><link name='a'/></robot>"), "");
}

TEST(ReadUrdf, RefusesNamesThatAreMissingTakenOrUnknown) {
  EXPECT_EQ(refusal(robot_of("<link/>\n")), "r.urdf:3: <link> has no attribute 'name'");
  EXPECT_EQ(refusal(robot_of("<link name='a'/>\n<link name='a'/>\n")),
            "r.urdf:4: link 'a': the name is already used in line 3");
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
            "r.urdf:4: links 'a' and 'b' both have no parent; expected one root");
  EXPECT_EQ(refusal(robot_of("<link name='a'/>\n<link name='b'/>\n" + back)),
            "r.urdf:3: link 'a': its joints form a cycle, expected a tree");
  // urdfdom ignores a cycle that is not connected to the tree.
  EXPECT_EQ(refusal(robot_of("<link name='c'/>\n<link name='a'/>\n<link name='b'/>\n" + back)),
            "r.urdf:5: link 'b': its joints form a cycle, expected a tree");
  EXPECT_EQ(
      refusal(robot_of("<link name='a'/>\n<link name='b'/>\n<joint name='j' type='fixed'><parent link='a'/>"
                       "<child link='b'/></joint>\n<joint name='k' type='fixed'><parent link='a'/><child link='b'/>"
                       "</joint>\n")),
      "r.urdf:6: joint 'k': its child link 'b' is already the child of joint 'j'");
}

TEST(ReadUrdf, RefusesJointsItCannotMove) {
  for (const std::string type : {"floating", "planar"})
    EXPECT_EQ(refusal(robot_of("<link name='a'><collision><geometry><sphere radius='1'/></geometry></collision></link>"
                               "<link name='b'/>\n<joint name='j' type='" +
                               type + "'><parent link='a'/><child link='b'/></joint>\n")),
              "r.urdf:4: joint 'j' is " + type +
                  ", expected fixed, revolute, continuous or prismatic (or a joint above all geometry)");
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

/// urdfdom silently drops most of these.
TEST(ReadUrdf, RefusesShapesThatAreNone) {
  EXPECT_EQ(refusal(one_shape("<box size='1 1'/>")),
            "r.urdf:3: Parser found 2 elements but 3 expected while parsing vector [1 1]; Could not parse collision "
            "element for Link [a]");
  EXPECT_EQ(refusal(one_shape("<box size='1 -1 1'/>")),
            "r.urdf:4: link 'a': box of size 1 -1 1, expected finite lengths of at least 0");
  EXPECT_EQ(refusal(one_shape("<sphere radius='-1'/>")),
            "r.urdf:4: link 'a': sphere of radius -1, expected a finite length of at least 0");
  EXPECT_NE(refusal(one_shape("<sphere radius='nan'/>")).find("r.urdf:3: radius [nan] is not a valid float"),
            std::string::npos);
  // Sizes that overflow are rejected when reading, not later when they are tessellated.
  EXPECT_EQ(refusal(one_shape("<box size='1 1 1e308'/>")),
            "r.urdf:4: link 'a': box of size 1 1 1e+308, expected lengths of at most 2^1000");
  EXPECT_EQ(refusal(one_shape("<cylinder radius='1e302' length='1'/>")),
            "r.urdf:4: link 'a': cylinder of radius 1e+302, expected a finite length of at most 2^1000");
  for (const std::string shape : {"plane", "cdf", "cone"})
    EXPECT_EQ(refusal(one_shape("<" + shape + " normal='0 0 1'/>")),
              "r.urdf:4: link 'a': shape <" + shape +
                  ">, expected <box>, <sphere>, <cylinder>, <capsule> or <mesh>; --missing-meshes skip leaves "
                  "it out");
  EXPECT_NE(refusal(one_shape("<mesh filename='a.stl' scale='1 1 1 1'/>")).find("found 4 elements but 3 expected"),
            std::string::npos);
  EXPECT_NE(refusal(robot_of("<link name='a'>\n<collision/>\n</link>\n")), "");
}

TEST(ReadUrdf, RefusesMeshesThatAreMissingOrBad) {
  const auto with_mesh = [](const std::string& attributes) { return one_shape("<mesh " + attributes + "/>"); };
  EXPECT_EQ(refusal(with_mesh("filename='no.stl'")),
            "r.urdf:4: link 'a': mesh 'no.stl': there is no file no.stl; --missing-meshes skip leaves it out");
  EXPECT_EQ(refusal(with_mesh("filename='package://arm/a.stl'")),
            "r.urdf:4: link 'a': mesh 'package://arm/a.stl': not found near the URDF file, and no package folder is "
            "given; give the folder that holds package 'arm' with --package-path; --missing-meshes skip leaves it out");
  EXPECT_EQ(refusal(with_mesh("filename='package://arm/a.stl'"), {{"/one", "/two"}}),
            "r.urdf:4: link 'a': mesh 'package://arm/a.stl': not found near the URDF file or in the package "
            "folders /one, /two; give the folder that holds package 'arm' with --package-path; --missing-meshes skip "
            "leaves it out");
  EXPECT_EQ(refusal(with_mesh("filename='model://arm/a.stl'")),
            "r.urdf:4: link 'a': mesh 'model://arm/a.stl': expected a path, file:// or package://");
  for (const std::string name : {"a.wrl", "a.vtk"}) {
    const test::TemporaryFolder other;
    other.write(name, "#VRML");
    const auto urdf = other.write("r.urdf", with_mesh("filename='" + name + "'"));
    EXPECT_EQ(test::refusal(other, [&] { read_urdf(urdf); }),
              "r.urdf:4: link 'a': " + name + ": the mesh format is '" + name.substr(1) +
                  "', expected .stl, .obj, .dae or .ply; --missing-meshes skip leaves it out");
  }
  EXPECT_NE(refusal(with_mesh("filename=''")).find("r.urdf:4: link 'a': mesh '': expected a path"), std::string::npos);
  EXPECT_NE(refusal(with_mesh("")).find("Mesh must contain a filename attribute"), std::string::npos);

  const test::TemporaryFolder folder;
  folder.write("a.stl", one_facet);
  const auto file = folder.write("r.urdf", with_mesh("filename='a.stl' scale='1 0 1'"));
  EXPECT_EQ(test::refusal(folder, [&] { read_urdf(file); }),
            "r.urdf:4: link 'a': mesh 'a.stl': scale 1 0 1, expected finite factors other than 0");
  EXPECT_EQ(test::refusal(
                folder, [&] { read_urdf(folder.write("far.urdf", with_mesh("filename='a.stl' scale='1 1e307 1'"))); }),
            "far.urdf:4: link 'a': mesh 'a.stl': scale 1 1e+307 1 moves a vertex of triangle 0 beyond 2^1000");
  folder.write("a.stl", one_facet.substr(0, 80));
  EXPECT_EQ(test::refusal(folder, [&] { read_urdf(file); }),
            "r.urdf:4: link 'a': a.stl: text STL with 1 facets, of which 0 have an endfacet, and no endsolid: the file "
            "is cut short or damaged");
}

/// Returns the parsed file; notes are without the folder's path.
RobotDescription read_in(const test::TemporaryFolder& folder, const std::string& urdf,
                         const UrdfOptions& options = {}) {
  RobotDescription robot = read_urdf(folder.write("r.urdf", urdf), options);
  const std::string prefix = folder.path().string() + "/";
  for (std::string& note : robot.notes)
    for (std::size_t at = note.find(prefix); at != std::string::npos; at = note.find(prefix))
      note.erase(at, prefix.size());
  return robot;
}

std::vector<std::string> notes_of(const std::string& urdf) {
  const test::TemporaryFolder folder;
  return read_in(folder, urdf).notes;
}

using Notes = std::vector<std::string>;

TEST(ReadUrdfNotes, TakesSizesOfZeroOncePerLink) {
  for (const auto& [shape, what] : std::vector<std::pair<std::string, std::string>>{
           {"<sphere radius='0'/>", "sphere of radius 0"},
           {"<sphere radius='-0.0'/>", "sphere of radius 0"},
           {"<box size='0 0 0'/>", "box of size 0 0 0"},
           {"<box size='0.5 0 0.25'/>", "box of size 0.5 0 0.25"},
           {"<cylinder radius='0' length='1'/>", "cylinder of radius 0 and length 1"},
           {"<cylinder radius='0.5' length='0'/>", "cylinder of radius 0.5 and length 0"},
           {"<capsule radius='0' length='1'/>", "capsule of radius 0"}})
    EXPECT_EQ(notes_of(one_shape(shape)),
              (Notes{"r.urdf:4: link 'a': 1 of 1 <collision> have no volume and are treated as "
                     "point, segment or flat solid: " +
                     what}));
  EXPECT_TRUE(notes_of(one_shape("<capsule radius='1' length='0'/>")).empty());  // a sphere
  const std::string point = "<collision><geometry><sphere radius='0'/></geometry></collision>\n";
  EXPECT_EQ(notes_of(robot_of("<link name='foot'>\n" + point + point + point + "</link>\n")).size(), 1U);
}

/// urdfdom ignores these elements too.
TEST(ReadUrdfNotes, PassesOverXacroThatCarriesNoGeometry) {
  const std::string sensors = "<link name='a'/>\n<xacro:imu port='1'/>\n";
  EXPECT_EQ(notes_of(robot_of(sensors)), (Notes{"r.urdf:4: <xacro:imu> is left out, it was not expanded by xacro"}));
  EXPECT_EQ(notes_of(robot_of("<xacro:property name='p' value='1'/>\n<link name='a'/>\n")).size(), 1U);
  // Visuals, inertias and extensions are not read.
  EXPECT_TRUE(notes_of(robot_of("<link name='a'><visual><xacro:grey/><origin xyz='${x}'/></visual></link>"
                                "<gazebo><xacro:if value='$(arg x)'/></gazebo>\n"))
                  .empty());
}

TEST(ReadUrdfNotes, FixesAFloatingBase) {
  for (const std::string type : {"floating", "planar"}) {
    const test::TemporaryFolder folder;
    const RobotDescription robot = read_in(
        folder, robot_of("<link name='world'/>\n<link name='a'><collision><geometry><sphere radius='1'/></geometry>"
                         "</collision></link>\n<joint name='j' type='" +
                         type + "'><parent link='world'/><child link='a'/><origin xyz='1 2 3'/></joint>\n"));
    EXPECT_EQ(robot.joints.at(0).type, JointType::fixed);
    EXPECT_EQ(robot.joints[0].origin.translation, Vec3(1, 2, 3));
    EXPECT_EQ(robot.floating_base, "j");
    EXPECT_EQ(robot.notes,
              (Notes{"r.urdf:5: joint 'j' is " + type + " and carries all geometry, so it is treated as fixed"}));
  }
}

TEST(ReadUrdfNotes, TakesJointsWithoutLimitsForContinuous) {
  const test::TemporaryFolder folder;
  const RobotDescription robot =
      read_in(folder, two_links("revolute", "<limit lower='-1.79769e+308' upper='1.79769e+308' effort='1'/>"));
  EXPECT_EQ(robot.joints.at(0).type, JointType::continuous);
  EXPECT_EQ(robot.notes, (Notes{"r.urdf:5: joint 'j' has limits of 1e15 rad or more, so it is treated as continuous"}));
  EXPECT_EQ(Robot(robot).upper()[0], 3.141592653589793);
}

TEST(ReadUrdfNotes, TakesTheFirstOfSeveralShapes) {
  const test::TemporaryFolder folder;
  const RobotDescription robot = read_in(folder, one_shape("<box size='1 1 1'/><sphere radius='1'/>"));
  ASSERT_EQ(robot.links.at(0).geometry.size(), 1U);
  EXPECT_TRUE(std::holds_alternative<BoxShape>(robot.links[0].geometry[0].shape));
  EXPECT_EQ(robot.notes,
            (Notes{"r.urdf:4: link 'a': a <geometry> has several shapes, only the first, <box>, is read"}));
}

TEST(ReadUrdfNotes, CallsANamelessRobotByItsFile) {
  const test::TemporaryFolder folder;
  const RobotDescription robot = read_in(folder, "<robot version='2.0'><link name='a'/></robot>");
  EXPECT_EQ(robot.name, "r");
  EXPECT_EQ(robot.notes, (Notes{"r.urdf: the robot has no name, it is named after its file: 'r'"}));
}

// urdfdom rejects or drops some of these, but none of them can change a verdict.
TEST(ReadUrdf, TakesWhatChangesNoVerdict) {
  const auto expect_silence = [](const std::string& urdf) { EXPECT_TRUE(notes_of(urdf).empty()) << urdf; };
  expect_silence(two_links("prismatic", "<limit lower=' -1' upper='2 '/>"));  // no effort, no velocity
  expect_silence(two_links("revolute", "<limit lower='0' upper='1' effort='much' velocity='inf'/>"));
  expect_silence(two_links("continuous", "<limit lower='nan' upper='x'/>"));
  expect_silence(two_links("fixed", "<axis xyz='0'/><limit/><mimic joint='?'/>"));
  expect_silence(two_links("continuous", "<dynamics/><safety_controller/><calibration rising='x'/>"));
  expect_silence(
      robot_of("<material name='m'/><material name='m'/><link name='a'><visual><material name='m'><color "
               "rgba='1 1'/></material></visual></link>\n"));
  const std::string turning = "<link name='c'/><joint name='k' type='continuous'><parent link='b'/><child link='c'/>";
  expect_silence(two_links("revolute", "<mimic joint='k' multiplier=' 2 '/>")
                     .insert(std::string("<?xml version='1.0'?>\n<robot name='r'>\n").size(), turning + "</joint>"));
  expect_silence(one_shape("<box size=' 1\t2\n3 '/>"));
  expect_silence(one_shape("<sphere radius=' 1e-1 '/>"));
  expect_silence("<!-- above -->\n" + one_shape("<sphere radius='1'/>"));
  expect_silence(
      "\xEF\xBB\xBF<?xml version='1.0' encoding='UTF-8'?>\r\n<robot name='r'>\r\n<link name='a'/>\r\n</robot>");
}

/// Link a has meshes that are missing, empty or in an unknown format, and an unknown shape. Link b has no defects.
TEST(ReadUrdf, SkipsMissingMeshesWhenAsked) {
  const test::TemporaryFolder folder;
  folder.write("empty.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\n");
  folder.write("a.wrl", "#VRML");
  const auto collision = [](const std::string& shape) {
    return "<collision><geometry>" + shape + "</geometry></collision>\n";
  };
  const std::string urdf = robot_of(
      "<link name='a'>\n" + collision("<mesh filename='gone.stl'/>") + collision("<mesh filename='empty.obj'/>") +
      collision("<mesh filename='a.wrl'/>") + collision("<plane/>") + collision("<box size='1 1 1'/>") +
      "</link>\n<link name='b'>" + collision("<sphere radius='1'/>") +
      "</link><joint name='j' type='fixed'><parent link='a'/><child link='b'/></joint>\n");
  UrdfOptions skip;
  skip.skip_missing_meshes = true;
  const RobotDescription robot = read_in(folder, urdf, skip);
  EXPECT_EQ(robot.incomplete, (std::vector<std::string>{"a"}));
  EXPECT_EQ(robot.links.at(0).geometry.size(), 1U);
  EXPECT_EQ(robot.notes, (Notes{"r.urdf:4: link 'a': 4 of 5 <collision> left out: mesh 'gone.stl': there is no file "
                                "gone.stl"}));
  // A damaged mesh is an error, even when missing meshes are skipped.
  folder.write("empty.obj", "v 0 0 0\nv 1 0 0\nv 0 nan 0\nf 1 2 3\n");
  EXPECT_NE(test::refusal(folder, [&] { read_in(folder, urdf, skip); }), "");
}

TEST(ReadUrdf, FindsPackagesAroundTheFile) {
  const test::TemporaryFolder folder;
  folder.write("src/arm_description/package.xml", "<?xml version='1.0'?><package><name>arm</name></package>");
  folder.write("src/arm_description/meshes/a.stl", one_facet);
  folder.write("src/hand/package.xml", "<package/>");
  folder.write("src/hand/b.stl", one_facet);
  for (const std::string name : {"package://arm/meshes/a.stl", "package:///arm/meshes/a.stl", "package://hand/b.stl",
                                 "package://arm_description/meshes/a.stl"}) {
    const auto file = folder.write("src/arm_description/urdf/r.urdf", one_shape("<mesh filename='" + name + "'/>"));
    EXPECT_EQ(test::refusal(folder, [&] { read_urdf(file); }), "") << name;
  }
}

TEST(ReadUrdf, RefusesMimicsOfNothing) {
  EXPECT_EQ(refusal(two_links("continuous", "<mimic joint='ghost'/>")),
            "r.urdf:5: joint 'j': mimics joint 'ghost', which does not exist");
  EXPECT_EQ(refusal(two_links("continuous", "<mimic joint='j'/>")),
            "r.urdf:5: joint 'j': mimics joint 'j', which depends on this joint in turn");
  EXPECT_NE(
      refusal(two_links("continuous", "<mimic joint='j' multiplier='x'/>")).find("r.urdf:5: multiplier value (x)"),
      std::string::npos);
}

}  // namespace read_urdf_test
}  // namespace hinge::robotics
