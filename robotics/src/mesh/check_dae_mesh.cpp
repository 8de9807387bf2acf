// SPDX-License-Identifier: BSD-3-Clause
// Checks the elements in the order of the file, as assimp reads them: elements after <p> do not apply to it.
#include "mesh/check_dae_mesh.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <string_view>
#include <system_error>
#include <vector>

namespace hinge::robotics {

namespace {

using tinyxml2::XMLElement;

/// Visits every element below. The recursion is bounded: tinyxml2 accepts at most 500 levels.
template <class Visit>
void for_each_below(const XMLElement& element, const Visit& visit) {
  for (const auto* child = element.FirstChildElement(); child != nullptr; child = child->NextSiblingElement()) {
    visit(*child);
    for_each_below(*child, visit);
  }
}

class MeshCheck {
 public:
  MeshCheck(const XmlFile& file, const DaeSources& sources, std::int64_t room)
      : file_(file), sources_(sources), room_(room) {}

  void run(const XMLElement& mesh) {
    constexpr std::array<std::string_view, 7> primitives{"triangles", "lines",   "linestrips", "polygons",
                                                         "polylist",  "trifans", "tristrips"};
    for_each_below(mesh, [&](const XMLElement& element) {
      const std::string_view name = element.Name();
      if (name == "vertices") take_vertices(element);
      if (std::find(primitives.begin(), primitives.end(), name) != primitives.end()) check_primitives(element);
    });
  }

 private:
  [[noreturn]] void refuse(const XMLElement& element, const std::string& what) const {
    file_.refuse(element.GetLineNum(), tag(element) + what);
  }

  void take_vertices(const XMLElement& vertices) {
    vertices_ = text_of(vertices, "id");
    for (const auto* input = vertices.FirstChildElement("input"); input != nullptr;
         input = input->NextSiblingElement("input")) {
      const bool has_xyz = source_of(*input);
      if (text_of(*input, "semantic") != "POSITION") continue;
      if (!has_xyz) refuse(*input, " has source=\"" + text_of(*input, "source") + "\", which has no X, Y and Z");
      if (++positions_ > 1) refuse(*input, " is the second POSITION of one <mesh>, expected one");
    }
  }

  bool source_of(const XMLElement& input) const {
    const auto source = sources_.find(named_by(input, "source"));
    if (source == sources_.end())
      refuse(input, " has source=\"" + text_of(input, "source") +
                        "\", expected a <source> of numbers with at most four components");
    return source->second;
  }

  /// The layout of indices, from the elements above <p>.
  struct Layout {
    std::int64_t count = 0;    // number of primitives; DaeCheck has checked that it is a number
    std::int64_t offsets = 1;  // indices per vertex
    std::int64_t others = 1;   // the same, counting only inputs that assimp does not know
    bool has_vertex = false;
    std::int64_t corners = -1;  // sum of <vcount>; -1: none
  };

  void check_primitives(const XMLElement& element) const {
    Layout layout;
    layout.count = element.Int64Attribute("count", 0);
    for_each_below(element, [&](const XMLElement& part) {
      const std::string_view name = part.Name();
      if (name == "input") take_input(part, layout);
      if (name == "vcount") take_vcount(part, layout);
      if (name == "p") check_indices(element, part, layout);
    });
  }

  void take_input(const XMLElement& input, Layout& layout) const {
    constexpr std::array<std::string_view, 9> semantics{"VERTEX",   "POSITION",    "NORMAL",  "TEXCOORD",  "COLOR",
                                                        "BINORMAL", "TEXBINORMAL", "TANGENT", "TEXTANGENT"};
    const std::string semantic = text_of(input, "semantic");
    const bool known = std::find(semantics.begin(), semantics.end(), semantic) != semantics.end();
    std::int64_t& offsets = known ? layout.offsets : layout.others;
    offsets = std::max(offsets, input.Int64Attribute("offset", 0) + 1);
    if (semantic != "VERTEX") {
      source_of(input);
      return;
    }
    if (layout.has_vertex) refuse(input, " is the second VERTEX of one element, expected one");
    layout.has_vertex = true;
    if (named_by(input, "source") != vertices_)
      refuse(input, " has source=\"" + text_of(input, "source") + "\", expected the <vertices> above");
  }

