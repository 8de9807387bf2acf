// SPDX-License-Identifier: BSD-3-Clause
// One pass over the elements, and one over the nodes as they unfold.
#include "check_dae.hpp"

#include <algorithm>
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

#include "read_xml.hpp"

namespace hinge::robotics {

namespace {

using tinyxml2::XMLElement;

// Scenes of robots' meshes have some ten nodes, few levels deep. assimp and read_mesh walk them by recursion.
constexpr std::size_t most_nodes = 1'000'000;
constexpr std::size_t deepest = 500;

bool is_whole_number(std::string_view word, std::int64_t lowest, std::int64_t largest) {
  std::int64_t value = 0;
  const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
  return error == std::errc{} && end == word.data() + word.size() && lowest <= value && value <= largest;
}

class DaeCheck {
 public:
  explicit DaeCheck(const std::filesystem::path& path)
      : file_(path, "COLLADA"), bytes_(static_cast<std::int64_t>(std::filesystem::file_size(path))) {}

  void run() {
    check_below(file_.root());
    for (const auto& [source, accessor] : accessors_) check_accessor(source, *accessor);
    for (const XMLElement* input : inputs_) check_input(*input);
    for (const auto& [id, node] : nodes_) unfold(*node, 0);
    for (const XMLElement* scene : scenes_) unfold(*scene, 0);
  }

 private:
  /// tinyxml2 takes no file of more than 500 levels.
  void check_below(const XMLElement& element) {
    const std::string_view name = element.Name();
    for (const char* attribute : {"count", "offset", "stride"}) {
      const char* text = element.Attribute(attribute);
      if (text != nullptr && !is_whole_number(text, 0, bytes_))
        file_.refuse(element.GetLineNum(), tag(element) + " has " + attribute + "=\"" + text +
                                               "\", expected a whole number the file has room for");
    }
    if (name == "p" || name == "h" || name == "v" || name == "vcount") check_indices(element);
    if (name == "float_array") add_array(element);
    if (name == "accessor") accessors_.emplace_back(source_around(element), &element);
    if (name == "vertices") vertices_.insert(text_of(element, "id"));
    if (name == "input" && is_of_mesh(element)) inputs_.push_back(&element);
    if (name == "node" && element.Attribute("id") != nullptr) nodes_.emplace(element.Attribute("id"), &element);
    if (name == "visual_scene") scenes_.push_back(&element);
    for (const auto* child = element.FirstChildElement(); child != nullptr; child = child->NextSiblingElement())
      check_below(*child);
  }

  void check_indices(const XMLElement& element) const {
    constexpr std::string_view blanks = " \t\r\n";
    std::string_view text;
    for (const auto* child = element.FirstChild(); child != nullptr; child = child->NextSibling()) {
      if (child->ToComment() != nullptr) continue;
      if (child->ToText() == nullptr || !text.empty())  // assimp reads the first text, wherever it stands
        file_.refuse(element.GetLineNum(), tag(element) + " holds more than one row of whole numbers");
      text = child->Value();
    }
    for (std::size_t start = text.find_first_not_of(blanks); start != std::string_view::npos;
         start = text.find_first_not_of(blanks)) {
      text.remove_prefix(start);
      const std::string_view word = text.substr(0, text.find_first_of(blanks));
      text.remove_prefix(word.size());
      if (!is_whole_number(word, -1, INT32_MAX))
        file_.refuse(element.GetLineNum(), tag(element) + " holds '" + std::string(word) + "', expected whole numbers");
    }
  }

  // assimp looks up what an accessor of a mesh says, whether or not the array has it.

  static std::string text_of(const XMLElement& element, const char* attribute) {
    const char* text = element.Attribute(attribute);
    return text != nullptr ? text : "";
  }
  /// The id in source="#id".
  static std::string named_by(const XMLElement& element) {
    const std::string url = text_of(element, "source");
    return url.empty() ? url : url.substr(1);
  }
  static std::string source_around(const XMLElement& element) {
    const auto* at = element.Parent();
    while (at != nullptr && at->ToElement() != nullptr && std::string_view(at->Value()) != "source") at = at->Parent();
    return at != nullptr && at->ToElement() != nullptr ? text_of(*at->ToElement(), "id") : std::string();
  }
  static bool is_of_mesh(const XMLElement& input) {
    const auto* parent = input.Parent() != nullptr ? input.Parent()->Parent() : nullptr;
    return parent != nullptr && parent->ToElement() != nullptr && std::string_view(parent->Value()) == "mesh";
  }

