// SPDX-License-Identifier: BSD-3-Clause
// The boundary between public and private: no public declaration names anything in hinge::detail, and examples and
// pages include public headers only.
#pragma once

#include <regex>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "architecture/source_tree.hpp"

namespace architecture {

/// Returns whether the path is a header that users may include.
inline bool is_public_header(const std::string& path) {
  return path.ends_with(".hpp") && !path.starts_with("include/hinge/detail/") &&
         starts_with_any(path, {"include/hinge/", "molecular/include/", "robotics/include/"});
}

/// Returns the text without comments, preprocessor lines, strings and character literals.
inline std::string bare_code(const std::vector<std::string>& lines) {
  static const std::regex noise(R"re(//.*|"(\\.|[^"\\])*"|'(\\.|[^'\\])'|^\s*#.*)re");
  std::string text;
  for (const std::string& line : lines) text += std::regex_replace(line, noise, "") + "\n";
  return text;
}

/// Declarations that users of a header can name: at namespace scope and in public sections of classes, without bodies,
/// initialisers and default values. Definitions of members outside their class are left out.
class PublicDeclarations {
 public:
  explicit PublicDeclarations(std::string_view code) {
    for (const char c : code) {
      if (c == '(' || c == '[') ++parentheses_;
      if (c == ')' || c == ']') --parentheses_;
      if (c == '{' && parentheses_ == 0) {
        open();
      } else if (c == '}' && parentheses_ == 0) {
        if (scopes_.size() > 1) scopes_.pop_back();
        declaration_.clear();
      } else if (c == ';' && parentheses_ == 0) {
        take();
        declaration_.clear();
      } else if (scopes_.back() != Scope::body) {
        declaration_ += c;
        if (c == ':') read_access();
      }
    }
  }
  const std::vector<std::string>& all() const { return declarations_; }

 private:
  enum class Scope { visible, hidden, body };

  void read_access() {
    static const std::regex access(R"re(^\s*(public|private|protected)\s*:$)re");
    std::smatch match;
    if (declaration_.size() > 100 || !std::regex_match(declaration_, match, access)) return;
    scopes_.back() = match[1] == "public" ? Scope::visible : Scope::hidden;
    declaration_.clear();
  }
  void open() {
    static const std::regex space(R"re(^\s*(inline\s+)?namespace\b)re");
    static const std::regex type(R"re(\b(class|struct|union|enum)\b[^()=]*$)re");
    std::smatch match;
    take();
    Scope inside = Scope::body;
    if (scopes_.back() == Scope::visible) {
      if (std::regex_search(declaration_, space))
        inside = declaration_.find("detail") == std::string::npos ? Scope::visible : Scope::body;
      else if (std::regex_search(declaration_, match, type))
        inside = match[1] == "class" ? Scope::hidden : Scope::visible;
    }
    scopes_.push_back(inside);
    declaration_.clear();
  }
  void take() {
    static const std::regex member_elsewhere(R"re([\w>]::~?\w+\s*\()re");
    static const std::regex value(R"re(\)\s*(const\s*)?(noexcept\s*)?:\s[\s\S]*$|[^=!<>]=[^=][\s\S]*$)re");
    static const std::regex forward(R"re(^\s*friend\s+(class|struct)\b)re");
    if (scopes_.back() != Scope::visible) return;
    static const std::regex alias(R"re(^\s*(template\s*<[^<>]*>\s*)?using\b)re");
    const bool is_alias = std::regex_search(declaration_, alias);
    const std::string bare = is_alias ? declaration_ : std::regex_replace(declaration_, value, "");
    if (scopes_.size() <= 3 && std::regex_search(bare, member_elsewhere) && bare.find("friend") == std::string::npos &&
        bare.find("decltype") == std::string::npos)
      return;
    if (!std::regex_search(bare, forward)) declarations_.push_back(bare);
  }

  std::vector<Scope> scopes_ = {Scope::visible};
  std::string declaration_;
  std::vector<std::string> declarations_;
  int parentheses_ = 0;
};

/// Returns one sentence per public declaration that names something in hinge::detail.
inline std::vector<std::string> private_names_in_public(const SourceTree& tree) {
  static const std::regex space(R"re(\s+)re");
  std::vector<std::string> violations;
  for (const auto& [path, lines] : tree) {
    if (!is_public_header(path)) continue;
    const PublicDeclarations declarations(bare_code(lines));
    for (const std::string& declaration : declarations.all())
      if (declaration.find("detail::") != std::string::npos)
        violations.push_back(path + " shows a private name:" + std::regex_replace(declaration, space, " "));
  }
  return violations;
}

/// Returns one sentence per installed header that includes a header that is not installed.
inline std::vector<std::string> headers_left_behind(const SourceTree& tree) {
  std::vector<std::string> violations;
  for (const auto& [path, lines] : tree) {
    if (!is_public_header(path) && !path.starts_with("include/hinge/detail/")) continue;
    for (const Include& include : includes(lines))
      if (include.quoted && !include.name.starts_with("hinge/"))
        violations.push_back(path + " includes \"" + include.name + "\", which is not installed");
  }
  return violations;
}

/// Returns public headers that the umbrella header of their folder omits. batch/ensemble.hpp needs TBB and is separate.
inline std::vector<std::string> not_under_umbrella(const SourceTree& tree) {
  std::vector<std::string> missing;
  for (const std::string folder :
       {"include/hinge", "molecular/include/hinge/molecular", "robotics/include/hinge/robotics"}) {
    const std::string umbrella = folder + folder.substr(folder.rfind('/')) + ".hpp";
    const std::string root = folder.substr(0, folder.find("include/")) + "include/";
    std::set<std::string> included = {umbrella, "include/hinge/batch/ensemble.hpp"};
    if (const auto file = tree.find(umbrella); file != tree.end())
      for (const Include& include : includes(file->second)) included.insert(root + include.name);
    for (const auto& [path, lines] : tree)
      if (path.starts_with(folder + "/") && is_public_header(path) && !included.contains(path))
        missing.push_back(umbrella + " does not include " + path);
  }
  return missing;
}

/// Returns one sentence per line of examples, outside programs and pages that includes a private header.
inline std::vector<std::string> private_includes(const SourceTree& shown) {
  static const std::regex pattern(R"re(#\s*include\s*[<"](hinge/detail/|hinge_tools/|hinge_planning/))re");
  std::vector<std::string> violations;
  for (const auto& [path, lines] : shown)
    for (const std::string& line : lines)
      if (std::regex_search(line, pattern)) violations.push_back(path + " includes a private header: " + line);
  return violations;
}

}  // namespace architecture
