// SPDX-License-Identifier: BSD-3-Clause
// Tests what each format of meshes may contain, and damaged files of each.
#include <gtest/gtest.h>

#include <array>
#include <bit>
#include <cstdint>
#include <sstream>
#include <string>
#include <vector>

#include "hinge/core/philox.hpp"
#include "robotics/mesh_files.hpp"

namespace hinge::robotics {
namespace mesh_formats_test {

using test::area;
using test::mesh_refusal;
using test::notes_of;
using test::read_mesh_from;

void expect_triangle(const Triangle& t, const Vec3& a, const Vec3& b, const Vec3& c) {
  EXPECT_EQ(t.a, a);
  EXPECT_EQ(t.b, b);
  EXPECT_EQ(t.c, c);
}

/// Every format gives the same doubles for the same numbers, which survive printing with 17 digits.
TEST(MeshFormats, ReadTheNearestDoubleFromText) {
  constexpr std::uint64_t seed = 11;
  for (std::uint64_t sample = 0; sample < 50; ++sample) {
    SampleStream stream(seed, sample);
    std::array<Vec3, 3> corner;
    std::array<std::string, 3> line;
    for (std::size_t k = 0; k < 3; ++k) {
      const double scale = std::ldexp(1.0, static_cast<int>(stream.uniform() * 200) - 100);
      corner[k] = scale * Vec3(stream.uniform() - 0.5, stream.uniform() - 0.5, stream.uniform() - 0.5);
      std::ostringstream text;
      text.precision(17);
      text << corner[k][0] << ' ' << corner[k][1] << " +" << std::abs(corner[k][2]);
      corner[k][2] = std::abs(corner[k][2]);
      line[k] = text.str();
    }
    const std::string obj = "v " + line[0] + "\nv " + line[1] + "\nv " + line[2] + "\nf 1 2 3\n";
    const std::string stl = "solid\nfacet normal nan nan nan\nouter loop\nvertex " + line[0] + "\nvertex " + line[1] +
                            "\nvertex " + line[2] + "\nendloop\nendfacet\nendsolid\n";
    const std::string ply =
        "ply\nformat ascii 1.0\nelement vertex 3\nproperty double x\nproperty double y\nproperty double z\nelement "
        "face 1\nproperty list uchar int vertex_index\nend_header\n" +
        line[0] + "\n" + line[1] + "\n" + line[2] + "\n3 0 1 2\n";
    for (const auto& [name, bytes] : {std::pair("a.obj", obj), std::pair("a.stl", stl), std::pair("a.ply", ply)}) {
      SCOPED_TRACE(std::string(name) + " seed 11 sample " + std::to_string(sample));
      const TriangleMesh mesh = read_mesh_from(name, bytes);
      ASSERT_EQ(mesh.triangles.size(), 1U);
      expect_triangle(mesh.triangles[0], corner[0], corner[1], corner[2]);
    }
  }
}

TEST(Obj, ReadsIndicesInEveryForm) {
  const std::string vertices = "v 0 0 0\n  v\t2 0 0 2 # with a weight\nv 0 1 0 0.5 0.5 0.5\r\nvn 0 0 1\nvt 0 0\n";
  for (const char* face : {"f 1 2 3", "f 1/1 2/1 3/1", "f 1//1 2//1 3//1", "f 1/1/1 2/1/1 3/1/1 # one", "f -3 -2 -1",
                           "fo 1 2 3", "f 1 2 \\\n 3\n", "f 1 2 \\\r\n 3", "g a\nusemtl b\ns off\n f 1 2 -1\n"}) {
    SCOPED_TRACE(face);
    const TriangleMesh mesh = read_mesh_from("a.obj", "\xEF\xBB\xBF# C:\\folder\\\no name\n" + vertices + face);
    ASSERT_EQ(mesh.triangles.size(), 1U);
    expect_triangle(mesh.triangles[0], {0, 0, 0}, {1, 0, 0}, {0, 1, 0});
    EXPECT_EQ(read_mesh_from("a.obj", "f 1 2 3\n" + vertices).triangles.size(), 1U);  // vertices below
  }
}

TEST(Obj, RefusesDamagedLines) {
  const std::string vertices = "v 0 0 0\nv 1 0 0\nv 0 1 0\n";
  EXPECT_EQ(mesh_refusal("a.obj", "v 0 0\n"), "a.obj:1: v has 2 numbers, expected 3, 4 (weight) or 6 (colour)");
  EXPECT_EQ(mesh_refusal("a.obj", "v 0 0 0 1 1 1 1\n"),
            "a.obj:1: v has 7 numbers, expected 3, 4 (weight) or 6 (colour)");
  EXPECT_EQ(mesh_refusal("a.obj", "\nv 0,5 0 0\n"), "a.obj:2: v has '0,5', expected numbers");
  EXPECT_EQ(mesh_refusal("a.obj", "v 0 0 1e999\n"), "a.obj:1: v has '1e999', expected numbers");
  EXPECT_EQ(mesh_refusal("a.obj", "v 0 0 " + std::string(50, 'x')),
            "a.obj:1: v has '" + std::string(40, 'x') + "...', expected numbers");
  EXPECT_EQ(mesh_refusal("a.obj", "v 0 0 0 0\n"), "a.obj:1: v has the weight 0, expected another number");
  EXPECT_EQ(mesh_refusal("a.obj", vertices + "f 1 2 9\n"), "a.obj:4: f uses vertex 9, but the file has 3 vertices");
  for (const char* index : {"0", "-4", "x", "1.5", "99999999999999999999"})
    EXPECT_EQ(mesh_refusal("a.obj", vertices + "f 1 2 " + index),
              std::string("a.obj:4: f has '") + index + "', expected a vertex from 1, or from -1 back to -3");
  EXPECT_EQ(mesh_refusal("a.obj", vertices + "f\n"), "a.obj:4: f has no vertices");
  EXPECT_EQ(mesh_refusal("a.obj", "v 0 0 0\nv 1 0 nan\nv 0 1 0\nf 1 2 3\n"),
            "a.obj:4: face 0 (from 0): vertex 1 is 1 0 nan, expected finite coordinates");
  EXPECT_EQ(mesh_refusal("a.obj", vertices + "surf 0 1 0 1 1 2 3\n"),
            "a.obj:4: surf is a free-form surface, expected polygons");
}

TEST(Obj, NotesUnknownStatements) {
  EXPECT_EQ(notes_of("a.obj", "3\nv 0 0 0\nv 1 0 0\nv 0 1 0\nrubbish\nf 1 2 3\n", 1),
            (std::vector<std::string>{"a.obj: 2 statements are unknown and were skipped, the first is '3' in line 1"}));
}

TEST(Stl, ReadsSeveralSolids) {
  const std::string facet =
      "facet normal -nan(ind) 0 0\n outer loop\n vertex 0 0 0\n vertex 1 0 0\n vertex 0 1 0\n endloop\nendfacet\n";
  EXPECT_EQ(read_mesh_from("a.stl", "solid a\n" + facet + "endsolid a\nsolid facet\r\n" + facet + facet + "endsolid")
                .triangles.size(),
            3U);
}

TEST(Stl, RefusesDamagedText) {
  const auto stl = [](const std::string& facet) { return "solid a\nfacet normal 0 0 1\n" + facet + "endsolid a\n"; };
  const std::string begin = "outer loop\nvertex 0 0 0\nvertex 1 0 0\n", end = "endloop\nendfacet\n";
  EXPECT_EQ(mesh_refusal("a.stl", stl(begin + "vertex 0 1 0\n" + end)), "");
  EXPECT_EQ(mesh_refusal("a.stl", stl(begin + end)), "a.stl:6: 'endloop', expected vertex");
  EXPECT_EQ(mesh_refusal("a.stl", stl(begin + "vertex 0 1\n" + end)), "a.stl:7: 'endloop', expected a number");
  EXPECT_EQ(mesh_refusal("a.stl", stl(begin + "vertex 0 1 0\nvertex 0 1 0\n" + end)),
            "a.stl:7: 'vertex', expected endloop");
  EXPECT_EQ(mesh_refusal("a.stl", stl(begin + "vertex 0 1 0\nendloop\n")), "a.stl:8: 'endsolid', expected endfacet");
  EXPECT_EQ(mesh_refusal("a.stl", stl(begin + "vertex 0 1 inf\n" + end)),
            "a.stl:2: face 0 (from 0): vertex 2 is 0 1 inf, expected finite coordinates");
  EXPECT_EQ(mesh_refusal("a.stl", stl(begin + "vertex 0 1 0\n" + end + "color 1 0 0\n")),
            "a.stl:9: 'color', expected facet or endsolid");
  EXPECT_EQ(mesh_refusal("a.stl", stl(begin + "vertex 0 1 0\n" + end) + "facet\n"),
            "a.stl:10: 'facet', expected solid or the end of the file");
  EXPECT_EQ(mesh_refusal("a.stl", "solid a\nfacet normal 0 0 1\nouter loop\nvertex 0 0"),
            "a.stl: text STL with 1 facets, of which 0 have an endfacet, and no endsolid: the file is cut short or "
            "damaged");
}

/// Appends numbers to a binary file, in one of the byte orders.
class Bytes {
 public:
  explicit Bytes(bool big_endian) : big_endian_(big_endian) {}
  template <class Number>
  Bytes& operator<<(Number number) {
    const auto bytes = std::bit_cast<std::array<char, sizeof(Number)>>(number);
    const bool turn = big_endian_ == (std::endian::native == std::endian::little);
    for (std::size_t k = 0; k < sizeof(Number); ++k) text += bytes[turn ? sizeof(Number) - 1 - k : k];
    return *this;
  }
  std::string text;

