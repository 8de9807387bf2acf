// SPDX-License-Identifier: BSD-3-Clause
// XmlFile: an XML file whose error messages name the line of an element.
#pragma once

#include <tinyxml2.h>

#include <filesystem>
#include <string>

namespace hinge::robotics {

/// Returns "<name>", for messages.
inline std::string tag(const tinyxml2::XMLElement& element) { return std::string("<").append(element.Name()) + ">"; }

/// Returns an attribute, or "" if it does not exist.
inline std::string text_of(const tinyxml2::XMLElement& element, const char* attribute) {
  const char* text = element.Attribute(attribute);
  return text != nullptr ? text : "";
}

/// An XML file with a given root element. Throws LoadError if the file cannot be read, is not XML, or has another root.
class XmlFile {
 public:
  XmlFile(const std::filesystem::path& path, const char* root);
  /// text: the bytes of the file, which is not read. path: for messages.
  XmlFile(const std::filesystem::path& path, std::string text, const char* root);

  tinyxml2::XMLElement& root() noexcept { return *document_.RootElement(); }
  const tinyxml2::XMLElement& root() const noexcept { return *document_.RootElement(); }

  /// Throws LoadError if the element, or any element or attribute inside it, is input for xacro.
  void refuse_xacro_in(const tinyxml2::XMLElement& element) const;
  [[noreturn]] void refuse_xacro(const tinyxml2::XMLElement& element) const;

  /// Returns "file:line: ", or "file: " if the line is 0.
  std::string at(int line) const;

  /// Throws LoadError "file:line: what", without the line if it is 0.
  [[noreturn]] void refuse(int line, const std::string& what) const;

  /// Returns an attribute. Throws LoadError if it does not exist or is empty.
  std::string attribute(const tinyxml2::XMLElement& element, const char* name) const;

  std::string text() const;  ///< the document in its present state

 private:
  std::string path_;
  tinyxml2::XMLDocument document_;
};

}  // namespace hinge::robotics
