// SPDX-License-Identifier: BSD-3-Clause
// Implements read_stl. A binary STL file has 84 + 50 n bytes, with n in little-endian order at byte 80.
#include <array>
#include <bit>
#include <cstdint>

#include "description/parse_numbers.hpp"
#include "mesh/formats.hpp"

namespace hinge::robotics {

namespace {

constexpr std::size_t header_size = 84;
constexpr std::size_t facet_size = 50;  // normal and three vertices of three floats each, two bytes of attributes

void read_binary(std::string_view facets, MeshBuilder& mesh) {
  for (; !facets.empty(); facets.remove_prefix(facet_size)) {
    std::array<Vec3, 3> corners;
    for (std::size_t k = 0; k < 9; ++k) {
      const auto bits = static_cast<std::uint32_t>(load_bits(facets.substr(12 + 4 * k, 4)));
      corners[k / 3][static_cast<int>(k % 3)] = static_cast<double>(std::bit_cast<float>(bits));
    }
    mesh.add_polygon(corners);
  }
}

class TextReader {
 public:
  TextReader(std::string_view bytes, MeshBuilder& mesh) : rest_(bytes), mesh_(mesh) {}

  void run() {
    for (std::string_view solid = next(); !solid.empty(); solid = next()) {
      if (solid != "solid") refuse(solid, "solid or the end of the file");
      skip_line();  // the name
      for (std::string_view word = next(); word != "endsolid"; word = next()) {
        if (word.empty()) refuse_end();
        if (word != "facet") refuse(word, "facet or endsolid");
        read_facet();
      }
      skip_line();
    }
  }

 private:
  void read_facet() {
    expect("normal");
    ++facets_;
    for (int k = 0; k < 3; ++k) next();  // some programs write nan for facets without area
    const std::size_t line = line_;
    expect("outer");
    expect("loop");
    std::array<Vec3, 3> corners;
    for (Vec3& corner : corners) {
      expect("vertex");
      for (double& x : corner) {
        const std::string_view word = next();
        if (word.empty()) refuse_end();
        const auto value = parse_number<double>(word);
        if (!value) refuse(word, "a number");
        x = *value;
      }
    }
    expect("endloop");
    expect("endfacet");
    ++ends_;
    mesh_.add_polygon(corners, line);
  }

  std::string_view next() {
    const char* before = rest_.data();
    const std::string_view word = next_word(rest_);
    line_ += static_cast<std::size_t>(std::count(before, word.data(), '\n'));
    return word;
  }
  void skip_line() { rest_.remove_prefix(std::min(rest_.find('\n'), rest_.size())); }
  void expect(std::string_view wanted) {
    const std::string_view word = next();
    if (word == wanted) return;
    if (rest_.empty() && wanted.starts_with(word)) refuse_end();  // cut short, maybe in the word
    refuse(word, std::string(wanted));
  }
  [[noreturn]] void refuse(std::string_view word, const std::string& expected) const {
    mesh_.refuse(line_, quoted(word) + ", expected " + expected);
  }
  [[noreturn]] void refuse_end() const {
    mesh_.refuse(0, "text STL with " + std::to_string(facets_) + " facets, of which " + std::to_string(ends_) +
                        " have an endfacet, and no endsolid: the file is cut short or damaged");
  }

  std::string_view rest_;
  MeshBuilder& mesh_;
  std::size_t line_ = 1, facets_ = 0, ends_ = 0;
};

}  // namespace

void read_stl(std::string_view bytes, MeshBuilder& mesh) {
  std::size_t announced = 0;
  if (bytes.size() >= header_size) {
    announced = load_bits(bytes.substr(80, 4));
    if (bytes.size() == header_size + facet_size * announced) return read_binary(bytes.substr(header_size), mesh);
  }
  // "solid" alone is no evidence: many binary files begin with it.
  if (bytes.starts_with("solid") &&
      (bytes.find("facet") != std::string_view::npos || bytes.find("endsolid") != std::string_view::npos))
    return TextReader(bytes, mesh).run();
  if (bytes.size() < header_size)
    mesh.refuse(0, std::to_string(bytes.size()) + " bytes, expected at least the 84 of a binary STL");
  mesh.refuse(0, "the header of the binary STL gives " + std::to_string(announced) + " triangles, which need " +
                     std::to_string(header_size + facet_size * announced) + " bytes; the file has " +
                     std::to_string(bytes.size()));
}

}  // namespace hinge::robotics
