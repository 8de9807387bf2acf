// SPDX-License-Identifier: BSD-3-Clause
// Implements check_dae: one pass over the elements, and one over the nodes with their instances resolved.
#include "mesh/check_dae.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <map>
#include <set>
#include <string>
#include <string_view>
#include <system_error>
#include <utility>
#include <vector>

#include "description/read_xml.hpp"
#include "mesh/check_dae_mesh.hpp"

namespace hinge::robotics {

namespace {

using tinyxml2::XMLElement;

// Meshes of robots have about ten nodes on few levels. assimp and read_mesh traverse them by recursion.
constexpr std::size_t most_nodes = 1'000'000;
constexpr std::size_t deepest = 500;

bool is_whole_number(std::string_view word, std::int64_t largest) {
  std::int64_t value = 0;
  const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
  return error == std::errc{} && end == word.data() + word.size() && 0 <= value && value <= largest;
}

class DaeCheck {
 public:
  explicit DaeCheck(const std::filesystem::path& path)
      : file_(path, "COLLADA"), bytes_(static_cast<std::int64_t>(std::filesystem::file_size(path))) {}

  void run() {
    drop_what_is_no_shape();
    check_below(file_.root());
    for (const auto& [source, accessor] : accessors_) check_accessor(source, *accessor);
    for (const XMLElement* mesh : meshes_) check_dae_mesh(file_, *mesh, sources_, bytes_);
    for (const XMLElement* instance : instances_)
      if (geometries_.count(named_by(*instance, "url")) == 0) refuse_url(*instance, "<geometry>");
    for (const auto& [id, node] : nodes_) unfold(*node, 0);
    for (const XMLElement* scene : scenes_) unfold(*scene, 0);
  }

  std::string text() const { return file_.text(); }

 private:
  /// Deletes libraries that do not concern shapes. assimp reads them without checks, too.
  void drop_what_is_no_shape() {
    for (const char* library :
         {"library_animations", "library_animation_clips", "library_cameras", "library_controllers", "library_effects",
          "library_images", "library_lights", "library_materials"})
      while (tinyxml2::XMLElement* element = file_.root().FirstChildElement(library)) file_.root().DeleteChild(element);
  }

  /// Collects and checks all elements below. The recursion is bounded: tinyxml2 accepts at most 500 levels.
  void check_below(const XMLElement& element) {
    const std::string_view name = element.Name();
    for (const char* attribute : {"count", "offset", "stride"}) {
      const char* text = element.Attribute(attribute);
      if (text != nullptr && !is_whole_number(text, bytes_))
        file_.refuse(element.GetLineNum(), tag(element) + " has " + attribute + "=\"" + text +
                                               "\", expected a whole number that fits the size of the file");
    }
    if (name == "float_array" || name == "IDREF_array" || name == "Name_array") add_array(element);
    if (name == "accessor") accessors_.emplace_back(source_around(element), &element);
    if (name == "mesh") meshes_.push_back(&element);
    if (name == "geometry") geometries_.insert(text_of(element, "id"));
    if (name == "node" && element.Attribute("id") != nullptr) nodes_.emplace(element.Attribute("id"), &element);
    if (name == "visual_scene") scenes_.push_back(&element);
    if (name == "instance_geometry") instances_.push_back(&element);
    if (name == "instance_controller")
      file_.refuse(element.GetLineNum(), tag(element) + " deforms or blends a mesh, expected <instance_geometry>");
    for (const auto* child = element.FirstChildElement(); child != nullptr; child = child->NextSiblingElement())
      check_below(*child);
  }

  // assimp reads the range of an accessor without checking the length of the array.

  static std::string source_around(const XMLElement& element) {
    const auto* at = element.Parent();
    while (at != nullptr && at->ToElement() != nullptr && std::string_view(at->Value()) != "source") at = at->Parent();
    return at != nullptr && at->ToElement() != nullptr ? text_of(*at->ToElement(), "id") : std::string();
  }

  // check_below() has checked that the numbers are whole.

