// SPDX-License-Identifier: BSD-3-Clause
// Implements read_ply. The header consists of text lines up to "end_header", in binary files too.
#include <algorithm>
#include <array>
#include <bit>
#include <cmath>

#include "description/parse_numbers.hpp"
#include "hinge/core/number_text.hpp"
#include "mesh/formats.hpp"

namespace hinge::robotics {

namespace {

struct Type {
  std::string_view name;
  char kind = 'f';  // i: signed, u: unsigned, f: floating point
  std::size_t size = 0;
};

constexpr std::array<Type, 16> types{{{"char", 'i', 1},
                                      {"int8", 'i', 1},
                                      {"uchar", 'u', 1},
                                      {"uint8", 'u', 1},
                                      {"short", 'i', 2},
                                      {"int16", 'i', 2},
                                      {"ushort", 'u', 2},
                                      {"uint16", 'u', 2},
                                      {"int", 'i', 4},
                                      {"int32", 'i', 4},
                                      {"uint", 'u', 4},
                                      {"uint32", 'u', 4},
                                      {"float", 'f', 4},
                                      {"float32", 'f', 4},
                                      {"double", 'f', 8},
                                      {"float64", 'f', 8}}};

double value_of(const Type& type, std::uint64_t bits) {
  const std::size_t unused = 64 - 8 * type.size;
  if (type.kind == 'u') return static_cast<double>(bits);
  if (type.kind == 'i') return static_cast<double>(static_cast<std::int64_t>(bits << unused) >> unused);
  if (type.size == 8) return std::bit_cast<double>(bits);
  return static_cast<double>(std::bit_cast<float>(static_cast<std::uint32_t>(bits)));
}

bool is_index(double value) { return value >= 0.0 && value == std::floor(value); }

struct Property {
  Type type;
  Type count;    // type of the number of values; size 0: one value, not a list
  char use = 0;  // x, y, z: coordinate of a vertex; i: vertex indices of a face; 0: skipped
};

struct Element {
  std::string_view name;
  std::size_t count = 0;
  std::size_t line = 0;  // in the header
  std::string missing;   // uses of properties that are not seen yet
  std::vector<Property> properties;
};

class PlyReader {
 public:
  PlyReader(std::string_view bytes, MeshBuilder& mesh) : size_(bytes.size()), rest_(bytes), mesh_(mesh) {}

  void run() {
    read_header();
    for (const Element& element : elements_) {
      element_ = &element;
      if (element.name == "edge") mesh_.leave_out(element.count);
      if (element.name == "tristrips") mesh_.refuse(element.line, "element tristrips is not supported, expected face");
      if (element.properties.empty()) continue;
      for (row_ = 0; row_ < element.count; ++row_) read_row();
    }
    if (is_text()) begin_row();
    if (is_text() ? !next_word(text_).empty() : !rest_.empty())
      mesh_.refuse(is_text() ? line_ : 0, "more follows the last element, expected the end");
  }

 private:
  bool is_text() const noexcept { return format_ == "ascii"; }

  void read_header() {
    while (!rest_.empty()) {
      std::string_view line = next_line(rest_);
      ++line_;
      if (line.find('\r') != std::string_view::npos)
        mesh_.refuse(line_, "the line holds a carriage return, expected \\n or \\r\\n at its end");
      const std::string_view word = next_word(line);
      if (line_ == 1 && word != "ply") mesh_.refuse(1, "expected the word ply");
      if (word == "end_header") return check_header();
      if (word == "format") format_ = next_word(line);
      if (word == "element") take_element(line);
      if (word == "property") take_property(line);
      constexpr std::array<std::string_view, 6> known{"ply", "format", "comment", "obj_info", "element", "property"};
      if (std::find(known.begin(), known.end(), word) == known.end())
        mesh_.refuse(line_, "not a line of a PLY header, expected end_header before it");
    }
    mesh_.refuse(0, "PLY header without end_header, the file may be cut short");
  }

  void take_element(std::string_view line) {
    const std::string_view name = next_word(line), text = next_word(line);
    if (!name.empty() && name.front() >= '0' && name.front() <= '9')
      mesh_.refuse(line_, "element has the name " + quoted(name) + ", expected a name that begins with a letter");
    const auto count = parse_number<std::size_t>(text);
    if (!count || *count > size_)
      mesh_.refuse(line_, "element " + std::string(name) + " has count " + quoted(text) +
                              ", expected a whole number that fits a file of " + std::to_string(size_) + " bytes");
    elements_.push_back({name, *count, line_, name == "vertex" ? "xyz" : name == "face" ? "i" : "", {}});
  }

