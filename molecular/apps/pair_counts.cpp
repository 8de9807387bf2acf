// SPDX-License-Identifier: BSD-3-Clause
// Implements PairCounts.
#include "pair_counts.hpp"

#include <utility>

namespace biocd {

void PairCounts::add(const Json& pair, std::uint64_t times) {
  const auto i = pair.at("i").get<std::uint32_t>(), j = pair.at("j").get<std::uint32_t>();
  add(i, j, times);
  for (const auto& [index, key] : {std::pair{i, "label_i"}, std::pair{j, "label_j"}})
    if (!labels_.contains(index)) labels_[index] = pair.at(key).get<std::string>();
}

std::vector<PairCount> PairCounts::top(std::size_t most) const {
  const auto label_of = [&](std::uint32_t index) { return label_ ? label_(index) : labels_.at(index); };
  std::vector<PairCount> all;
  for (const auto& [key, count] : counts_.top(most)) {
    const auto i = static_cast<std::uint32_t>(key >> 32U), j = static_cast<std::uint32_t>(key);
    all.push_back({i, j, label_of(i), label_of(j), count});
  }
  return all;
}

Json PairCounts::json(std::size_t most) const {
  Json list = Json::array();
  for (const PairCount& pair : top(most))
    list.push_back(
        {{"i", pair.i}, {"j", pair.j}, {"label_i", pair.label_i}, {"label_j", pair.label_j}, {"count", pair.count}});
  return list;
}

}  // namespace biocd
