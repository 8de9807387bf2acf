// SPDX-License-Identifier: BSD-3-Clause
// Implements check_stl. A binary STL file has 84 + 50 n bytes, with n in little-endian order at byte 80.
#include "mesh/check_stl.hpp"

#include <cstdint>
#include <string_view>

#include "hinge/core/error.hpp"

namespace hinge::robotics {

namespace {

constexpr std::size_t header_size = 84;
constexpr std::size_t facet_size = 50;

struct WordCount {
  std::size_t facets = 0;
  std::size_t ends = 0;  // number of endfacet
  bool is_closed = false;
};

WordCount count_words(std::string_view text) {
  constexpr std::string_view blanks = " \t\r\n";
  WordCount count;
  std::string_view before;
  for (std::size_t start = text.find_first_not_of(blanks); start != std::string_view::npos;
       start = text.find_first_not_of(blanks)) {
    text.remove_prefix(start);
    const std::string_view word = text.substr(0, text.find_first_of(blanks));
    text.remove_prefix(word.size());
    count.facets += before == "facet" && word == "normal" ? 1U : 0U;
    count.ends += word == "endfacet" ? 1U : 0U;
    count.is_closed = word == "endsolid" || (count.is_closed && word != "facet");
    before = word;
  }
  return count;
}

}  // namespace

std::size_t check_stl(const std::string& bytes, const std::string& path) {
  std::size_t announced = 0;
  if (bytes.size() >= header_size) {
    for (std::size_t k = 0; k < 4; ++k) announced |= std::size_t{static_cast<unsigned char>(bytes[80 + k])} << 8 * k;
    if (bytes.size() == header_size + facet_size * announced) return announced;
  }
  if (bytes.starts_with("solid")) {
    const WordCount count = count_words(bytes);
    // "solid" alone is no evidence: many binary files begin with it.
    if (count.facets > 0 || count.is_closed) {
      if (count.facets != count.ends || !count.is_closed)
        throw LoadError(path + ": text STL with " + std::to_string(count.facets) + " facets, of which " +
                        std::to_string(count.ends) + " have an endfacet" +
                        (count.is_closed ? "" : ", and no endsolid") + ": the file is cut short or damaged");
      return count.facets;
    }
  }
  if (bytes.size() < header_size)
    throw LoadError(path + ": " + std::to_string(bytes.size()) + " bytes, expected at least the 84 of a binary STL");
  throw LoadError(path + ": the header of the binary STL gives " + std::to_string(announced) +
                  " triangles, which need " + std::to_string(header_size + facet_size * announced) +
                  " bytes; the file has " + std::to_string(bytes.size()));
}

}  // namespace hinge::robotics