  void add_array(const XMLElement& element) {
    const std::int64_t count = element.Int64Attribute("count", -1);
    if (count < 0) file_.refuse(element.GetLineNum(), tag(element) + " has no count, expected a whole number");
    const bool of_numbers = std::string_view(element.Name()) == "float_array";
    if (!arrays_.emplace(text_of(element, "id"), of_numbers ? count : 0).second)
      file_.refuse(element.GetLineNum(),
                   tag(element) + " is the second array with id=\"" + text_of(element, "id") + "\", expected one");
  }
  void check_accessor(const std::string& source, const XMLElement& accessor) {
    if (!read_.insert(source).second)
      file_.refuse(accessor.GetLineNum(),
                   tag(accessor) + " is the second accessor of <source id=\"" + source + "\">, expected one");
    const auto array = arrays_.find(named_by(accessor, "source"));
    if (array == arrays_.end()) return;  // no such array: check_dae_mesh() refuses any use of the source
    const std::int64_t count = accessor.Int64Attribute("count", 0), offset = accessor.Int64Attribute("offset", 0),
                       stride = accessor.Int64Attribute("stride", 1);
    std::int64_t parameters = 0;
    std::array<int, 3> axes{};
    bool scalars = true;
    for (const auto* child = accessor.FirstChildElement("param"); child != nullptr;
         child = child->NextSiblingElement("param")) {
      ++parameters;
      const std::string name = text_of(*child, "name");
      if (name == "X" || name == "Y" || name == "Z") ++axes[static_cast<std::size_t>(name.front() - 'X')];
      scalars = scalars && text_of(*child, "type") != "float4x4";
    }
    // The offset is at most the file size, the other two are at most INT32_MAX, so the sum does not overflow.
    if (parameters > stride || count > INT32_MAX || stride > INT32_MAX || offset + count * stride > array->second)
      file_.refuse(accessor.GetLineNum(), tag(accessor) + " reaches beyond the " + std::to_string(array->second) +
                                              " numbers of '" + text_of(accessor, "source") + "'");
    if (scalars && parameters <= 4) sources_.emplace(source, axes == std::array{1, 1, 1});
  }

  struct Extent {
    std::size_t nodes = 1;
    std::size_t height = 0;  // levels below the element
  };

  /// Returns the size of an element with all its instances resolved.
  Extent unfold(const XMLElement& element, std::size_t depth) {
    const auto known = extents_.find(&element);
    Extent extent = known != extents_.end() ? known->second : Extent{};
    if (depth + extent.height > deepest)
      file_.refuse(element.GetLineNum(),
                   tag(element) + ": its nodes contain themselves or are nested more than 500 levels deep");
    if (known != extents_.end()) return extent;
    for (const auto* child = element.FirstChildElement(); child != nullptr; child = child->NextSiblingElement()) {
      const std::string_view name = child->Name();
      const bool instance = name == "instance_node";
      const auto target = instance ? nodes_.find(named_by(*child, "url")) : nodes_.end();
      if (instance && target == nodes_.end()) refuse_url(*child, "<node>");
      const XMLElement* below = name == "node" ? child : target != nodes_.end() ? target->second : nullptr;
      if (below == nullptr) continue;
      const Extent inner = unfold(*below, depth + 1);
      extent.nodes += inner.nodes;
      extent.height = std::max(extent.height, inner.height + 1);
      if (extent.nodes > most_nodes)
        file_.refuse(element.GetLineNum(), tag(element) + ": it expands to more than 10^6 nodes");
    }
    extents_[&element] = extent;
    return extent;
  }

  [[noreturn]] void refuse_url(const XMLElement& element, const std::string& expected) const {
    file_.refuse(element.GetLineNum(), tag(element) + " has url=\"" + text_of(element, "url") + "\", expected a " +
                                           expected + " of this file");
  }

  XmlFile file_;
  std::int64_t bytes_;
  std::map<std::string, const XMLElement*, std::less<>> nodes_;  // by id
  std::vector<const XMLElement*> scenes_;
  std::vector<const XMLElement*> meshes_, instances_;                 // instances of geometries
  std::set<std::string, std::less<>> geometries_;                     // ids
  std::map<std::string, std::int64_t, std::less<>> arrays_;           // by id: number of values
  std::vector<std::pair<std::string, const XMLElement*>> accessors_;  // with the id of their source
  std::set<std::string> read_;                                        // ids of sources with an accessor
  DaeSources sources_;
  std::map<const XMLElement*, Extent> extents_;
};

}  // namespace

std::string check_dae(const std::filesystem::path& path) {
  DaeCheck check(path);
  check.run();
  return check.text();
}

}  // namespace hinge::robotics
