// SPDX-License-Identifier: BSD-3-Clause
// Implements DaeFile.
#include "mesh/dae_file.hpp"

#include <string_view>

namespace hinge::robotics {

namespace {

using tinyxml2::XMLElement;

/// Visits the elements below that have an id. The recursion is bounded: tinyxml2 accepts at most 500 levels.
template <class Visit>
void for_each_id(const XMLElement& element, const Visit& visit) {
  for (const auto* child = element.FirstChildElement(); child != nullptr; child = child->NextSiblingElement()) {
    if (const char* id = child->Attribute("id")) visit(id, *child);
    for_each_id(*child, visit);
  }
}

/// Returns the only text in an element, which may stand between comments.
std::string_view text_in(const DaeFile& file, const XMLElement& element, const char* numbers) {
  std::string_view text;
  for (const auto* child = element.FirstChild(); child != nullptr; child = child->NextSibling()) {
    if (child->ToComment() != nullptr) continue;
    if (child->ToText() == nullptr || !text.empty())
      file.refuse(element, std::string(" holds more than one text, expected one list of ") + numbers);
    text = child->Value();
  }
  return text;
}

/// Returns the <mesh> that holds an element, or null.
const tinyxml2::XMLNode* mesh_around(const XMLElement& element) {
  const tinyxml2::XMLNode* at = &element;
  while (at != nullptr && (at->ToElement() == nullptr || std::string_view(at->Value()) != "mesh")) at = at->Parent();
  return at;
}

}  // namespace

DaeFile::DaeFile(const std::filesystem::path& path, std::string bytes)
    : bytes_(static_cast<std::int64_t>(bytes.size())), file_(path, std::move(bytes), "COLLADA") {
  // Libraries that do not concern shapes are not looked at.
  for (const char* library : {"library_geometries", "library_nodes", "library_visual_scenes"})
    for (const auto* top = root().FirstChildElement(library); top != nullptr; top = top->NextSiblingElement(library))
      for_each_id(*top, [&](const char* id, const XMLElement& element) {
        by_id_.emplace(std::pair(element.Name(), id), &element);
      });
}

const XMLElement& DaeFile::find(const XMLElement& from, const char* attribute, const std::string& name) const {
  const std::string url = text_of(from, attribute);
  const auto [first, last] = by_id_.equal_range({name, url.starts_with('#') ? url.substr(1) : std::string()});
  std::vector<const XMLElement*> found;
  for (auto at = first; at != last; ++at) found.push_back(at->second);
  // Some programs use the same ids in every <mesh>.
  if (found.size() > 1)
    std::erase_if(found, [&](const XMLElement* element) { return mesh_around(*element) != mesh_around(from); });
  if (found.size() == 1) return *found.front();
  refuse(from, std::string(" has ") + attribute + "=\"" + url + "\", expected " +
                   (first == last ? "a <" + name + "> of this file" : "one <" + name + ">, but several have this id"));
}

std::size_t DaeFile::whole(const XMLElement& element, const char* attribute, std::int64_t default_value) const {
  const char* text = element.Attribute(attribute);
  if (text == nullptr && default_value < 0)
    refuse(element, std::string(" has no ") + attribute + ", expected a whole number");
  const auto number = text == nullptr ? default_value : parse_number<std::int64_t>(text);
  if (!number || *number < 0 || *number > bytes_)
    refuse(element, std::string(" has ") + attribute + "=\"" + text +
                        "\", expected a whole number that fits the size of the file");
  return static_cast<std::size_t>(*number);
}

std::vector<double> DaeFile::numbers(const XMLElement& element, std::size_t count) const {
  std::string_view text = text_in(*this, element, "numbers");
  std::vector<double> numbers;
  while (numbers.size() < count) {
    const std::string_view word = next_word(text);
    const auto number = parse_number<double>(word);
    if (word.empty())
      refuse(element, " holds " + std::to_string(numbers.size()) + " numbers, expected " + std::to_string(count));
    if (!number) refuse(element, " holds " + quoted(word) + ", expected numbers");
    numbers.push_back(*number);
  }
  return numbers;
}

std::vector<std::size_t> DaeFile::whole_numbers(const XMLElement& element) const {
  std::string_view text = text_in(*this, element, "whole numbers");
  std::vector<std::size_t> numbers;
  for (std::string_view word = next_word(text); !word.empty(); word = next_word(text)) {
    const auto number = parse_number<std::uint32_t>(word);
    if (!number) refuse(element, " holds " + quoted(word) + ", expected whole numbers >= 0");
    numbers.push_back(*number);
  }
  return numbers;
}

void DaeFile::refuse(const XMLElement& element, const std::string& what) const {
  file_.refuse(element.GetLineNum(), tag(element) + what);
}

}  // namespace hinge::robotics
