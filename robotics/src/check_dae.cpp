// SPDX-License-Identifier: BSD-3-Clause
// One pass over the elements, and one over the nodes as they unfold.
#include "check_dae.hpp"

#include <algorithm>
#include <charconv>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <map>
#include <string>
#include <string_view>
#include <system_error>
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
    if (name == "node" && element.Attribute("id") != nullptr) nodes_.emplace(element.Attribute("id"), &element);
    if (name == "visual_scene") scenes_.push_back(&element);
    for (const auto* child = element.FirstChildElement(); child != nullptr; child = child->NextSiblingElement())
      check_below(*child);
  }

  void check_indices(const XMLElement& element) const {
    constexpr std::string_view blanks = " \t\r\n";
    std::string_view text = element.GetText() != nullptr ? element.GetText() : "";
    for (std::size_t start = text.find_first_not_of(blanks); start != std::string_view::npos;
         start = text.find_first_not_of(blanks)) {
      text.remove_prefix(start);
      const std::string_view word = text.substr(0, text.find_first_of(blanks));
      text.remove_prefix(word.size());
      if (!is_whole_number(word, -1, INT32_MAX))
        file_.refuse(element.GetLineNum(), tag(element) + " holds '" + std::string(word) + "', expected whole numbers");
    }
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
  std::map<const XMLElement*, Extent> extents_;
};

}  // namespace

void check_dae(const std::filesystem::path& path) { DaeCheck(path).run(); }

}  // namespace hinge::robotics
