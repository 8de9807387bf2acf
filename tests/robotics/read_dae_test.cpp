// SPDX-License-Identifier: BSD-3-Clause
// Tests the transforms, the primitives and the references of COLLADA files.
#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "robotics/mesh_files.hpp"

namespace hinge::robotics {
namespace read_dae_test {

std::string replaced(std::string text, const std::string& from, const std::string& to) {
  const std::size_t at = text.find(from);
  EXPECT_NE(at, std::string::npos) << from;
  return text.replace(at, from.size(), to);
}

/// Returns the file with other transforms of its scaled node, whose child is translated by (10 20 30).
std::string with_transforms(const std::string& transforms) {
  return replaced(test::collada("", "Z_UP"), "<scale>2 2 2</scale>", transforms);
}

/// Returns where the node puts the corner (0 1 2) of its mesh, at (10 21 32) in the node.
Vec3 corner_after(const std::string& transforms) {
  return test::read_mesh_from("a.dae", with_transforms(transforms)).triangles.at(1).c;
}

std::string refusal(const std::string& text) { return test::mesh_refusal("a.dae", text); }

TEST(ReadDae, AppliesEveryTransform) {
  EXPECT_EQ(corner_after(""), Vec3(10, 21, 32));
  EXPECT_EQ(corner_after("<translate>\n0.1 0 -1e0\n</translate>"), Vec3(10.1, 21, 31));
  EXPECT_EQ(corner_after("<scale>1 -1 0.5</scale>"), Vec3(10, -21, 16));
  EXPECT_EQ(corner_after("<matrix>0 0 1 5 1 0 0 6 0 1 0 7 0 0 0 1</matrix>"), Vec3(37, 16, 28));
  const auto expect_near = [](const Vec3& a, const Vec3& b) { EXPECT_LE((a - b).norm(), 1e-14 * b.norm()); };
  expect_near(corner_after("<rotate>0 0 1 90</rotate>"), {-21, 10, 32});
  expect_near(corner_after("<rotate>0 0 -3 90</rotate>"), {21, -10, 32});  // an axis of another length
  expect_near(corner_after("<rotate>1 1 1 120</rotate>"), {32, 10, 21});
  EXPECT_EQ(corner_after("<rotate>0 0 0 0</rotate>"), Vec3(10, 21, 32));
  // The first transform is the outermost.
  expect_near(corner_after("<translate>1 0 0</translate><rotate>0 0 1 90</rotate><scale>2 2 2</scale>"), {-41, 20, 64});
  // The observer at (1 2 3) looks along -x, z is up: its x is y, its y is z, its z is x.
  expect_near(corner_after("<lookat>1 2 3 0 2 3 0 0 5</lookat>"), {33, 12, 24});
}

TEST(ReadDae, RotatesAsFarAsTheAngleSays) {
  const double third = std::acos(-1.0) / 3;
  const Vec3 turned = corner_after("<rotate>0 1 0 60</rotate>");
  EXPECT_NEAR(turned[0], 10 * std::cos(third) + 32 * std::sin(third), 1e-14);
  EXPECT_NEAR(turned[2], 32 * std::cos(third) - 10 * std::sin(third), 1e-14);
  EXPECT_EQ(turned[1], 21.0);
}

TEST(ReadDae, RefusesTransformsThatItCannotApply) {
  const auto refused = [](const std::string& transform) { return refusal(with_transforms(transform)); };
  EXPECT_EQ(refused("<translate>1 2</translate>"), "a.dae:1: <translate> holds 2 numbers, expected 3");
  EXPECT_EQ(refused("<scale>1 2 x</scale>"), "a.dae:1: <scale> holds 'x', expected numbers");
  EXPECT_EQ(refused("<matrix>1 0 0 0 0 1 0 0 0 0 1 0 0 0 0 2</matrix>"),
            "a.dae:1: <matrix> has a last row other than 0 0 0 1");
  EXPECT_EQ(refused("<rotate>0 0 0 90</rotate>"),
            "a.dae:1: <rotate> has the axis 0 0 0 and the angle 90, expected a direction and a finite angle");
  EXPECT_EQ(refused("<rotate>0 0 1 inf</rotate>"),
            "a.dae:1: <rotate> has the axis 0 0 1 and the angle inf, expected a direction and a finite angle");
  EXPECT_EQ(refused("<lookat>0 0 0 0 0 1 0 0 2</lookat>"), "a.dae:1: <lookat> gives no direction");
  EXPECT_EQ(refused("<skew>10 0 0 1 1 0 0</skew>"), "a.dae:1: <skew> is not supported, expected <matrix>");
  EXPECT_EQ(refused("<scale>1 1 nan</scale>"),
            "a.dae: face 1 (from 0): vertex 0 is nan nan nan, expected finite coordinates");
  for (const char* meter : {"0", "-1", "x", "inf", "0,01"})
    EXPECT_EQ(refusal(test::collada(std::string("<unit meter='") + meter + "'/>", "Z_UP")),
              std::string("a.dae:1: <unit> has meter=\"") + meter + "\", expected a number above 0");
  EXPECT_EQ(refusal(test::collada("<unit name='metre'/>", "Z_UP")), "");
}

/// Returns the triangles of the first instance, with other primitives over four corners of a square.
std::vector<Triangle> square(const std::string& primitives) {
  std::string text = replaced(test::collada("", "Z_UP"), "0 0 0 1 0 0 0 1 2", "0 0 0 1 0 0 1 1 0 0 1 0");
  text = replaced(replaced(text, "count='9'", "count='12'"), "count='3'", "count='4'");
  const std::size_t from = text.find("<triangles"), to = text.find("</mesh>");
  std::vector<Triangle> all = test::read_mesh_from("a.dae", text.replace(from, to - from, primitives)).triangles;
  all.resize(all.size() / 2);
  return all;
}

/// All triangles face +z, and cover the square once.
TEST(ReadDae, ReadsEveryKindOfPrimitive) {
  const std::string input = "<input semantic='VERTEX' source='#v' offset='1'/><input semantic='NORMAL' offset='0'/>";
  for (const auto& [primitives, count] : std::vector<std::pair<std::string, std::size_t>>{
           {"<triangles count='2'>" + input + "<p>9 0 9 1 9 2 9 0 9 2 9 3</p></triangles>", 2},
           {"<triangles count='1'>" + input + "<p>9 0 9 1 9 2</p></triangles><triangles count='1'>" + input +
                "<p>9 0 9 2 9 3</p></triangles>",
            2},
           {"<polygons count='2'>" + input + "<p>9 0 9 1 9 2</p><p>9 0 9 2 9 3</p></polygons>", 2},
           {"<polygons count='1'>" + input + "<p>9 0 9 1 9 2 9 3</p><extra><technique/></extra></polygons>", 2},
           {"<polylist count='2'>" + input + "<vcount>3 3</vcount><p>9 0 9 1 9 2 9 0 9 2 9 3</p></polylist>", 2},
           {"<trifans count='1'>" + input + "<p>9 0 9 1 9 2 9 3</p></trifans>", 2},
           {"<tristrips count='1'>" + input + "<p>9 0 9 1 9 3 9 2</p></tristrips>", 2}}) {
    SCOPED_TRACE(primitives);
    const std::vector<Triangle> triangles = square(primitives);
    EXPECT_EQ(triangles.size(), count);
    EXPECT_EQ(test::area(triangles), 1.0);
    for (const Triangle& t : triangles) EXPECT_EQ(cross(Vec3(t.b - t.a), Vec3(t.c - t.a)), Vec3(0, 0, 1));
  }
}

TEST(ReadDae, FindsIdsThatEveryMeshUses) {
  const std::string file = test::collada("", "Z_UP");
  const std::size_t from = file.find("<geometry"), to = file.find("</library_geometries>");
  const std::string copy = replaced(file.substr(from, to - from), "id='g'", "id='h'");
  EXPECT_EQ(refusal(std::string(file).insert(to, copy)), "");
  EXPECT_EQ(refusal(std::string(file).insert(to, file.substr(from, to - from))),
            "a.dae:1: <instance_geometry> has url=\"#g\", expected one <geometry>, but several have this id");
  // Nothing shows this geometry.
  EXPECT_EQ(refusal(std::string(file).insert(to,
                                             "<geometry id='h'><mesh><vertices><input/></vertices></mesh>"
                                             "</geometry><geometry id='i'><brep/></geometry>")),
            "");
  EXPECT_EQ(refusal(replaced(file, "<mesh>", "<brep/><mesh>")), "a.dae:1: <brep> is not supported, expected <mesh>");
}

TEST(ReadDae, BoundsInstancesOfInstances) {
  const std::string file = test::collada("", "Z_UP");
  const auto with_nodes = [&](const std::string& nodes) {
    return refusal(replaced(file, "<library_visual_scenes>",
                            "<library_nodes>" + nodes + "</library_nodes><library_visual_scenes>"));
  };
  EXPECT_EQ(refusal(replaced(file, "<scale>", "<instance_node url='#m'/><scale>")),
            "a.dae:1: <node>: its nodes contain themselves or are nested more than 500 levels deep");
  std::string nodes = "<node id='n0'><instance_geometry url='#g'/></node>";
  for (int k = 1; k <= 25; ++k) {
    const std::string below = "<instance_node url='#n" + std::to_string(k - 1) + "'/>";
    nodes += "<node id='n" + std::to_string(k) + "'>" + below + below + "</node>";
  }
  EXPECT_EQ(with_nodes(nodes), "");
  const std::string many = replaced(file, "<scale>", "<instance_node url='#n25'/><scale>");
  EXPECT_EQ(refusal(replaced(many, "<library_visual_scenes>",
                             "<library_nodes>" + nodes + "</library_nodes><library_visual_scenes>")),
            "a.dae:1: <node>: the scene expands to more than 10^6 nodes");
}

TEST(ReadDae, RefusesScenesThatAreNotThere) {
  const std::string file = test::collada("", "Z_UP"), instance = "<instance_visual_scene url='#s'/>";
  EXPECT_EQ(refusal(replaced(file, instance, "")), "a.dae:1: <COLLADA> has no <scene> with an <instance_visual_scene>");
  EXPECT_EQ(refusal(replaced(file, instance, instance + instance)),
            "a.dae:1: <instance_visual_scene> is the second one, expected one");
  EXPECT_EQ(refusal(replaced(file, instance, "<instance_visual_scene url='#t'/>")),
            "a.dae:1: <instance_visual_scene> has url=\"#t\", expected a <visual_scene> of this file");
  EXPECT_EQ(refusal(replaced(file, "count='9'", "count='-9'")),
            "a.dae:1: <float_array> has count=\"-9\", expected a whole number that fits the size of the file");
}

}  // namespace read_dae_test
}  // namespace hinge::robotics
