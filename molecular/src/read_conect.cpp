// SPDX-License-Identifier: BSD-3-Clause
// CONECT records of PDB files, which the parser passes over.
#include <algorithm>
#include <cstddef>
#include <map>
#include <optional>
#include <string_view>
#include <utility>

#include "read_file.hpp"

namespace hinge::molecular {

namespace {

/// Hybrid-36 (five columns): decimal up to 99999, then A0000 ... ZZZZZ, then a0000 ... in base 36.
std::optional<int> serial(std::string_view field) {
  const std::size_t first = field.find_first_not_of(' ');
  if (first == std::string_view::npos) return std::nullopt;
  field = field.substr(first, field.find_last_not_of(" \r") - first + 1);
  const auto digit = [](char c) { return c >= '0' && c <= '9' ? c - '0' : -1; };
  const bool decimal = digit(field.front()) >= 0, lower = field.front() >= 'a' && field.front() <= 'z';
  if (!decimal && field.size() != 5) return std::nullopt;
  int value = 0;
  for (const char c : field) {
    int d = digit(c);
    if (!decimal && d < 0 && c >= (lower ? 'a' : 'A') && c <= (lower ? 'z' : 'Z')) d = c - (lower ? 'a' : 'A') + 10;
    if (d < 0) return std::nullopt;
    value = value * (decimal ? 10 : 36) + d;
  }
  if (decimal) return value;
  constexpr int to_fourth = 36 * 36 * 36 * 36;
  return value - 10 * to_fourth + 100'000 + (lower ? 26 * to_fourth : 0);
}

}  // namespace

std::vector<RawConnection> read_conect(const std::string& text) {
  constexpr std::size_t serial_column = 6, width = 5, most = 4;  // beyond: hydrogen bonds and salt bridges of old files
  std::map<std::pair<int, int>, int> directed;
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t end = std::min(text.find('\n', at), text.size());
    const std::string_view line = std::string_view(text).substr(at, end - at);
    at = end + 1;
    if (!line.starts_with("CONECT")) continue;
    const auto field = [&](std::size_t k) {
      const std::size_t column = serial_column + width * k;
      return column < line.size() ? serial(line.substr(column, width)) : std::nullopt;
    };
    const auto from = field(0);
    for (std::size_t k = 1; from && k <= most; ++k) {
      const auto to = field(k);
      if (!to) break;
      if (*to != *from) ++directed[{*from, *to}];
    }
  }
  std::map<std::pair<int, int>, bool> repeated;
  for (const auto& [pair, times] : directed) {
    bool& entry = repeated[std::minmax(pair.first, pair.second)];
    entry = entry || times > 1;
  }
  std::vector<RawConnection> found;
  for (const auto& [pair, often] : repeated) found.push_back({pair.first, pair.second, often});
  return found;
}

}  // namespace hinge::molecular
