// SPDX-License-Identifier: BSD-3-Clause
// Reads the data of a report page back: docs/reference/report.md.
#pragma once

#include <cstddef>
#include <cstring>
#include <fstream>
#include <iterator>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <string>
#include <vector>

namespace hinge::test {

/// Returns the data of a page. Throws if there are none.
inline nlohmann::json page_data(const std::string& path) {
  std::ifstream in(path, std::ios::binary);
  const std::string page(std::istreambuf_iterator<char>(in), {});
  const std::string head = "id=\"hinge-data\">";
  const std::size_t from = page.find(head);
  if (from == std::string::npos) throw std::runtime_error(path + ": no data");
  const std::size_t to = page.find("</script>", from);
  return nlohmann::json::parse(page.substr(from + head.size(), to - from - head.size()));
}

/// Returns the numbers of a base64 text.
template <class Number>
std::vector<Number> unpacked(const std::string& text) {
  const std::string digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string bytes;
  unsigned word = 0, bits = 0;
  for (const char c : text) {
    if (c == '=') break;
    word = (word << 6U | static_cast<unsigned>(digits.find(c))) & 0xffffU;
    bits += 6;
    if (bits < 8) continue;
    bits -= 8;
    bytes += static_cast<char>(word >> bits & 0xffU);
  }
  std::vector<Number> numbers(bytes.size() / sizeof(Number));
  if (!numbers.empty()) std::memcpy(numbers.data(), bytes.data(), numbers.size() * sizeof(Number));
  return numbers;
}

}  // namespace hinge::test
