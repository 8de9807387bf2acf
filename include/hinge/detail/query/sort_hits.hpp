// SPDX-License-Identifier: BSD-3-Clause
// sort_hits: sorts hits by (first, second). Long lists use a radix sort; a comparison sort took longer than the query.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <tuple>
#include <vector>

#include "hinge/core/id.hpp"
#include "hinge/policy/collector.hpp"

namespace hinge::detail {

inline void sort_hits(std::vector<Hit>& hits) {
  const auto before = [](const Hit& a, const Hit& b) {
    return std::tie(a.first, a.second) < std::tie(b.first, b.second);
  };
  std::size_t buckets = 0;
  for (const Hit& hit : hits) buckets = std::max(buckets, std::max(index(hit.first), index(hit.second)) + 1);
  // Buckets pay off only when their number is small relative to the number of hits.
  if (hits.size() < 64 || buckets > 4 * hits.size()) {
    std::sort(hits.begin(), hits.end(), before);
    return;
  }
  // Stable counting sort by second, then by first.
  std::vector<std::uint32_t> order(hits.size()), sorted_order(hits.size()), end(buckets + 1);
  for (std::size_t k = 0; k < order.size(); ++k) order[k] = static_cast<std::uint32_t>(k);
  for (const auto key : {&Hit::second, &Hit::first}) {
    std::fill(end.begin(), end.end(), 0U);
    for (const Hit& hit : hits) ++end[index(hit.*key) + 1];
    for (std::size_t b = 0; b < buckets; ++b) end[b + 1] += end[b];
    for (const std::uint32_t k : order) sorted_order[end[index(hits[k].*key)]++] = k;
    order.swap(sorted_order);
  }
  std::vector<Hit> sorted;
  sorted.reserve(hits.size());
  for (const std::uint32_t k : order) sorted.push_back(hits[k]);
  hits.swap(sorted);
}

}  // namespace hinge::detail
