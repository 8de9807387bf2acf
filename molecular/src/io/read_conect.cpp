// SPDX-License-Identifier: BSD-3-Clause
// Reads CONECT records, which the parser ignores, and the bonds that Hinge records in REMARK 999.
#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <utility>

#include "io/hybrid36.hpp"
#include "io/read_file.hpp"

namespace hinge::molecular {

std::vector<RawConnection> read_conect(const std::string& text) {
  // Further fields hold hydrogen bonds and salt bridges of old files.
  constexpr std::size_t serial_column = 6, width = 5, most = 4;
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

namespace {

/// Reads the serial numbers after a word of a REMARK, as pairs of indices from 0; serial numbers count from 1.
std::vector<std::pair<std::uint32_t, std::uint32_t>> read_pairs(std::string_view numbers) {
  std::vector<std::uint32_t> found;
  while (!numbers.empty()) {
    const std::size_t first = std::min(numbers.find_first_not_of(" \r"), numbers.size());
    const std::size_t end = std::min(numbers.find_first_of(" \r", first), numbers.size());
    if (first == end) break;
    const auto serial = read_hybrid36(numbers.substr(first, end - first));
    if (!serial || *serial < 1) return {};
    found.push_back(static_cast<std::uint32_t>(*serial - 1));
    numbers.remove_prefix(end);
  }
  std::vector<std::pair<std::uint32_t, std::uint32_t>> pairs;
  for (std::size_t k = 0; k + 1 < found.size(); k += 2) pairs.emplace_back(found[k], found[k + 1]);
  return pairs;
}

}  // namespace

std::optional<RecordedBonds> read_recorded(const std::string& text, const std::vector<RawConnection>& conect) {
  constexpr std::string_view head = "REMARK 999 BONDS RECORDED BY HINGE 1:", single = "REMARK 999 SINGLE",
                             gap = "REMARK 999 BREAK";
  RecordedBonds recorded;
  std::size_t pairs = 0;
  bool is_recorded = false;
  std::set<std::pair<std::uint32_t, std::uint32_t>> singles;
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t end = std::min(text.find('\n', at), text.size());
    const std::string_view line = std::string_view(text).substr(at, end - at);
    at = end + 1;
    if (is_atom_record(line)) break;  // remarks precede atoms
    if (line.starts_with(head)) {
      const std::string counts(line.substr(head.size()));
      is_recorded = std::sscanf(counts.c_str(), " %zu ATOMS, %zu CONECT PAIRS", &recorded.atoms, &pairs) == 2;
    } else if (line.starts_with(single)) {
      for (const auto& pair : read_pairs(line.substr(single.size()))) singles.insert(pair);
    } else if (line.starts_with(gap)) {
      for (const auto& [i, j] : read_pairs(line.substr(gap.size())))
        recorded.bonds.push_back({i, j, BondOrder::unknown, false});
    }
  }
  if (!is_recorded || pairs != conect.size()) return std::nullopt;
  for (const RawConnection& pair : conect) {
    if (pair.first < 1) return std::nullopt;
    const auto i = static_cast<std::uint32_t>(pair.first - 1), j = static_cast<std::uint32_t>(pair.second - 1);
    const BondOrder once = singles.count({i, j}) > 0 ? BondOrder::single : BondOrder::unknown;
    recorded.bonds.push_back({i, j, pair.repeated ? BondOrder::multiple : once, true});
  }
  return recorded;
}

}  // namespace hinge::molecular
