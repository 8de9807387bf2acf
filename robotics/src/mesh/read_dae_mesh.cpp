// SPDX-License-Identifier: BSD-3-Clause
// Implements read_dae_mesh, in the order of the file: elements below <p> do not apply to it.
#include <algorithm>
#include <array>
#include <numeric>
#include <optional>
#include <string_view>

#include "mesh/dae_file.hpp"

namespace hinge::robotics {

namespace {

using tinyxml2::XMLElement;

class MeshReader {
 public:
  MeshReader(const DaeFile& file, DaeMesh& result) : file_(file), mesh_(result) {}

  void run(const XMLElement& mesh) {
    constexpr std::array<std::string_view, 7> primitives{"triangles", "lines",   "linestrips", "polygons",
                                                         "polylist",  "trifans", "tristrips"};
    for (const auto* child = mesh.FirstChildElement(); child != nullptr; child = child->NextSiblingElement()) {
      const std::string_view name = child->Name();
      if (name == "vertices")
        take_vertices(*child);
      else if (std::find(primitives.begin(), primitives.end(), name) != primitives.end())
        take_primitives(*child);
      else if (name != "source" && name != "extra")
        file_.refuse(*child, " is not supported in <mesh>, expected <triangles>");
    }
  }

 private:
  void take_vertices(const XMLElement& vertices) {
    vertices_ = text_of(vertices, "id");
    for (const auto* input = vertices.FirstChildElement("input"); input != nullptr;
         input = input->NextSiblingElement("input")) {
      if (text_of(*input, "semantic") != "POSITION") continue;
      if (positions_) file_.refuse(*input, " is the second POSITION of one <mesh>, expected one");
      positions_ = positions_of(*input, file_.find(*input, "source", "source"));
    }
  }

  std::vector<Vec3> positions_of(const XMLElement& input, const XMLElement& source) const {
    const auto* technique = source.FirstChildElement("technique_common");
    const auto* accessor = technique != nullptr ? technique->FirstChildElement("accessor") : nullptr;
    if (accessor == nullptr) file_.refuse(source, " has no <technique_common> with an <accessor>");
    if (const auto* second = accessor->NextSiblingElement("accessor"))
      file_.refuse(*second, " is the second accessor of <source id=\"" + text_of(source, "id") + "\">, expected one");
    const XMLElement& array = file_.find(*accessor, "source", "float_array");
    const std::size_t announced = file_.whole(array, "count"), count = file_.whole(*accessor, "count", 0),
                      offset = file_.whole(*accessor, "offset", 0), stride = file_.whole(*accessor, "stride", 1);
    std::array<std::size_t, 3> axes{}, found{};
    std::size_t parameters = 0;
    for (const auto* p = accessor->FirstChildElement("param"); p != nullptr; p = p->NextSiblingElement("param")) {
      const std::string name = text_of(*p, "name"), type = text_of(*p, "type");
      if ((name == "X" || name == "Y" || name == "Z") && type != "float4x4") {
        const auto axis = static_cast<std::size_t>(name.front() - 'X');
        axes[axis] = parameters;
        ++found[axis];
      }
      parameters += type == "float4x4" ? 16 : 1;
    }
    if (found != std::array<std::size_t, 3>{1, 1, 1})
      file_.refuse(input, " has source=\"" + text_of(input, "source") + "\", which has no X, Y and Z");
    // Division, because a product may overflow.
    if (parameters > stride || offset > announced || count > (announced - offset) / stride)
      file_.refuse(*accessor, " reaches beyond the " + std::to_string(announced) + " numbers of '" +
                                  text_of(*accessor, "source") + "'");
    const std::vector<double> numbers = file_.numbers(array, announced);
    std::vector<Vec3> positions;
    for (std::size_t at = offset; positions.size() < count; at += stride)
      positions.emplace_back(numbers[at + axes[0]], numbers[at + axes[1]], numbers[at + axes[2]]);
    return positions;
  }

  /// The layout of indices, from the elements above <p>.
  struct Layout {
    std::size_t count = 0;              // number of primitives
    std::size_t offsets = 1;            // indices per vertex
    std::optional<std::size_t> vertex;  // which of them is that of the position
    std::optional<std::vector<std::size_t>> vcount;
  };

  void take_primitives(const XMLElement& element) {
    Layout layout;
    layout.count = file_.whole(element, "count", 0);
    for (const auto* part = element.FirstChildElement(); part != nullptr; part = part->NextSiblingElement()) {
      const std::string_view name = part->Name();
      if (name == "input")
        take_input(*part, layout);
      else if (name == "vcount")
        take_vcount(*part, layout);
      else if (name == "p")
        take_indices(element, *part, layout);
      else if (name != "extra")
        file_.refuse(*part, " is not supported in " + tag(element) + ", expected <p>");
    }
  }

