// SPDX-License-Identifier: BSD-3-Clause
// sort_hits: by (first, second). Long lists are dealt into buckets: sorting by comparison took longer than the query.
#pragma once

#include <algorithm>
#include <cstddef>
#include <tuple>
#include <vector>

#include "hinge/core/id.hpp"
#include "hinge/policy/collector.hpp"

namespace hinge {

inline void sort_hits(std::vector<Hit>& hits) {
  const auto before = [](const Hit& a, const Hit& b) {
    return std::tie(a.first, a.second) < std::tie(b.first, b.second);
  };
  std::size_t buckets = 0;
  for (const Hit& hit : hits) buckets = std::max(buckets, index(hit.first) + 1);
  // Buckets pay when there are several hits to share the walk over them.
  if (hits.size() < 64 || buckets > 4 * hits.size()) {
    std::sort(hits.begin(), hits.end(), before);
    return;
  }
  std::vector<std::size_t> end(buckets + 1, 0);
  for (const Hit& hit : hits) ++end[index(hit.first) + 1];
  for (std::size_t b = 0; b < buckets; ++b) end[b + 1] += end[b];
  std::vector<Hit> sorted(hits.size());
  for (const Hit& hit : hits) sorted[end[index(hit.first)]++] = hit;  // end[b] runs from the start of b to its end
  std::size_t start = 0;
  for (std::size_t b = 0; b < buckets; ++b) {
    const auto at = [&](std::size_t k) { return sorted.begin() + static_cast<std::ptrdiff_t>(k); };
    std::sort(at(start), at(end[b]), before);
    start = end[b];
  }
  hits.swap(sorted);
}

}  // namespace hinge
