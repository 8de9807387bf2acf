// SPDX-License-Identifier: BSD-3-Clause
// XML files whose elements know where they stand, and the messages about them.
#pragma once

#include <tinyxml2.h>

#include <filesystem>
#include <string>

namespace hinge::robotics {

/// "<name>", for messages.
inline std::string tag(const tinyxml2::XMLElement& element) { return std::string("<").append(element.Name()) + ">"; }

/// An attribute, or "" where it is not.
inline std::string text_of(const tinyxml2::XMLElement& element, const char* attribute) {
  const char* text = element.Attribute(attribute);
  return text != nullptr ? text : "";
}

/// An XML file with this root element. LoadError: cannot be opened, no XML, another root.
class XmlFile {
 public:
  XmlFile(const std::filesystem::path& path, const char* root);

  tinyxml2::XMLElement& root() noexcept { return *document_.RootElement(); }

  /// LoadError: it, or an element or attribute in it, is one that xacro would have replaced.
  void refuse_xacro_in(const tinyxml2::XMLElement& element) const;
  [[noreturn]] void refuse_xacro(const tinyxml2::XMLElement& element) const;

  /// "file:line: "; without the line when it is 0.
  std::string at(int line) const;

  /// Throws LoadError "file:line: what"; without the line when it is 0.
  [[noreturn]] void refuse(int line, const std::string& what) const;

  /// An attribute that must be there and not be empty.
  std::string attribute(const tinyxml2::XMLElement& element, const char* name) const;

  std::string text() const;  ///< the document as it is now

 private:
  std::string path_;
  tinyxml2::XMLDocument document_;
};

}  // namespace hinge::robotics