  void take_input(const XMLElement& input, Layout& layout) const {
    const std::size_t offset = file_.whole(input, "offset", 0);
    layout.offsets = std::max(layout.offsets, offset + 1);
    const std::string semantic = text_of(input, "semantic"), source = text_of(input, "source");
    if (semantic == "POSITION") file_.refuse(input, " has semantic=\"POSITION\", expected it in <vertices> only");
    if (semantic != "VERTEX") return;
    if (layout.vertex) file_.refuse(input, " is the second VERTEX of one element, expected one");
    layout.vertex = offset;
    if (source != "#" + vertices_) file_.refuse(input, " has source=\"" + source + "\", expected the <vertices> above");
  }

  void take_vcount(const XMLElement& vcount, Layout& layout) const {
    if (layout.vcount) file_.refuse(vcount, " is the second <vcount> of one element, expected one");
    layout.vcount = file_.whole_numbers(vcount);
    if (layout.vcount->size() < layout.count)
      file_.refuse(vcount, " holds " + std::to_string(layout.vcount->size()) + " numbers, expected " +
                               std::to_string(layout.count));
    layout.vcount->resize(layout.count);
  }

  void take_indices(const XMLElement& element, const XMLElement& p, const Layout& layout) {
    const std::string_view kind = element.Name();
    const std::vector<std::size_t> indices = file_.whole_numbers(p);
    if (indices.empty() && layout.count == 0) return;
    if (layout.count == 0) file_.refuse(element, " has indices, but no count, expected the number of primitives");
    if (!positions_) file_.refuse(p, " has no <vertices> with a POSITION above it");
    if (!layout.vertex) file_.refuse(p, " has no <input> with semantic=\"VERTEX\" above it");
    if (kind == "polylist" && !layout.vcount) file_.refuse(p, " has no <vcount> above it");
    const std::size_t corners = indices.size() / layout.offsets;
    const auto expect = [&](bool right, const std::string& what) {
      if (!right || indices.size() % layout.offsets != 0)
        file_.refuse(p, " holds " + std::to_string(indices.size()) + " indices, expected " +
                            std::to_string(layout.offsets) + " for each of " + what + " vertices");
    };
    if (kind == "triangles") {
      expect(corners == 3 * layout.count, std::to_string(3 * layout.count));
    } else if (kind == "polylist") {
      const std::size_t sum = std::accumulate(layout.vcount->begin(), layout.vcount->end(), std::size_t{0});
      expect(corners == sum, std::to_string(sum));
    } else if (kind == "lines") {  // SketchUp writes a wrong count of them
      expect(corners % 2 == 0, std::to_string(2 * layout.count));
      mesh_.lines += corners / 2;
      return;
    } else {  // one polygon, strip or fan in each <p>
      const std::size_t fewest = kind == "linestrips" ? 2 : kind == "polygons" ? 0 : 3;
      expect(corners >= fewest, std::to_string(fewest) + " or more");
    }
    if (kind == "linestrips")
      mesh_.lines += corners - 1;
    else
      add_polygons(kind, p, layout, indices);
  }

  void add_polygons(std::string_view kind, const XMLElement& p, const Layout& layout,
                    const std::vector<std::size_t>& indices) {
    const auto add = [&](std::size_t corner) {
      const std::size_t index = indices[corner * layout.offsets + *layout.vertex];
      if (index >= positions_->size())
        file_.refuse(p, " uses vertex " + std::to_string(index) + " (from 0), but there are " +
                            std::to_string(positions_->size()));
      mesh_.corners.push_back((*positions_)[index]);
    };
    const std::size_t corners = indices.size() / layout.offsets;
    if (kind == "tristrips" || kind == "trifans") {
      for (std::size_t k = 0; k + 2 < corners; ++k) {
        // Every second triangle of a strip is turned over, so that all face one side.
        add(kind == "trifans" ? 0 : k + k % 2);
        add(kind == "trifans" ? k + 1 : k + 1 - k % 2);
        add(k + 2);
        mesh_.ends.push_back(mesh_.corners.size());
      }
      return;
    }
    std::size_t end = mesh_.corners.size();
    for (std::size_t k = 0; k < corners; ++k) add(k);
    if (kind == "polylist")
      for (const std::size_t number : *layout.vcount) mesh_.ends.push_back(end += number);
    else if (kind == "triangles")
      while (end < mesh_.corners.size()) mesh_.ends.push_back(end += 3);
    else
      mesh_.ends.push_back(mesh_.corners.size());
  }

  const DaeFile& file_;
  DaeMesh& mesh_;
  std::string vertices_;  // id of the last <vertices>
  std::optional<std::vector<Vec3>> positions_;
};

}  // namespace

void read_dae_mesh(const DaeFile& file, const XMLElement& mesh, DaeMesh& result) { MeshReader(file, result).run(mesh); }

}  // namespace hinge::robotics
