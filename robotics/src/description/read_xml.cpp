// SPDX-License-Identifier: BSD-3-Clause
// Implements XmlFile with tinyxml2: errors in one line, and detection of xacro.
#include "description/read_xml.hpp"

#include <cstring>
#include <string_view>

#include "description/read_file.hpp"
#include "hinge/core/error.hpp"

namespace hinge::robotics {

namespace {

/// Returns true for remains of xacro. A declaration of its namespace is no evidence: xacro leaves it in its output.
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

/// Replaces every <?...?> by blanks, so that line numbers stay the same.
void blank_declarations(std::string& bytes) {
  for (std::size_t start = bytes.find("<?"); start != std::string::npos; start = bytes.find("<?", start)) {
    const std::size_t end = bytes.find("?>", start);
    if (end == std::string::npos) return;
    for (; start < end + 2; ++start)
      if (bytes[start] != '\n') bytes[start] = ' ';
  }
}

}  // namespace

XmlFile::XmlFile(const std::filesystem::path& path, const char* root_name)
    : XmlFile(path, read_file(path), root_name) {}

XmlFile::XmlFile(const std::filesystem::path& path, std::string bytes, const char* root_name) : path_(path.string()) {
  if (bytes.find_first_not_of(" \t\r\n") == std::string::npos)
    refuse(0, std::string("is empty, expected XML with root element <") + root_name + ">");
  // Some files have a comment above <?xml ...?>. Other readers accept them.
  if (document_.Parse(bytes.data(), bytes.size()) == tinyxml2::XML_ERROR_PARSING_DECLARATION) {
    blank_declarations(bytes);
    document_.Parse(bytes.data(), bytes.size());
  }
  if (document_.Error())
    refuse(document_.ErrorLineNum(),
           "is not XML: " + std::string(tinyxml2::XMLDocument::ErrorIDToName(document_.ErrorID())));
  if (document_.RootElement() == nullptr) refuse(0, "holds no XML element");
  const tinyxml2::XMLElement& top = root();
  if (top.Name() != std::string_view(root_name))
    refuse(top.GetLineNum(), "root element is " + tag(top) + ", expected <" + root_name + ">");
}

void XmlFile::refuse_xacro_in(const tinyxml2::XMLElement& element) const {
  if (const auto* found = find_xacro(element)) refuse_xacro(*found);
}

void XmlFile::refuse_xacro(const tinyxml2::XMLElement& element) const {
  refuse(element.GetLineNum(), tag(element) + " needs xacro: run `xacro FILE > FILE.urdf` first and read its output");
}

void XmlFile::refuse(int line, const std::string& what) const { throw LoadError(at(line) + what); }

std::string XmlFile::at(int line) const {
  std::string where = path_;
  if (line > 0) where.append(":").append(std::to_string(line));
  return where + ": ";
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
