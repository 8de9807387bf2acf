// SPDX-License-Identifier: BSD-3-Clause
// tinyxml2, with one-line errors, and xacro recognised before it is taken for a robot.
#include "read_xml.hpp"

#include <cstring>
#include <string_view>

#include "hinge/core/error.hpp"
#include "read_file.hpp"

namespace hinge::robotics {

namespace {

/// Left-overs of xacro. Its namespace alone proves nothing: files made by it may keep the declaration.
bool is_xacro(const tinyxml2::XMLElement& element) {
  if (std::string_view(element.Name()).starts_with("xacro:")) return true;
  for (const tinyxml2::XMLAttribute* a = element.FirstAttribute(); a != nullptr; a = a->Next())
    if (std::strstr(a->Value(), "${") != nullptr || std::strstr(a->Value(), "$(") != nullptr) return true;
  return false;
}

const tinyxml2::XMLElement* find_xacro(const tinyxml2::XMLElement& element) {
  if (is_xacro(element)) return &element;
  for (const auto* child = element.FirstChildElement(); child != nullptr; child = child->NextSiblingElement())
    if (const auto* found = find_xacro(*child)) return found;
  return nullptr;
}

}  // namespace

XmlFile::XmlFile(const std::filesystem::path& path, const char* root_name) : path_(path.string()) {
  const std::string bytes = read_file(path);
  if (document_.Parse(bytes.data(), bytes.size()) != tinyxml2::XML_SUCCESS)
    refuse(document_.ErrorLineNum(),
           "is no XML: " + std::string(tinyxml2::XMLDocument::ErrorIDToName(document_.ErrorID())));
  if (document_.RootElement() == nullptr) refuse(0, "holds no XML element");
  const tinyxml2::XMLElement& top = root();
  if (top.Name() != std::string_view(root_name))
    refuse(top.GetLineNum(), "root element is " + tag(top) + ", expected <" + root_name + ">");
  if (const auto* element = find_xacro(top))
    refuse(element->GetLineNum(),
           tag(*element) + " needs xacro: run `xacro FILE > FILE.urdf` first and read its output");
}

void XmlFile::refuse(int line, const std::string& what) const {
  throw LoadError(path_ + (line > 0 ? ":" + std::to_string(line) : "") + ": " + what);
}

std::string XmlFile::attribute(const tinyxml2::XMLElement& element, const char* name) const {
  const char* value = element.Attribute(name);
  if (value == nullptr || *value == '\0')
    refuse(element.GetLineNum(), tag(element) + " has no attribute '" + name + "'");
  return value;
}

std::string XmlFile::text() const {
  tinyxml2::XMLPrinter printer(nullptr, true);
  document_.Print(&printer);
  return printer.CStr();
}

}  // namespace hinge::robotics
