// SPDX-License-Identifier: BSD-3-Clause
// Picture: a shaded drawing of triangles, rods and balls, for the demos.
#pragma once

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "hinge/core/vec3.hpp"
#include "hinge_tools/svg.hpp"

namespace hinge::tool {

/// Red, green and blue, each from 0 to 255.
using Colour = std::array<double, 3>;

/// Collects shapes in model units and draws them with the painter's algorithm: far shapes first, without perspective.
class Picture {
 public:
  /// to_viewer: the direction from the model to the viewer; up: a direction that shall point upwards. They must not be
  /// parallel.
  Picture(const Vec3& to_viewer, const Vec3& up) : depth_(to_viewer.normalized()) {
    right_ = up.cross(depth_).normalized();
    up_ = depth_.cross(right_);
  }

  /// Both sides are lit, from the viewer's upper left.
  void triangle(const Vec3& a, const Vec3& b, const Vec3& c, const Colour& colour) {
    const Vec3 normal = (b - a).cross(c - a);
    const double length = normal.norm();
    if (!(length > 0.0)) return;
    const Vec3 light = (depth_ + 0.6 * up_ - 0.4 * right_).normalized();
    shapes_.push_back({{a, b, c}, 0.0, shaded(colour, 0.45 + 0.55 * std::abs(normal.dot(light)) / length)});
  }
  /// A rod from a to b, `width` wide in model units.
  void rod(const Vec3& a, const Vec3& b, double width, const Colour& colour) {
    shapes_.push_back({{a, b}, width, shaded(colour, 1.0)});
  }
  void ball(const Vec3& centre, double radius, const Colour& colour) {
    shapes_.push_back({{centre}, radius, shaded(colour, 1.0)});
  }

  /// Draws all shapes, fitted into the rectangle of `svg` that starts at (x, y). Does nothing without shapes.
  void draw(Svg& svg, double x, double y, double width, double height) const {
    if (shapes_.empty()) return;
    std::array<double, 2> low{1e300, 1e300}, high{-1e300, -1e300};
    for (const Shape& shape : shapes_)
      for (const Vec3& corner : shape.corners)
        for (std::size_t k = 0; k < 2; ++k) {
          const double at = corner.dot(k == 0 ? right_ : up_), size = shape.corners.size() == 1 ? shape.size : 0.0;
          low[k] = std::min(low[k], at - size);
          high[k] = std::max(high[k], at + size);
        }
    const double scale = std::min(width / std::max(high[0] - low[0], 1e-9), height / std::max(high[1] - low[1], 1e-9));
    const auto pixel = [&](const Vec3& p) {
      return Svg::Point{x + width / 2 + scale * (p.dot(right_) - (low[0] + high[0]) / 2),
                        y + height / 2 - scale * (p.dot(up_) - (low[1] + high[1]) / 2)};
    };
    std::vector<Shape> pieces;
    const double longest = std::max(high[0] - low[0], high[1] - low[1]) / pieces_per_side;
    for (const Shape& shape : shapes_) cut(shape, longest, pieces);
    std::stable_sort(pieces.begin(), pieces.end(),
                     [&](const Shape& a, const Shape& b) { return nearness(a) < nearness(b); });
    for (const Shape& shape : pieces) {
      if (shape.corners.size() == 1) {
        svg.circle(pixel(shape.corners[0]), scale * shape.size, shape.colour);
      } else if (shape.corners.size() == 2) {
        svg.line(pixel(shape.corners[0]), pixel(shape.corners[1]), shape.colour, scale * shape.size);
      } else {
        const std::array<Svg::Point, 3> points{pixel(shape.corners[0]), pixel(shape.corners[1]),
                                               pixel(shape.corners[2])};
        svg.polygon(points, shape.colour);
      }
    }
  }

 private:
  struct Shape {
    std::vector<Vec3> corners;  // one: a ball; two: a rod; three: a triangle
    double size;                // radius or width, not used by triangles
    std::string colour;
  };

  /// Triangles are cut until no edge is longer than the drawing's longer side divided by this number: only small shapes
  /// are sorted well.
  static constexpr double pieces_per_side = 12.0;

  /// Appends the shape to `pieces`, a triangle in pieces whose edges, as drawn, are at most `longest`.
  void cut(const Shape& shape, double longest, std::vector<Shape>& pieces) const {
    const auto drawn = [&](const Vec3& edge) { return std::hypot(edge.dot(right_), edge.dot(up_)); };
    if (shape.corners.size() == 3)
      for (std::size_t k = 0; k < 3; ++k) {
        const Vec3 &a = shape.corners[k], &b = shape.corners[(k + 1) % 3], &c = shape.corners[(k + 2) % 3];
        const double edge = drawn(b - a);
        if (!(edge > longest) || edge < drawn(c - b) || edge < drawn(a - c)) continue;
        const Vec3 middle = (a + b) / 2;
        cut({{a, middle, c}, shape.size, shape.colour}, longest, pieces);
        cut({{middle, b, c}, shape.size, shape.colour}, longest, pieces);
        return;
      }
    pieces.push_back(shape);
  }
  /// Returns how near the shape's middle is to the viewer.
  double nearness(const Shape& shape) const {
    double sum = 0.0;
    for (const Vec3& corner : shape.corners) sum += corner.dot(depth_);
    return sum / static_cast<double>(shape.corners.size());
  }
  static std::string shaded(const Colour& colour, double light) {
    std::string text = "#";
    constexpr const char* digits = "0123456789abcdef";
    for (const double part : colour) {
      const auto byte = static_cast<unsigned>(std::clamp(part * light, 0.0, 255.0));
      text += {digits[byte >> 4U], digits[byte & 15U]};
    }
    return text;
  }

  Vec3 depth_, right_, up_;
  std::vector<Shape> shapes_;
};

}  // namespace hinge::tool
