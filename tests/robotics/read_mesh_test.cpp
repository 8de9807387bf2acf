// SPDX-License-Identifier: BSD-3-Clause
// Tests reading of STL, OBJ, PLY and COLLADA meshes: triangles, notes, rejected input.
#include "hinge/robotics/read_mesh.hpp"

#include <gtest/gtest.h>

#include <array>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <limits>
#include <string>
#include <vector>

#include "hinge/core/philox.hpp"
#include "hinge/primitive/triangle.hpp"
#include "robotics/mesh_files.hpp"
#include "robotics/robots.hpp"

namespace hinge::robotics {
namespace read_mesh_test {

using Facet = std::array<float, 9>;

std::string binary_stl(const std::vector<Facet>& facets, std::string header = "") {
  header.resize(80, ' ');
  const auto append = [&](std::uint32_t word, int bytes) {
    for (int k = 0; k < bytes; ++k) header += static_cast<char>(word >> 8 * k & 0xffU);
  };
  append(static_cast<std::uint32_t>(facets.size()), 4);
  for (const Facet& facet : facets) {
    for (int k = 0; k < 3; ++k) append(0, 4);
    for (const float x : facet) append(std::bit_cast<std::uint32_t>(x), 4);
    append(0, 2);
  }
  return header;
}

const std::vector<Facet> two_facets = {{0, 0, 0, 1, 0, 0, 0, 1, 0}, {0, 0, 0.1F, 1, 0, 0.1F, 0, 1, 0.1F}};

using test::area;
using test::collada;
using test::notes_of;

TriangleMesh read(const std::string& name, const std::string& bytes) { return test::read_mesh_from(name, bytes); }
std::string refusal(const std::string& name, const std::string& bytes) { return test::mesh_refusal(name, bytes); }

TEST(ReadMesh, KeepsTheBitsOfABinaryStl) {
  const TriangleMesh mesh = read("a.STL", binary_stl(two_facets));
  ASSERT_EQ(mesh.triangles.size(), 2U);
  EXPECT_EQ(mesh.triangles[1].b, Vec3(1, 0, static_cast<double>(0.1F)));
}

TEST(ReadMesh, TellsBinaryFromTextBySize) {
  EXPECT_EQ(read("a.stl", binary_stl(two_facets, "solid exported by a program")).triangles.size(), 2U);
  EXPECT_EQ(read("a.stl",
                 "solid x\nfacet normal 0 0 0\n outer loop\n vertex 0 0 0\n vertex 1 0 0\n vertex 0 1e0 0\n"
                 " endloop\nendfacet\nendsolid\n")
                .triangles.size(),
            1U);
}

/// Duplicate facets, shared vertices and facets of zero area are all kept.
TEST(ReadMesh, DropsJoinsAndMendsNothing) {
  const Facet flat = {0, 0, 0, 1, 1, 1, 2, 2, 2}, point = {1, 2, 3, 1, 2, 3, 1, 2, 3};
  const TriangleMesh mesh = read("a.stl", binary_stl({two_facets[0], two_facets[0], flat, point}));
  ASSERT_EQ(mesh.triangles.size(), 4U);
  EXPECT_EQ(mesh.triangles[0].c, mesh.triangles[1].c);
  EXPECT_EQ(mesh.triangles[2].b, Vec3(1, 1, 1));
  EXPECT_EQ(mesh.triangles[3].c, Vec3(1, 2, 3));
}

TEST(ReadMesh, RefusesStlFilesCutShortOrEmpty) {
  const std::string whole = binary_stl(two_facets);
  EXPECT_EQ(refusal("a.stl", whole.substr(0, 150)),
            "a.stl: the header of the binary STL gives 2 triangles, which need 184 bytes; the file has 150");
  EXPECT_EQ(refusal("a.stl", binary_stl(two_facets, "solid").substr(0, 183)),
            "a.stl: the header of the binary STL gives 2 triangles, which need 184 bytes; the file has 183");
  EXPECT_EQ(refusal("a.stl", whole.substr(0, 40)), "a.stl: 40 bytes, expected at least the 84 of a binary STL");
  EXPECT_EQ(refusal("a.stl", binary_stl({})), "a.stl: has no triangles");
  EXPECT_EQ(refusal("a.stl", "solid\nendsolid\n"), "a.stl: has no triangles");
  EXPECT_EQ(
      refusal("a.stl", "solid\nfacet normal 0 0 1\n"),
      "a.stl: text STL with 1 facets, of which 0 have an endfacet, and no endsolid: the file is cut short or damaged");
}

TEST(ReadMesh, RefusesVerticesThatAreNotFinite) {
  std::vector<Facet> facets = two_facets;
  facets[1][5] = std::numeric_limits<float>::quiet_NaN();
  EXPECT_EQ(refusal("a.stl", binary_stl(facets)),
            "a.stl: face 1 (from 0): vertex 1 is 1 0 nan, expected finite coordinates");
  facets[1][5] = -std::numeric_limits<float>::infinity();
  EXPECT_NE(refusal("a.stl", binary_stl(facets)).find("-inf"), std::string::npos);
}

/// A wrong triangulation (overlaps, triangles outside the polygon) has more area than the polygon.
TEST(ReadMesh, CutsThePolygonsOfAnObj) {
  // An L with area 3 in each coordinate plane, in both orientations and from several first corners.
  const std::vector<std::array<int, 2>> corners = {{0, 0}, {2, 0}, {2, 1}, {1, 1}, {1, 2}, {0, 2}};
  for (const char* format : {"v %d %d 7\n", "v 7 %d %d\n", "v %d 7 %d\n"})
    for (const char* face : {"f 1 2 3 4 5 6\n", "f 6 5 4 3 2 1\n", "f 4 5 6 1 2 3\n"}) {
      std::string obj;
      for (const auto& [x, y] : corners) {
        std::array<char, 40> line{};
        std::snprintf(line.data(), line.size(), format, x, y);
        obj += line.data();
      }
      const TriangleMesh mesh = read("a.obj", obj + face);
      EXPECT_EQ(mesh.triangles.size(), 4U);
      EXPECT_DOUBLE_EQ(area(mesh.triangles), 3.0) << format << face;
    }
}

/// Stars with random radii around the origin are simple polygons. Their area is a sum of triangles.
TEST(ReadMesh, CutsRandomStars) {
  constexpr std::uint64_t seed = 7;
  for (std::uint64_t sample = 0; sample < 30; ++sample) {
    SampleStream stream(seed, sample);
    const std::size_t n = 4 + static_cast<std::size_t>(stream.uniform() * 40);
    std::string obj, face = "f";
    std::vector<Vec3> corner;
    for (std::size_t k = 0; k < n; ++k) {
      const double angle = 2 * std::acos(-1.0) * static_cast<double>(k) / static_cast<double>(n);
      // Multiples of 1/16 are read without rounding.
      const double radius = 16 + 100 * stream.uniform();
      const double x = std::round(radius * std::cos(angle)) / 16, y = std::round(radius * std::sin(angle)) / 16;
      corner.emplace_back(x, y, x + y);
      obj += "v " + std::to_string(x) + " " + std::to_string(y) + " " + std::to_string(x + y) + "\n";
      face.append(" ").append(std::to_string(k + 1));
    }
    double expected = 0.0;
    for (std::size_t k = 0; k < n; ++k) expected += cross(corner[k], corner[(k + 1) % n]).norm() / 2;
    const TriangleMesh mesh = read("a.obj", obj + face + "\n");
    EXPECT_EQ(mesh.triangles.size(), n - 2);
    EXPECT_NEAR(area(mesh.triangles), expected, 1e-6 * expected) << "seed " << seed << " sample " << sample;
  }
}

// A shape does not depend on its materials, whose file may be missing or damaged.
TEST(ReadMesh, LooksAtNoMaterialsOfAnObj) {
  const test::TemporaryFolder folder;
  folder.write("a.mtl", "newmtl gold\nKd x");
  for (const char* materials : {"mtllib a.mtl\n", " mtllib a.mtl\r\n"}) {
    const auto file = folder.write("a.obj", std::string(materials) + "v 0 0 0\nv 1 0 0\nv 0 1 0\nusemtl gold\nf 1 2 3");
    EXPECT_EQ(read_mesh(file).triangles.size(), 1U);
  }
  EXPECT_EQ(refusal("a.obj", "mtllib a.mtl"), "a.obj: has no triangles");
}

// Lines and points are no surface; MoveIt and Coal also drop them. A polygon without area is a surface, cut into
// triangles without area.
TEST(ReadMesh, LeavesLinesAndPointsOutWithANote) {
  const std::string vertices = "v 0 0 0\nv 1 0 0\nv 0 1 0\n";
  EXPECT_EQ(notes_of("a.obj", vertices + "f 1 2 3\nl 2 3\np 1\n", 1),
            (std::vector<std::string>{"a.obj: 2 lines or points are left out, because they have no surface"}));
  EXPECT_TRUE(notes_of("a.obj", vertices + "f 1 2 3\nf 1 2 2\n", 2).empty());
  EXPECT_EQ(refusal("a.obj", vertices + "l 1 2 3\n"), "a.obj: has no triangles, only 2 lines or points");
  EXPECT_EQ(read("a.obj", vertices + "f 1 2 3\nl 2 3\n").triangles.size(), 1U);  // notes are optional
}

TEST(ReadMesh, ReadsPly) {
  const TriangleMesh mesh = read("a.ply",
                                 "ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\nproperty float y\n"
                                 "property float z\nelement face 1\nproperty list uchar int vertex_indices\n"
                                 "end_header\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n4 0 1 2 3\n");
  EXPECT_EQ(mesh.triangles.size(), 2U);
}

/// Returns the refusal of a COLLADA file after one replacement.
std::string refusal_with(const std::string& from, const std::string& to) {
  std::string text = collada("", "Z_UP");
  return refusal("a.dae", text.replace(text.find(from), from.size(), to));
}

TEST(ReadMesh, AppliesNodesAndUnitsOfADaeButNotItsUpAxis) {
  for (const char* axis : {"X_UP", "Y_UP", "Z_UP"}) {
    const TriangleMesh mesh = read("a.dae", collada("<unit meter='0.5'/>", axis));
    ASSERT_EQ(mesh.triangles.size(), 2U) << axis;
    EXPECT_EQ(mesh.triangles[0].c, Vec3(0, 0.5, 1)) << axis;
    EXPECT_EQ(mesh.triangles[1].c, Vec3(10, 21, 32)) << axis;
  }
  EXPECT_EQ(read("a.dae", collada("", "Y_UP")).triangles.at(1).b, Vec3(22, 40, 60));
}

// Some readers make a mesh of their own from a scene without triangles, a pyramid per node.
TEST(ReadMesh, InventsNoTrianglesForADaeThatShowsNone) {
  const std::string nothing = "a.dae: has no triangles";
  const std::string shown = "<instance_geometry url='#g'/>";
  std::string hidden = collada("", "Z_UP");
  for (std::size_t at = hidden.find(shown); at != std::string::npos; at = hidden.find(shown))
    hidden.erase(at, shown.size());
  EXPECT_EQ(refusal("a.dae", hidden), nothing);
  EXPECT_EQ(refusal_with("<triangles count='1'><input semantic='VERTEX' source='#v' offset='0'/><p>0 1 2</p>",
                         "<triangles count='0'><input semantic='VERTEX' source='#v' offset='0'/><p/>"),
            nothing);
  EXPECT_EQ(refusal_with("<triangles count='1'><input semantic='VERTEX' source='#v' offset='0'/><p>0 1 2</p>"
                         "</triangles>",
                         ""),
            nothing);
  const std::string scene =
      "<library_visual_scenes><visual_scene id='s'><node id='n'><instance_camera url='#c'/></node></visual_scene>"
      "</library_visual_scenes><scene><instance_visual_scene url='#s'/></scene></COLLADA>";
  const std::string head = "<COLLADA xmlns='http://www.collada.org/2005/11/COLLADASchema' version='1.4.1'>";
  EXPECT_EQ(refusal("a.dae", head + "<library_cameras><camera id='c'/></library_cameras>" + scene), nothing);
  EXPECT_EQ(refusal("a.dae", head + scene), nothing);
}

TEST(ReadMesh, LeavesTheLinesOfADaeOut) {
  std::string text = collada("", "Z_UP");
  const std::string lines = "<lines count='1'><input semantic='VERTEX' source='#v' offset='0'/><p>0 1</p></lines>";
  text.insert(text.find("</mesh>"), lines);
  // Two nodes instance the mesh, so its line is counted twice.
  EXPECT_EQ(notes_of("a.dae", text, 2),
            (std::vector<std::string>{"a.dae: 2 lines or points are left out, because they have no surface"}));
}

TEST(ReadMesh, InventsNoTrianglesForOtherFilesWithoutFaces) {
  EXPECT_EQ(refusal("a.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\n"), "a.obj: has no triangles");
  EXPECT_EQ(refusal("a.stl", binary_stl({})), "a.stl: has no triangles");
  EXPECT_EQ(refusal("a.stl", "solid a\nendsolid a\n"), "a.stl: has no triangles");
  const std::string vertices =
      "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\n";
  const std::string xyz = "end_header\n0 0 0\n1 0 0\n0 1 0\n";
  EXPECT_EQ(refusal("a.ply", vertices + xyz), "a.ply: has no triangles");
  EXPECT_EQ(refusal("a.ply", vertices + "element face 0\nproperty list uchar int vertex_indices\n" + xyz),
            "a.ply: has no triangles");
  EXPECT_EQ(
      notes_of("a.ply",
               vertices + "element face 2\nproperty list uchar int vertex_indices\n" + xyz + "3 0 1 2\n2 0 1\n", 1),
      (std::vector<std::string>{"a.ply: 1 lines or points are left out, because they have no surface"}));
}

TEST(ReadMesh, RefusesDaeInputsWithoutTheirNumbers) {
  EXPECT_EQ(refusal_with(" count='9'", ""), "a.dae:1: <float_array> has no count, expected a whole number");
  EXPECT_EQ(refusal_with("stride='3'", "stride='4'"), "a.dae:1: <accessor> reaches beyond the 9 numbers of '#pa'");
  EXPECT_EQ(refusal_with("stride='3'", "offset='1' stride='3'"),
            "a.dae:1: <accessor> reaches beyond the 9 numbers of '#pa'");
  EXPECT_EQ(refusal_with("stride='3'", ""), "a.dae:1: <accessor> reaches beyond the 9 numbers of '#pa'");
  EXPECT_EQ(refusal_with("</accessor>", "</accessor><accessor source='#names'/>"),
            "a.dae:1: <accessor> is the second accessor of <source id=\"p\">, expected one");
  EXPECT_EQ(refusal_with("source='#pa'", "source='#pb'"),
            "a.dae:1: <accessor> has source=\"#pb\", expected a <float_array> of this file");
  EXPECT_EQ(refusal_with("semantic='POSITION' source='#p'", "semantic='POSITION' source='#q'"),
            "a.dae:1: <input> has source=\"#q\", expected a <source> of this file");
  EXPECT_EQ(refusal_with("name='X' type='float'", "name='X' type='float4x4'"),
            "a.dae:1: <input> has source=\"#p\", which has no X, Y and Z");
  EXPECT_EQ(refusal_with("name='X'", "name='Y'"), "a.dae:1: <input> has source=\"#p\", which has no X, Y and Z");
  EXPECT_EQ(refusal_with("source='#v'", "source='#w'"),
            "a.dae:1: <input> has source=\"#w\", expected the <vertices> above");
  EXPECT_EQ(refusal_with("</source>", "<float_array id='pa' count='0'/></source>"),
            "a.dae:1: <accessor> has source=\"#pa\", expected one <float_array>, but several have this id");
  EXPECT_EQ(refusal_with("0 0 0 1 0 0", "0 0 0 1 0"), "a.dae:1: <float_array> holds 8 numbers, expected 9");
  EXPECT_EQ(refusal_with("0 0 0 1 0 0", "0 0 0 1 0,0 0"), "a.dae:1: <float_array> holds '0,0', expected numbers");
}

TEST(ReadMesh, RefusesDaePrimitivesWithoutTheirVertices) {
  const auto with = [](const std::string& kind, const std::string& input, const std::string& indices) {
    std::string text = collada("", "Z_UP");
    const std::size_t from = text.find("<triangles"), to = text.find("</mesh>");
    return refusal("a.dae",
                   text.replace(from, to - from,
                                "<" + kind + ">" + input + indices + "</" + kind.substr(0, kind.find(' ')) + ">"));
  };
  const std::string vertex = "<input semantic='VERTEX' source='#v' offset='0'/>";
  EXPECT_EQ(with("polygons count='1'", vertex, "<p>0 1 2</p>"), "");
  EXPECT_EQ(with("tristrips count='1'", vertex, "<p>0 1 2 0</p>"), "");
  EXPECT_EQ(with("polylist count='1'", vertex, "<vcount>3</vcount><p>0 1 2</p>"), "");
  EXPECT_EQ(with("triangles count='1'", vertex, "<p><!-- one --> 0 1 2 <!-- face --></p>"), "");
  EXPECT_EQ(with("triangles count='1'", vertex, "<p><![CDATA[0 1 2]]></p>"), "");

  EXPECT_EQ(with("triangles count='1'", "", "<p>0 1 2</p>"),
            "a.dae:1: <p> has no <input> with semantic=\"VERTEX\" above it");
  EXPECT_EQ(with("triangles count='1'", vertex + vertex, "<p>0 1 2</p>"),
            "a.dae:1: <input> is the second VERTEX of one element, expected one");
  EXPECT_EQ(with("polygons count='1'", vertex + "<input semantic='UV' source='#p' offset='0'/>", "<p>0 1 2</p>"), "");
  EXPECT_EQ(with("polygons count='1'", vertex + "<input semantic='UV' source='#p' offset='1'/>", "<p>0 2 1 2 2 2</p>"),
            "");
  EXPECT_EQ(with("polygons count='1'", vertex + "<input semantic='POSITION' source='#p'/>", "<p>0 1 2</p>"),
            "a.dae:1: <input> has semantic=\"POSITION\", expected it in <vertices> only");
  EXPECT_EQ(with("triangles", vertex, "<p>0 1 2</p>"),
            "a.dae:1: <triangles> has indices, but no count, expected the number of primitives");
  EXPECT_EQ(with("trifans count='1'", vertex, "<p>0 1 2</p>"), "");
  EXPECT_EQ(with("polygons count='1'", vertex, "<ph><p>0 1 2</p><h>0 1 2</h></ph>"),
            "a.dae:1: <ph> is not supported in <polygons>, expected <p>");
  EXPECT_EQ(with("curves count='1'", vertex, ""), "a.dae:1: <curves> is not supported in <mesh>, expected <triangles>");
  EXPECT_EQ(with("triangles count='1'", vertex, "<p>0 1 3</p>"),
            "a.dae:1: <p> uses vertex 3 (from 0), but there are 3");
  EXPECT_EQ(with("triangles count='2'", vertex, "<p>0 1 2</p>"),
            "a.dae:1: <p> holds 3 indices, expected 1 for each of 6 vertices");
  EXPECT_EQ(with("tristrips count='1'", vertex, "<p>0 1</p>"),
            "a.dae:1: <p> holds 2 indices, expected 1 for each of 3 or more vertices");
  EXPECT_EQ(with("polylist count='1'", vertex, "<p>0 1 2</p>"), "a.dae:1: <p> has no <vcount> above it");
  EXPECT_EQ(with("polylist count='1'", vertex, "<p>0 1 2</p><vcount>3</vcount>"),
            "a.dae:1: <p> has no <vcount> above it");
  EXPECT_EQ(with("polylist count='2'", vertex, "<vcount>3</vcount><p>0 1 2</p>"),
            "a.dae:1: <vcount> holds 1 numbers, expected 2");
  EXPECT_EQ(with("polylist count='1'", vertex, "<vcount>2000000000</vcount><p>0 1 2</p>"),
            "a.dae:1: <p> holds 3 indices, expected 1 for each of 2000000000 vertices");

  EXPECT_EQ(with("triangles count='1'", vertex, "<p>0 1 x</p>"), "a.dae:1: <p> holds 'x', expected whole numbers >= 0");
  EXPECT_EQ(with("triangles count='1'", vertex, "<p>0 1 -1</p>"),
            "a.dae:1: <p> holds '-1', expected whole numbers >= 0");
  EXPECT_EQ(with("triangles count='1'", vertex, "<p><q/>x</p>"),
            "a.dae:1: <p> holds more than one text, expected one list of whole numbers");
  EXPECT_EQ(with("triangles count='1'", vertex, "<p>0 1 <!-- not read: --> 2</p>"),
            "a.dae:1: <p> holds more than one text, expected one list of whole numbers");
}

TEST(ReadMesh, RefusesDaeVerticesAndInstancesThatWouldBeLeftOut) {
  const std::string position = "<input semantic='POSITION' source='#p'/>";
  EXPECT_EQ(refusal_with(position, position + position),
            "a.dae:1: <input> is the second POSITION of one <mesh>, expected one");
  EXPECT_EQ(refusal_with("'POSITION'", "'NORMAL'"), "a.dae:1: <p> has no <vertices> with a POSITION above it");
  EXPECT_EQ(refusal_with("url='#g'", "url='#h'"),
            "a.dae:1: <instance_geometry> has url=\"#h\", expected a <geometry> of this file");
  EXPECT_EQ(refusal_with("url='#g'", "url='other.dae#g'"),
            "a.dae:1: <instance_geometry> has url=\"other.dae#g\", expected a <geometry> of this file");
  EXPECT_EQ(refusal_with("<instance_geometry url='#g'", "<instance_node url='#q'"),
            "a.dae:1: <instance_node> has url=\"#q\", expected a <node> of this file");
  EXPECT_EQ(refusal_with("instance_geometry", "instance_controller"),
            "a.dae:1: <instance_controller> deforms or blends a mesh, expected <instance_geometry>");
  // Elements that are no shapes, such as cameras and lights, are not read.
  EXPECT_EQ(refusal_with("<instance_geometry url='#g'",
                         "<instance_camera url='#cam'/><instance_light url='#lamp'/>"
                         "<instance_geometry url='#g'"),
            "");
  EXPECT_EQ(refusal_with("<library_geometries>",
                         "<library_images><image id='i'><init_from><hex>f</hex></init_from></image>"
                         "</library_images><library_geometries>"),
            "");
  EXPECT_EQ(refusal_with("<library_geometries>",
                         "<library_animations><source id='p'><float_array id='pa'/></source></library_animations>"
                         "<library_geometries>"),
            "");
}

TEST(ReadMesh, RefusesPlyElementsThatAreMisread) {
  const auto ply = [](const std::string& element) {
    return "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\n" + element +
           "property list uchar int vertex_indices\nend_header\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n";
  };
  EXPECT_EQ(refusal("a.ply", ply("element face 1\r\n")), "");
  EXPECT_EQ(refusal("a.ply", ply("element 4294967295face 1\n")),
            "a.ply:7: element has the name '4294967295face', expected a name that begins with a letter");
  EXPECT_EQ(refusal("a.ply", ply("element face 1\relement 4294967295face 1\n")),
            "a.ply:7: the line holds a carriage return, expected \\n or \\r\\n at its end");
}

TEST(ReadMesh, RefusesPlyFacesAndVerticesThatLackSomething) {
  const auto ply = [](const std::string& z, const std::string& face) {
    return "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty " + z +
           "\nelement face 1\nproperty list uchar int vertex_indices\nend_header\n0 0 0\n1 0 0\n0 1 0\n" + face + "\n";
  };
  EXPECT_EQ(refusal("a.ply", ply("float z", "3 0 1 2")), "");
  EXPECT_EQ(refusal("a.ply", ply("float z", "3 0 1 3")),
            "a.ply: face 0 (from 0): it uses vertex 3 (from 0), but the mesh has 3 vertices");
  EXPECT_EQ(refusal("a.ply", ply("float z", "3 0 1 -1")),
            "a.ply: face 0 (from 0): it uses vertex -1 (from 0), but the mesh has 3 vertices");
  EXPECT_EQ(refusal("a.ply", ply("float ", "3 0 1 2")), "a.ply:6: property has no name");
  EXPECT_EQ(refusal("a.ply", ply("list uchar float", "3 0 1 2")), "a.ply:6: property has no name");
  EXPECT_EQ(refusal("a.ply", ply("half z", "3 0 1 2")),
            "a.ply:6: property has the type 'half', expected a type of the PLY format");
  EXPECT_EQ(refusal("a.ply", ply("list uchar float z", "3 0 1 2")), "a.ply:3: element vertex has no property z");
  EXPECT_EQ(refusal("a.ply", ply("float w", "3 0 1 2")), "a.ply:3: element vertex has no property z");
}

TEST(ReadMesh, RefusesOtherFormatsAndRubbish) {
  EXPECT_EQ(refusal("a.step", "x"), "a.step: the mesh format is '.step', expected .stl, .obj, .dae or .ply");
  EXPECT_EQ(refusal("a.obj", ""), "a.obj: has no triangles");
  for (const char* name : {"a.obj", "a.dae", "a.ply"}) EXPECT_NE(refusal(name, "rubbish\n"), "") << name;
  EXPECT_NE(refusal("a.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 9\n"), "");
  EXPECT_NE(refusal("a.obj", "v 0 0 0\nv 1 0 nan\nv 0 1 0\nf 1 2 3\n"), "");
  const test::TemporaryFolder folder;
  EXPECT_EQ(test::refusal(folder, [&] { read_mesh(folder.path() / "none.stl"); }),
            "none.stl: cannot be opened: No such file or directory");
}

}  // namespace read_mesh_test
}  // namespace hinge::robotics
