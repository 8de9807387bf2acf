// SPDX-License-Identifier: BSD-3-Clause
// Implements read_obj. tinyobjloader is not used: it takes coordinates that are missing or no numbers for 0, and passes
// on indices beyond the vertices.
#include <algorithm>
#include <array>

#include "description/parse_numbers.hpp"
#include "mesh/formats.hpp"

namespace hinge::robotics {

namespace {

class ObjReader {
 public:
  ObjReader(std::string_view bytes, MeshBuilder& mesh) : rest_(bytes), mesh_(mesh) {}

  void run() {
    constexpr std::array<std::string_view, 10> without_surface{"vn", "vt", "vp",     "g",      "o",
                                                               "s",  "mg", "usemtl", "mtllib", "lod"};
    std::size_t unknown = 0;
    std::string first_unknown;
    if (rest_.starts_with("\xEF\xBB\xBF")) rest_.remove_prefix(3);  // byte order mark of UTF-8
    while (!rest_.empty()) {
      std::string_view line = next_statement();
      const std::string_view word = next_word(line);
      if (word == "v")
        take_vertex(line);
      else if (word == "f" || word == "fo")
        take_face(line);
      else if (word == "l" || word == "p")
        leave_out(word, line);
      else if (word == "surf")
        mesh_.refuse(line_, "surf is a free-form surface, expected polygons");
      else if (!word.empty() &&
               std::find(without_surface.begin(), without_surface.end(), word) == without_surface.end() &&
               unknown++ == 0)
        first_unknown = quoted(word) + " in line " + std::to_string(line_);
    }
    if (unknown > 0)
      mesh_.note(std::to_string(unknown) + " statements are unknown and were skipped, the first is " + first_unknown);
    add_faces();
  }

 private:
  /// Returns the next line without its comment, joined with the lines after it while it ends with a backslash.
  std::string_view next_statement() {
    joined_.clear();
    while (true) {
      const std::string_view whole = next_line(rest_), line = whole.substr(0, whole.find('#'));
      ++line_;
      const bool goes_on = line.ends_with('\\') && line.size() == whole.size() && !rest_.empty();
      if (!goes_on && joined_.empty()) return line;
      joined_.append(line.substr(0, line.size() - (goes_on ? 1 : 0))) += ' ';
      if (!goes_on) return joined_;
    }
  }

  void take_vertex(std::string_view line) {
    std::array<double, 6> x{};
    std::size_t count = 0;
    for (std::string_view word = next_word(line); !word.empty(); word = next_word(line), ++count) {
      const auto value = parse_number<double>(word);
      if (!value) mesh_.refuse(line_, "v has " + quoted(word) + ", expected numbers");
      if (count < x.size()) x[count] = *value;
    }
    if (count != 3 && count != 4 && count != 6)
      mesh_.refuse(line_, "v has " + std::to_string(count) + " numbers, expected 3, 4 (weight) or 6 (colour)");
    const double weight = count == 4 ? x[3] : 1.0;
    if (weight == 0.0) mesh_.refuse(line_, "v has the weight 0, expected another number");
    vertices_.emplace_back(x[0] / weight, x[1] / weight, x[2] / weight);
  }

  /// Negative indices count back from the last vertex above. Positive ones may refer to vertices below.
  void take_face(std::string_view line) {
    const std::size_t first = corners_.size();
    const auto known = static_cast<std::int64_t>(vertices_.size());
    for (std::string_view word = next_word(line); !word.empty(); word = next_word(line)) {
      const auto index = parse_number<std::int64_t>(word.substr(0, word.find('/')));
      if (!index || *index == 0 || *index < -known)
        mesh_.refuse(line_, "f has " + quoted(word) + ", expected a vertex from 1, or from -1 back to -" +
                                std::to_string(known));
      corners_.push_back(static_cast<std::size_t>(*index > 0 ? *index - 1 : known + *index));
    }
    if (corners_.size() == first) mesh_.refuse(line_, "f has no vertices");
    faces_.push_back({line_, corners_.size()});
  }

  void leave_out(std::string_view kind, std::string_view line) {
    std::size_t vertices = 0;
    while (!next_word(line).empty()) ++vertices;
    mesh_.leave_out(kind == "l" && vertices > 1 ? vertices - 1 : vertices);
  }

  void add_faces() {
    std::vector<Vec3> polygon;
    std::size_t corner = 0;
    for (const Face& face : faces_) {
      polygon.clear();
      for (; corner < face.end; ++corner) {
        if (corners_[corner] >= vertices_.size())
          mesh_.refuse(face.line, "f uses vertex " + std::to_string(corners_[corner] + 1) + ", but the file has " +
                                      std::to_string(vertices_.size()) + " vertices");
        polygon.push_back(vertices_[corners_[corner]]);
      }
      mesh_.add_polygon(polygon, face.line);
    }
  }

  struct Face {
    std::size_t line = 0;
    std::size_t end = 0;  // of its corners; they begin at the end of the face before
  };

  std::string_view rest_;
  MeshBuilder& mesh_;
  std::string joined_;
  std::size_t line_ = 0;
  std::vector<Vec3> vertices_;
  std::vector<std::size_t> corners_;  // indices of vertices, from 0
  std::vector<Face> faces_;
};

}  // namespace

void read_obj(std::string_view bytes, MeshBuilder& mesh) { ObjReader(bytes, mesh).run(); }

}  // namespace hinge::robotics
