// SPDX-License-Identifier: BSD-3-Clause
// sort_hits: by (first, second). Long lists are dealt into buckets: sorting by comparison took longer than the query.
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
  // Buckets pay when there are several hits to share the walk over them.
  if (hits.size() < 64 || buckets > 4 * hits.size()) {
    std::sort(hits.begin(), hits.end(), before);
    return;
  }
  // By the second, then by the first, each pass keeping the order of equals.
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
