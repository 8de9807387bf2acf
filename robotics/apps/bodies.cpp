// SPDX-License-Identifier: BSD-3-Clause
// Parses the text of --env.
#include "bodies.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstddef>
#include <memory>
#include <string_view>
#include <system_error>
#include <utility>
#include <vector>

#include "hinge/core/error.hpp"
#include "hinge/robotics/read_mesh.hpp"
#include "hinge/robotics/read_points.hpp"
#include "hinge/robotics/rpy.hpp"
#include "hinge_tools/number_option.hpp"

namespace robocd {

using namespace hinge::robotics;
using hinge::Pose;
using hinge::Vec3;

namespace {

bool is_mesh(const Body& body) { return !body.primitive && !body.radius; }

class BodyReader {
 public:
  explicit BodyReader(const std::string& text) : text_(text) {}

  Body read() {
    Body body;
    body.name = text_;
    std::error_code ignored;
    if (std::filesystem::exists(text_, ignored)) {
      body.file = text_;
      return body;
    }
    std::string_view rest = text_;
    std::string_view shape = piece(rest);
    if (const std::size_t equals = shape.find('='); equals != std::string_view::npos) {
      body.name = shape.substr(0, equals);
      body.is_named = true;
      shape.remove_prefix(equals + 1);
      if (body.name.empty()) refuse("the name before '=' is empty, expected NAME=SHAPE");
    }
    if (shape.empty()) refuse("the shape is missing, expected [NAME=]SHAPE");
    read_shape(shape, body);
    Vec3 angles = Vec3::Zero();
    while (!rest.empty()) {
      const std::string_view field = piece(rest);
      const std::size_t equals = field.find('=');
      const std::string_view key = field.substr(0, equals);
      const std::string_view value = equals == std::string_view::npos ? std::string_view() : field.substr(equals + 1);
      if (key == "xyz") {
        body.pose.translation = three(key, value);
      } else if (key == "rpy") {
        angles = three(key, value);
      } else if (key == "scale" && is_mesh(body)) {
        const std::vector<double> s = numbers(key, value);
        if (s.size() != 1 && s.size() != 3)
          refuse("scale: " + std::to_string(s.size()) + " numbers, expected one or three");
        body.scale = s.size() == 1 ? Vec3::Constant(s[0]) : Vec3(s[0], s[1], s[2]);
      } else {
        refuse("'" + std::string(field) + "': expected xyz=X Y Z, rpy=R P Y" + (is_mesh(body) ? " or scale=S" : "") +
               ", in metres and radians");
      }
    }
    body.pose.rotation = rotation_of_rpy(angles);
    return body;
  }

 private:
  [[noreturn]] void refuse(const std::string& what) const { throw hinge::ModelError("--env '" + text_ + "': " + what); }

  /// Returns the text up to the next comma and removes it, with the comma, from `rest`.
  static std::string_view piece(std::string_view& rest) {
    const std::size_t comma = rest.find(',');
    const std::string_view first = rest.substr(0, comma);
    rest.remove_prefix(comma == std::string_view::npos ? rest.size() : comma + 1);
    return first;
  }

  std::vector<double> numbers(std::string_view what, std::string_view text) const {
    std::vector<double> found;
    while (true) {
      text.remove_prefix(std::min(text.find_first_not_of(' '), text.size()));
      if (text.empty()) return found;
      const std::string_view word = text.substr(0, text.find(' '));
      text.remove_prefix(word.size());
      double value = 0.0;
      const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
      if (error != std::errc{} || end != word.data() + word.size() || !(std::abs(value) <= hinge::tool::largest_length))
        refuse(std::string(what) + ": '" + std::string(word) + "', expected a finite number, at most 1e+09");
      found.push_back(value);
    }
  }
  std::vector<double> numbers(std::string_view what, std::string_view text, std::size_t count) const {
    std::vector<double> found = numbers(what, text);
    if (found.size() != count)
      refuse(std::string(what) + ": " + std::to_string(found.size()) + " numbers, expected " + std::to_string(count) +
             ", separated by blanks");
    return found;
  }
  Vec3 three(std::string_view what, std::string_view text) const {
    const std::vector<double> x = numbers(what, text, 3);
    return {x[0], x[1], x[2]};
  }

  void read_shape(std::string_view shape, Body& body) const {
    const std::size_t colon = shape.find(':');
    const std::string_view kind = shape.substr(0, colon);
    const std::string_view sizes = colon == std::string_view::npos ? std::string_view() : shape.substr(colon + 1);
    if (colon != std::string_view::npos && kind == "box") {
      body.primitive = BoxShape{three(kind, sizes)};
    } else if (colon != std::string_view::npos && kind == "sphere") {
      body.primitive = SphereShape{numbers(kind, sizes, 1)[0]};
    } else if (colon != std::string_view::npos && (kind == "cylinder" || kind == "capsule")) {
      const std::vector<double> x = numbers(kind, sizes, 2);
      if (kind == "cylinder")
        body.primitive = CylinderShape{x[0], x[1]};
      else
        body.primitive = CapsuleShape{x[0], x[1]};
    } else if (colon != std::string_view::npos && kind == "points") {
      const std::size_t blank = sizes.rfind(' ');
      if (blank == std::string_view::npos || blank == 0)
        refuse("points: '" + std::string(sizes) + "', expected points:FILE R");
      body.file = sizes.substr(0, blank);
      body.radius = numbers(kind, sizes.substr(blank), 1)[0];
    } else {
      body.file = shape;
    }
  }

  const std::string& text_;
};

}  // namespace

Body parse_body(const std::string& text) { return BodyReader(text).read(); }

Shape shape_of(const Body& body, std::vector<std::string>& notes) {
  if (body.primitive) return *body.primitive;
  if (body.radius)
    return PointCloudShape{std::make_shared<const std::vector<Vec3>>(read_points(body.file)), *body.radius};
  return MeshShape{std::make_shared<const TriangleMesh>(read_mesh(body.file, &notes)), body.scale, body.file};
}

}  // namespace robocd