  void take_property(std::string_view line) {
    const auto type_of = [&](std::string_view name) {
      const auto type = std::find_if(types.begin(), types.end(), [&](const Type& known) { return known.name == name; });
      if (type == types.end())
        mesh_.refuse(line_, "property has the type " + quoted(name) + ", expected a type of the PLY format");
      return *type;
    };
    if (elements_.empty()) mesh_.refuse(line_, "property without an element above it");
    Element& element = elements_.back();
    Property property;
    std::string_view type = next_word(line);
    if (type == "list") {
      property.count = type_of(next_word(line));
      type = next_word(line);
    }
    property.type = type_of(type);
    const std::string_view name = next_word(line);
    if (name.empty()) mesh_.refuse(line_, "property has no name");
    const bool is_list = property.count.size > 0;
    if (element.name == "vertex" && !is_list && (name == "x" || name == "y" || name == "z"))
      property.use = name.front();
    if (element.name == "face" && is_list && (name == "vertex_indices" || name == "vertex_index")) property.use = 'i';
    if (property.use != 0 && std::erase(element.missing, property.use) == 0)
      mesh_.refuse(line_, "is the second property " + std::string(name) + ", expected one");
    element.properties.push_back(property);
  }

  void check_header() const {
    if (!is_text() && format_ != "binary_little_endian" && format_ != "binary_big_endian")
      mesh_.refuse(0, "the PLY format is " + quoted(format_) + ", expected ascii or binary_(little|big)_endian");
    for (const Element& element : elements_)
      if (!element.missing.empty() && (element.name == "vertex" || element.count > 0))
        mesh_.refuse(element.line, "element " + std::string(element.name) + " has no property " +
                                       (element.name == "face" ? "list vertex_indices" : element.missing.substr(0, 1)));
  }

  void read_row() {
    if (is_text()) begin_row();
    Vec3 position = Vec3::Zero();
    polygon_.clear();
    for (const Property& property : element_->properties) {
      const double count = property.count.size > 0 ? next_value(property.count) : 1.0;
      if (!is_index(count)) refuse_row("has a list of " + number_text(count) + " values, expected a whole number");
      for (double k = 0.0; k < count; ++k) {
        const double value = next_value(property.type);
        if (property.use == 'i')
          polygon_.push_back(vertex(value));
        else if (property.use != 0)
          position[property.use - 'x'] = value;
      }
    }
    if (element_->name == "vertex") vertices_.push_back(position);
    if (element_->name == "face") mesh_.add_polygon(polygon_, is_text() ? line_ : 0);
  }

  /// Moves to the next line that is not blank. More values than the header says, at the end of a line, are skipped.
  void begin_row() {
    do {
      text_ = next_line(rest_);
      ++line_;
    } while (text_.find_first_not_of(" \t\r") == std::string_view::npos && !rest_.empty());
  }

  double next_value(const Type& type) {
    if (is_text()) {
      const std::string_view word = next_word(text_);
      const auto value = parse_number<double>(word);
      if (!value) refuse_row(word.empty() ? "has too few values" : "has " + quoted(word) + ", expected a number");
      return *value;
    }
    if (rest_.size() < type.size) refuse_row("is cut short: the file ends inside it");
    const std::uint64_t bits = load_bits(rest_.substr(0, type.size), format_ == "binary_big_endian");
    rest_.remove_prefix(type.size);
    return value_of(type, bits);
  }

  const Vec3& vertex(double index) const {
    if (!is_index(index) || index >= static_cast<double>(vertices_.size()))
      mesh_.refuse(0, "face " + std::to_string(row_) + " (from 0): it uses vertex " + number_text(index) +
                          " (from 0), but the mesh has " + std::to_string(vertices_.size()) + " vertices");
    return vertices_[static_cast<std::size_t>(index)];
  }

  [[noreturn]] void refuse_row(const std::string& what) const {
    mesh_.refuse(is_text() ? line_ : 0,
                 "element " + std::string(element_->name) + ": row " + std::to_string(row_) + " (from 0) " + what);
  }

  std::size_t size_;
  std::string_view rest_, text_;  // the rest of the file, and of the present line of text
  MeshBuilder& mesh_;
  std::size_t line_ = 0;
  std::string_view format_;
  std::vector<Element> elements_;
  const Element* element_ = nullptr;  // the present one
  std::size_t row_ = 0;               // of this element
  std::vector<Vec3> vertices_, polygon_;
};

}  // namespace

void read_ply(std::string_view bytes, MeshBuilder& mesh) { PlyReader(bytes, mesh).run(); }

}  // namespace hinge::robotics
