// SPDX-License-Identifier: BSD-3-Clause
// Svg: writes simple shapes as an SVG document.
#pragma once

#include <array>
#include <charconv>
#include <span>
#include <string>
#include <string_view>

namespace hinge::tool {

/// A drawing of width x height pixels on white. Coordinates are pixels from the upper left corner. Colours are SVG's,
/// such as "#1b6ca8" or "none". Later shapes cover earlier ones.
class Svg {
 public:
  using Point = std::array<double, 2>;

  Svg(double width, double height) {
    const std::string size = number(width) + " " + number(height);
    text_ = "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 " + size +
            "\" font-family=\"sans-serif\" font-size=\"13\">\n";
    rectangle(0, 0, width, height, "white");
  }

  void line(Point a, Point b, std::string_view colour, double width = 1.0) {
    text_ += "<line" + at("x1", a[0]) + at("y1", a[1]) + at("x2", b[0]) + at("y2", b[1]) + stroke(colour, width) +
             " stroke-linecap=\"round\"/>\n";
  }
  void polyline(std::span<const Point> points, std::string_view colour, double width) {
    text_ += "<polyline" + list(points) + " fill=\"none\"" + stroke(colour, width) + " stroke-linejoin=\"round\"/>\n";
  }
  /// A filled polygon with an edge of its own colour, so that no gap shows between neighbours.
  void polygon(std::span<const Point> points, std::string_view colour) {
    text_ += "<polygon" + list(points) + word("fill", colour) + stroke(colour, 0.5) + "/>\n";
  }
  void rectangle(double x, double y, double width, double height, std::string_view colour) {
    text_ +=
        "<rect" + at("x", x) + at("y", y) + at("width", width) + at("height", height) + word("fill", colour) + "/>\n";
  }
  void circle(Point centre, double radius, std::string_view colour) {
    text_ += "<circle" + at("cx", centre[0]) + at("cy", centre[1]) + at("r", radius) + word("fill", colour) + "/>\n";
  }
  /// anchor: "start", "middle" or "end". more: further attributes, such as "font-weight=\"bold\"".
  void text(Point where, std::string_view words, std::string_view anchor = "start", std::string_view more = "") {
    text_ +=
        "<text" + at("x", where[0]) + at("y", where[1]) + word("text-anchor", anchor) + " " + std::string(more) + ">";
    for (const char c : words) {
      if (c == '<')
        text_ += "&lt;";
      else if (c == '&')
        text_ += "&amp;";
      else
        text_ += c;
    }
    text_ += "</text>\n";
  }

  /// Returns the document.
  std::string document() const { return text_ + "</svg>\n"; }

  /// Returns x with one decimal, the same in every locale.
  static std::string number(double x) {
    std::array<char, 340> digits;
    const auto end = std::to_chars(digits.data(), digits.data() + digits.size(), x, std::chars_format::fixed, 1).ptr;
    return {digits.data(), end};
  }

 private:
  static std::string word(const char* name, std::string_view value) {
    std::string text(1, ' ');
    text += name;
    text += "=\"";
    text += value;
    return text += '"';
  }
  static std::string at(const char* name, double value) { return word(name, number(value)); }
  static std::string stroke(std::string_view colour, double width) {
    return word("stroke", colour) + at("stroke-width", width);
  }
  static std::string list(std::span<const Point> points) {
    std::string text;
    for (const Point& p : points) {
      if (!text.empty()) text += ' ';
      text += number(p[0]);
      text += ',';
      text += number(p[1]);
    }
    return word("points", text);
  }

  std::string text_;
};

}  // namespace hinge::tool
