// SPDX-License-Identifier: BSD-3-Clause
// Tests drawings: the text of SVG documents, and which shape covers which.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstddef>
#include <regex>
#include <string>
#include <vector>

#include "hinge/core/vec3.hpp"
#include "hinge_tools/picture.hpp"
#include "hinge_tools/svg.hpp"

namespace hinge::tool {
namespace picture_test {

constexpr Colour red{255, 0, 0}, blue{0, 0, 255};

/// Looks along -z at the picture; x is to the right, y is up.
Picture from_above() { return {{0, 0, 1}, {0, 1, 0}}; }

std::string drawn(const Picture& picture) {
  Svg svg(100, 100);
  picture.draw(svg, 0, 0, 100, 100);
  return svg.document();
}

/// Returns the corners of every polygon, in the order of drawing.
std::vector<std::array<Svg::Point, 3>> triangles(const std::string& document) {
  static const std::regex polygon(
      "<polygon points=\"([-0-9.]+),([-0-9.]+) ([-0-9.]+),([-0-9.]+) ([-0-9.]+),([-0-9.]+)\"");
  std::vector<std::array<Svg::Point, 3>> all;
  for (std::sregex_iterator match(document.begin(), document.end(), polygon), end; match != end; ++match) {
    const auto number = [&](std::size_t k) { return std::stod((*match)[k]); };
    all.push_back({Svg::Point{number(1), number(2)}, {number(3), number(4)}, {number(5), number(6)}});
  }
  return all;
}

double area(const std::array<Svg::Point, 3>& t) {
  return std::abs((t[1][0] - t[0][0]) * (t[2][1] - t[0][1]) - (t[2][0] - t[0][0]) * (t[1][1] - t[0][1])) / 2;
}

TEST(Svg, WritesShapesAndEscapesText) {
  Svg svg(20, 10);
  svg.line({1, 2}, {3.25, 4}, "#ddd", 2);
  svg.circle({5, 6}, 1.5, "red");
  svg.text({1, 9}, "a < b & c", "middle", "fill=\"blue\"");
  EXPECT_EQ(svg.document(),
            "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 20.0 10.0\" font-family=\"sans-serif\" "
            "font-size=\"13\">\n"
            "<rect x=\"0.0\" y=\"0.0\" width=\"20.0\" height=\"10.0\" fill=\"white\"/>\n"
            "<line x1=\"1.0\" y1=\"2.0\" x2=\"3.2\" y2=\"4.0\" stroke=\"#ddd\" stroke-width=\"2.0\" "
            "stroke-linecap=\"round\"/>\n"
            "<circle cx=\"5.0\" cy=\"6.0\" r=\"1.5\" fill=\"red\"/>\n"
            "<text x=\"1.0\" y=\"9.0\" text-anchor=\"middle\" fill=\"blue\">a &lt; b &amp; c</text>\n"
            "</svg>\n");
}

TEST(Picture, DrawsNearShapesOverFarShapes) {
  for (const double nearer : {1.0, -1.0}) {
    Picture picture = from_above();
    picture.ball({0, 0, nearer}, 1, red);
    picture.ball({0, 0, -nearer}, 1, blue);
    const std::string document = drawn(picture);
    EXPECT_EQ(document.find("#ff0000") > document.find("#0000ff"), nearer > 0) << document;
  }
}

TEST(Picture, FillsItsRectangleWithYUpwards) {
  Picture picture = from_above();
  picture.rod({0, 0, 0}, {4, 2, 0}, 0.1, red);
  EXPECT_NE(drawn(picture).find("x1=\"0.0\" y1=\"75.0\" x2=\"100.0\" y2=\"25.0\""), std::string::npos)
      << drawn(picture);
}

/// The middle of the large triangle is nearer to the viewer than the ball, but the part below the ball is not.
TEST(Picture, SortsPiecesOfLargeTriangles) {
  Picture picture = from_above();
  picture.triangle({0, 0, 0}, {30, 0, 30}, {0, 30, 0}, blue);
  picture.ball({1, 1, 4}, 0.5, red);
  const std::string document = drawn(picture);
  const std::vector<std::array<Svg::Point, 3>> pieces = triangles(document);
  ASSERT_GT(pieces.size(), 10U);
  double sum = 0.0;
  for (const auto& piece : pieces) sum += area(piece);
  EXPECT_NEAR(sum, 5000, 20) << "the pieces cover the triangle";
  const std::size_t ball = document.find("<circle");
  const std::size_t below = triangles(document.substr(0, ball)).size();
  EXPECT_GT(below, 0U);
  EXPECT_LT(below, pieces.size());
  for (std::size_t k = below; k < pieces.size(); ++k)
    for (const Svg::Point& corner : pieces[k]) EXPECT_GT(corner[0], 3.4) << "piece " << k << " covers the ball";
}

/// The number of pieces depends on the drawing, not on the unit of length.
TEST(Picture, CutsIntoFewPiecesAtAnyScale) {
  std::vector<std::size_t> counts;
  for (const double size : {1e-6, 1.0, 1e9}) {
    Picture picture = from_above();
    picture.triangle({0, 0, 0}, {size, 0, 0}, {0, size, 0}, red);
    picture.triangle({0, 0, -size}, {size, 0, -size}, {0, 1e3 * size, -size}, red);
    counts.push_back(triangles(drawn(picture)).size());
    EXPECT_LT(counts.back(), 1000U);
  }
  EXPECT_EQ(counts[0], counts[1]);
  EXPECT_EQ(counts[2], counts[1]);
}

TEST(Picture, DrawsNothingForNoShapesAndFlatTriangles) {
  const std::string empty = drawn(from_above());
  Picture flat = from_above();
  flat.triangle({0, 0, 0}, {1, 0, 0}, {2, 0, 0}, red);
  EXPECT_EQ(drawn(flat), empty);
}

}  // namespace picture_test
}  // namespace hinge::tool
