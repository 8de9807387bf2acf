// SPDX-License-Identifier: BSD-3-Clause
// Implements check_ply. The header consists of text lines up to "end_header", in binary files too.
#include "mesh/check_ply.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <cstddef>
#include <string_view>
#include <system_error>

#include "hinge/core/error.hpp"

namespace hinge::robotics {

namespace {

std::string_view next_word(std::string_view& line) {
  constexpr std::string_view blanks = " \t";
  line.remove_prefix(std::min(line.find_first_not_of(blanks), line.size()));
  const std::string_view word = line.substr(0, line.find_first_of(blanks));
  line.remove_prefix(word.size());
  return word;
}

/// Refuses unknown types, which assimp skips.
void check_type(std::string_view type, const std::string& where) {
  constexpr std::array<std::string_view, 16> known{"char",   "int8",    "uchar",  "uint8",  "short", "int16",
                                                   "ushort", "uint16",  "int",    "int32",  "uint",  "uint32",
                                                   "float",  "float32", "double", "float64"};
  if (std::find(known.begin(), known.end(), type) == known.end())
    throw LoadError(where + "property has the type '" + std::string(type) + "', expected a type of the PLY format");
}

/// Returns the property's name from the text after the word "property", or "" for a list.
std::string_view scalar_property(std::string_view line, const std::string& where) {
  std::string_view type = next_word(line);
  const bool list = type == "list";
  if (list) {
    check_type(next_word(line), where);
    type = next_word(line);
  }
  check_type(type, where);
  const std::string_view name = next_word(line);
  if (name.empty()) throw LoadError(where + "property has no name");
  return list ? std::string_view() : name;
}

}  // namespace

void check_ply(const std::string& bytes, const std::string& path) {
  constexpr std::array<std::string_view, 5> known{"format", "comment", "obj_info", "element", "property"};
  std::size_t number = 0, vertex_line = 0;
  bool of_vertex = false;
  std::string missing;  // letters of x, y and z not seen yet; assimp would use 0
  std::string_view rest = bytes;
  while (!rest.empty()) {
    const std::size_t end = rest.find('\n');
    std::string_view line = rest.substr(0, end);
    rest.remove_prefix(end == std::string_view::npos ? rest.size() : end + 1);
    const std::string where = path + ":" + std::to_string(++number) + ": ";
    if (line.ends_with('\r')) line.remove_suffix(1);
    if (line.find('\r') != std::string_view::npos)
      throw LoadError(where + "the line holds a carriage return, expected \\n or \\r\\n at its end");
    const std::string_view word = next_word(line);
    if (number == 1) {
      if (word != "ply") throw LoadError(where + "expected the word ply");
      continue;
    }
    if (word == "end_header") {
      if (!missing.empty())
        throw LoadError(path + ":" + std::to_string(vertex_line) + ": element vertex has no property " +
                        missing.front());
      return;
    }
    if (std::find(known.begin(), known.end(), word) == known.end())
      throw LoadError(where + "not a line of a PLY header, expected end_header before it");
    if (word == "property") {
      const std::string_view name = scalar_property(line, where);
      if (of_vertex && name.size() == 1) std::erase(missing, name.front());
    }
    if (word != "element") continue;
    const std::string_view name = next_word(line), text = next_word(line);
    of_vertex = name == "vertex";
    if (of_vertex) {
      missing = "xyz";
      vertex_line = number;
    }
    // assimp would take the digits for the count.
    if (!name.empty() && name.front() >= '0' && name.front() <= '9')
      throw LoadError(where + "element has the name '" + std::string(name) +
                      "', expected a name that begins with a letter");
    std::size_t count = 0;
    const auto [stop, error] = std::from_chars(text.data(), text.data() + text.size(), count);
    if (error != std::errc{} || stop != text.data() + text.size() || count > bytes.size())
      throw LoadError(where + "element " + std::string(name) + " has count '" + std::string(text) +
                      "', expected a whole number that fits a file of " + std::to_string(bytes.size()) + " bytes");
  }
  throw LoadError(path + ": PLY header without end_header, the file may be cut short");
}

}  // namespace hinge::robotics
