// SPDX-License-Identifier: BSD-3-Clause
// Implements Summary.
#include "summary.hpp"

#include <algorithm>

namespace robocd {

void Summary::add(bool collides, std::vector<NamedPair> names) {
  ++checked;
  colliding += collides ? 1 : 0;
  for (NamedPair& pair : names) ++pairs[std::move(pair)];
}

std::vector<std::pair<NamedPair, std::uint64_t>> Summary::top() const {
  std::vector<std::pair<NamedPair, std::uint64_t>> all(pairs.begin(), pairs.end());
  std::stable_sort(all.begin(), all.end(), [](const auto& a, const auto& b) { return a.second > b.second; });
  all.resize(std::min(shown_pairs, all.size()));
  return all;
}

Json Summary::json(const std::string& error) const {
  Json frequent = Json::array();
  for (const auto& [pair, count] : top())
    frequent.push_back({{"first", pair.first}, {"second", pair.second}, {"count", count}});
  Json all{{"checked", checked}, {"colliding", colliding}, {"most_frequent", frequent}};
  if (!error.empty()) all["error"] = error;
  return all;
}

}  // namespace robocd
