// SPDX-License-Identifier: BSD-3-Clause
// Sorts hits by (first, second). Long lists use a radix sort; a comparison sort took longer than the query.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <tuple>
#include <vector>

#include "hinge/core/id.hpp"
#include "hinge/policy/collector.hpp"

namespace hinge::detail {

/// Returns the hits, sorted. Changes their order.
inline std::vector<Hit> sorted_hits(std::vector<Hit>& hits) {
  const auto before = [](const Hit& a, const Hit& b) {
    return std::tie(a.first, a.second) < std::tie(b.first, b.second);
  };
  std::size_t buckets = 0;
  for (const Hit& hit : hits) buckets = std::max(buckets, std::max(index(hit.first), index(hit.second)) + 1);
  // Buckets pay off only when their number is small relative to the number of hits.
  if (hits.size() < 64 || buckets > 8 * hits.size()) {
    std::sort(hits.begin(), hits.end(), before);
    return hits;
  }
  // Stable counting sort by second, then by first.
  struct Place {
    std::uint32_t of_first, of_second;  // numbers of hits with a smaller primitive
  };
  std::vector<Place> places(buckets + 1);
  for (const Hit& hit : hits) {
    ++places[index(hit.first) + 1].of_first;
    ++places[index(hit.second) + 1].of_second;
  }
  for (std::size_t b = 0; b < buckets; ++b) {
    places[b + 1].of_first += places[b].of_first;
    places[b + 1].of_second += places[b].of_second;
  }
  std::vector<std::uint32_t> by_second(hits.size());
  for (std::uint32_t k = 0; k < by_second.size(); ++k) by_second[places[index(hits[k].second)].of_second++] = k;
  std::vector<Hit> sorted(hits.size());
  for (const std::uint32_t k : by_second) sorted[places[index(hits[k].first)].of_first++] = hits[k];
  return sorted;
}
inline void sort_hits(std::vector<Hit>& hits) { hits = sorted_hits(hits); }

}  // namespace hinge::detail