 private:
  bool big_endian_;
};

/// Vertices with x and y of these types, and one quad, after lists and elements that are skipped.
std::string binary_ply(bool big_endian) {
  Bytes body(big_endian);
  for (const double x : {0.0, 1.0})
    for (const short y : {short{0}, short{-2}})
      body << static_cast<short>(y) << std::uint8_t{2} << 1.0F << 2.0F << (x + 0.1) << 0.1F;
  body << std::uint32_t{7} << std::uint16_t{1} << std::int8_t{-1};
  body << 1.0F << std::uint8_t{4} << std::uint32_t{0} << std::uint32_t{1} << std::uint32_t{3} << std::uint32_t{2};
  return std::string("ply\nformat binary_") + (big_endian ? "big" : "little") +
         "_endian 1.0\ncomment made here\nelement vertex 4\nproperty short y\nproperty list uchar float spare\n"
         "property double x\nproperty float z\nelement material 1\nproperty uint a\nproperty list ushort char b\n"
         "element face 1\nproperty float quality\nproperty list uint8 uint32 vertex_indices\nend_header\n" +
         body.text;
}

TEST(Ply, ReadsBothByteOrdersAndSkipsTheRest) {
  for (const bool big_endian : {false, true}) {
    const std::string file = binary_ply(big_endian);
    const TriangleMesh mesh = read_mesh_from("a.ply", file);
    ASSERT_EQ(mesh.triangles.size(), 2U);
    EXPECT_DOUBLE_EQ(area(mesh.triangles), 2.0);
    for (const Triangle& t : mesh.triangles)
      for (const Vec3& corner : {t.a, t.b, t.c}) {
        EXPECT_TRUE(corner[0] == 0.1 || corner[0] == 1.1) << corner[0];
        EXPECT_TRUE(corner[1] == 0.0 || corner[1] == -2.0) << corner[1];
        EXPECT_EQ(corner[2], static_cast<double>(0.1F));
      }
    const std::string end = " is cut short: the file ends inside it";
    EXPECT_EQ(mesh_refusal("a.ply", file.substr(0, file.size() - 1)), "a.ply: element face: row 0 (from 0)" + end);
    EXPECT_EQ(mesh_refusal("a.ply", file.substr(0, file.find("end_header\n") + 40)),
              "a.ply: element vertex: row 1 (from 0)" + end);
    EXPECT_NE(mesh_refusal("a.ply", file + " ").find("more follows the last element"), std::string::npos);
  }
}

TEST(Ply, RefusesDamagedText) {
  const auto ply = [](const std::string& face, const std::string& z = "0", const std::string& format = "ascii") {
    return "ply\nformat " + format + " 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\n" +
           "element face 1\nproperty list char int vertex_indices\nend_header\n0 0 0\n1 0 " + z + "\n\n0 1 0\n" + face;
  };
  EXPECT_EQ(mesh_refusal("a.ply", ply("3 0 1 2")), "");
  EXPECT_EQ(mesh_refusal("a.ply", ply("\r\n3 0 1 2 255 0 0\r\n \n")), "");  // undeclared values at the end of a line
  EXPECT_EQ(mesh_refusal("a.ply", ply("3 0 1\n")), "a.ply:14: element face: row 0 (from 0) has too few values");
  EXPECT_EQ(mesh_refusal("a.ply", ply("")), "a.ply:14: element face: row 0 (from 0) has too few values");
  EXPECT_EQ(mesh_refusal("a.ply", ply("3 0 1 x")), "a.ply:14: element face: row 0 (from 0) has 'x', expected a number");
  for (const char* count : {"-3", "2.5", "nan"})
    EXPECT_EQ(mesh_refusal("a.ply", ply(std::string(count) + " 0 1 2")),
              std::string("a.ply:14: element face: row 0 (from 0) has a list of ") + count +
                  " values, expected a whole number");
  EXPECT_EQ(mesh_refusal("a.ply", ply("3 0 1 1.5")),
            "a.ply: face 0 (from 0): it uses vertex 1.5 (from 0), but the mesh has 3 vertices");
  EXPECT_EQ(mesh_refusal("a.ply", ply("3 0 1 2", "nan")),
            "a.ply:14: face 0 (from 0): vertex 1 is 1 0 nan, expected finite coordinates");
  EXPECT_EQ(mesh_refusal("a.ply", ply("3 0 1 2\n3 0 1 2\n")),
            "a.ply:15: more follows the last element, expected the end");
  EXPECT_EQ(mesh_refusal("a.ply", ply("3 0 1 2", "0", "binary")),
            "a.ply: the PLY format is 'binary', expected ascii or binary_(little|big)_endian");
}

TEST(Ply, RefusesHeadersThatHideFaces) {
  const auto ply = [](const std::string& more) {
    return "ply\nformat ascii 1.0\nelement vertex 1\nproperty float x\nproperty float y\nproperty float z\n" + more +
           "end_header\n0 0 0\n3 0 0 0\n";
  };
  EXPECT_EQ(mesh_refusal("a.ply", ply("element face 1\nproperty list uchar int vertex_indices\n")), "");
  EXPECT_EQ(mesh_refusal("a.ply", ply("property float x\n")), "a.ply:7: is the second property x, expected one");
  EXPECT_EQ(mesh_refusal("a.ply", ply("element face 1\nproperty list uchar int corners\n")),
            "a.ply:7: element face has no property list vertex_indices");
  EXPECT_EQ(mesh_refusal("a.ply", ply("element tristrips 1\nproperty list int int vertex_indices\n")),
            "a.ply:7: element tristrips is not supported, expected face");
  EXPECT_EQ(mesh_refusal("a.ply", "ply\nproperty float x\n"), "a.ply:2: property without an element above it");
  EXPECT_EQ(notes_of("a.ply",
                     "ply\nformat ascii 1.0\nelement vertex 1\nproperty float x\nproperty float y\nproperty float z\n"
                     "element face 1\nproperty list uchar int vertex_indices\nelement edge 1\nproperty int vertex1\n"
                     "property int vertex2\nend_header\n0 0 0\n3 0 0 0\n0 0\n",
                     1),
            (std::vector<std::string>{"a.ply: 1 lines or points are left out, because they have no surface"}));
}

}  // namespace mesh_formats_test
}  // namespace hinge::robotics