  void take_vcount(const XMLElement& vcount, Layout& layout) const {
    if (layout.corners >= 0) refuse(vcount, " is the second <vcount> of one element, expected one");
    layout.corners = 0;
    std::int64_t polygons = 0;
    for_each_number(vcount, [&](std::int64_t number) {
      if (polygons++ < layout.count) layout.corners += number;
    });
    if (polygons < layout.count)
      refuse(vcount, " holds " + std::to_string(polygons) + " numbers, expected " + std::to_string(layout.count));
  }

  void check_indices(const XMLElement& element, const XMLElement& p, const Layout& layout) const {
    const std::string_view kind = element.Name();
    const std::int64_t count = layout.count, offsets = layout.offsets, corners = layout.corners;
    std::int64_t indices = 0;
    for_each_number(p, [&](std::int64_t) { ++indices; });
    if (indices == 0 && count == 0) return;
    if (count == 0) refuse(element, " has indices, but no count, expected the number of primitives");
    if (kind == "trifans") refuse(element, " is not supported, expected <triangles>");
    if (positions_ == 0) refuse(p, " has no <vertices> with a POSITION above it");
    if (!layout.has_vertex) refuse(p, " has no <input> with semantic=\"VERTEX\" above it");
    if (layout.others > offsets)  // assimp ignores this input and misreads its indices
      refuse(p, " has an <input> with an unknown semantic and the largest offset, expected a known semantic");
    if (kind == "polylist" && corners < 0) refuse(p, " has no <vcount> above it");
    const auto expect = [&](bool right, const std::string& what) {
      if (!right)
        refuse(p, " holds " + std::to_string(indices) + " indices, expected " + std::to_string(offsets) +
                      " for each of " + what + " vertices");
    };
    // Divide instead of multiplying: counts and offsets are below the file size, but products may overflow.
    if (kind == "triangles")
      expect(indices % offsets == 0 && indices / offsets == 3 * count, std::to_string(3 * count));
    if (kind == "polylist") expect(indices % offsets == 0 && indices / offsets == corners, std::to_string(corners));
    if (kind == "lines")  // SketchUp writes too small a count, and assimp reads all indices
      expect(indices % (2 * offsets) == 0 && count <= room_ / (2 * offsets), std::to_string(2 * count));
    const std::int64_t fewest = kind == "tristrips" ? 3 : kind == "linestrips" ? 2 : 0;
    expect(indices % offsets == 0 && indices / offsets >= fewest, std::to_string(fewest) + " or more");
  }

  /// Calls visit(number) for each number in the text of an element.
  template <class Visit>
  void for_each_number(const XMLElement& element, const Visit& visit) const {
    constexpr std::string_view blanks = " \t\r\n";
    std::string_view text;
    for (const auto* child = element.FirstChild(); child != nullptr; child = child->NextSibling()) {
      if (child->ToComment() != nullptr) continue;
      if (child->ToText() == nullptr || !text.empty())  // assimp reads the first text only
        refuse(element, " holds more than one text, expected one list of whole numbers");
      text = child->Value();
    }
    for (std::size_t start = text.find_first_not_of(blanks); start != std::string_view::npos;
         start = text.find_first_not_of(blanks)) {
      text.remove_prefix(start);
      const std::string_view word = text.substr(0, text.find_first_of(blanks));
      text.remove_prefix(word.size());
      std::int64_t number = 0;
      const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), number);
      if (error != std::errc{} || end != word.data() + word.size() || number < 0 || number > INT32_MAX)
        refuse(element, " holds '" + std::string(word) + "', expected whole numbers >= 0");
      visit(number);
    }
  }

  const XmlFile& file_;
  const DaeSources& sources_;
  std::int64_t room_;
  std::string vertices_;        // id of the last <vertices>
  std::int64_t positions_ = 0;  // number of POSITION inputs
};

}  // namespace

std::string named_by(const XMLElement& element, const char* attribute) {
  const std::string url = text_of(element, attribute);
  return url.starts_with('#') ? url.substr(1) : std::string();
}

void check_dae_mesh(const XmlFile& file, const XMLElement& mesh, const DaeSources& sources, std::int64_t room) {
  MeshCheck(file, sources, room).run(mesh);
}

}  // namespace hinge::robotics