  // Whole numbers were seen by check_below().

  void add_array(const XMLElement& element) {
    const std::int64_t count = element.Int64Attribute("count", -1);
    if (count < 0) file_.refuse(element.GetLineNum(), tag(element) + " has no count");
    const auto [at, is_new] = arrays_.emplace(text_of(element, "id"), count);
    if (!is_new) at->second = std::min(at->second, count);
  }
  void check_accessor(const std::string& source, const XMLElement& accessor) {
    if (!read_.insert(source).second)
      file_.refuse(accessor.GetLineNum(), tag(accessor) + " is not the only one of <source id=\"" + source + "\">");
    const auto array = arrays_.find(named_by(accessor));
    if (array == arrays_.end()) return;  // of names, or of none: see check_input()
    const std::int64_t count = accessor.Int64Attribute("count", 0), offset = accessor.Int64Attribute("offset", 0),
                       stride = accessor.Int64Attribute("stride", 1);
    std::int64_t parameters = 0;
    for (const auto* child = accessor.FirstChildElement("param"); child != nullptr;
         child = child->NextSiblingElement("param"))
      ++parameters;
    // None of them is above the size of a file.
    if (parameters > stride || count > INT32_MAX || stride > INT32_MAX || offset + count * stride > array->second)
      file_.refuse(accessor.GetLineNum(), tag(accessor) + " reaches beyond the " + std::to_string(array->second) +
                                              " numbers of '" + text_of(accessor, "source") + "'");
    numeric_.insert(source);
  }
  void check_input(const XMLElement& input) const {
    const std::string id = named_by(input);
    if (vertices_.count(id) == 0 && numeric_.count(id) == 0)
      file_.refuse(input.GetLineNum(),
                   tag(input) + " has source=\"" + text_of(input, "source") + "\", expected a <source> of numbers");
  }

  struct Extent {
    std::size_t nodes = 1;
    std::size_t height = 0;  // levels below
  };

  /// What an element becomes with its instances in place.
  Extent unfold(const XMLElement& element, std::size_t depth) {
    const auto known = extents_.find(&element);
    Extent extent = known != extents_.end() ? known->second : Extent{};
    if (depth + extent.height > deepest)
      file_.refuse(element.GetLineNum(), tag(element) + ": nodes contain themselves, or are deeper than 500");
    if (known != extents_.end()) return extent;
    for (const auto* child = element.FirstChildElement(); child != nullptr; child = child->NextSiblingElement()) {
      const std::string_view name = child->Name();
      const char* url = name == "instance_node" ? child->Attribute("url") : nullptr;
      const auto target = url != nullptr && *url == '#' ? nodes_.find(std::string_view(url + 1)) : nodes_.end();
      const XMLElement* below = name == "node" ? child : target != nodes_.end() ? target->second : nullptr;
      if (below == nullptr) continue;
      const Extent inner = unfold(*below, depth + 1);
      extent.nodes += inner.nodes;
      extent.height = std::max(extent.height, inner.height + 1);
      if (extent.nodes > most_nodes)
        file_.refuse(element.GetLineNum(), tag(element) + ": unfolds to more than 10^6 nodes");
    }
    extents_[&element] = extent;
    return extent;
  }

  XmlFile file_;
  std::int64_t bytes_;
  std::map<std::string, const XMLElement*, std::less<>> nodes_;  // by id
  std::vector<const XMLElement*> scenes_;
  std::map<std::string, std::int64_t> arrays_;                        // of numbers, by id: how many
  std::vector<std::pair<std::string, const XMLElement*>> accessors_;  // with the source they are in
  std::vector<const XMLElement*> inputs_;                             // of meshes
  std::set<std::string> vertices_;                                    // ids
  std::set<std::string> read_, numeric_;  // ids of sources with an accessor, and with one to numbers
  std::map<const XMLElement*, Extent> extents_;
};

}  // namespace

void check_dae(const std::filesystem::path& path) { DaeCheck(path).run(); }

}  // namespace hinge::robotics
