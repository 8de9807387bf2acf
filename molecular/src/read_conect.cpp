// SPDX-License-Identifier: BSD-3-Clause
// CONECT records of PDB files, which the parser passes over.
#include <algorithm>
#include <cstddef>
#include <map>
#include <optional>
#include <string_view>
#include <utility>

#include "hybrid36.hpp"
#include "read_file.hpp"

namespace hinge::molecular {

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
      return column < line.size() ? read_hybrid36(line.substr(column, width)) : std::nullopt;
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
