// SPDX-License-Identifier: BSD-3-Clause
// merge_parts: puts several tree parts of a group under one root, for queries that need not distinguish links.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <numeric>
#include <span>
#include <vector>

#include "hinge/detail/bounds/float_box.hpp"
#include "hinge/detail/engine/simd/tree/part_set.hpp"
#include "hinge/detail/engine/simd/tree/static_tree.hpp"
#include "hinge/detail/simd/lanes.hpp"

namespace hinge::detail {

/// Merges two to sixteen tree parts of one group. Adds two nodes to `store`.
inline TreePart merge_parts(const std::vector<TreePart>& parts, std::span<const std::uint32_t> members,
                            TreeStore& store) {
  TreePart whole = parts[members[0]];
  const auto node = static_cast<std::uint32_t>(store.nodes.size());
  whole.root = static_cast<BoxId>((node + 1) * simd::width);
  whole.top = node;
  TreeNode all, top;
  std::array<double, 3> lower, upper;
  lower.fill(std::numeric_limits<double>::infinity());
  upper.fill(-std::numeric_limits<double>::infinity());
  for (std::size_t lane = 0; lane < members.size(); ++lane) {
    const TreePart& part = parts[members[lane]];
    all.set(lane, part.root_box);
    all.set_child(lane, part.top);
    for (std::size_t k = 0; k < 3; ++k) {
      const auto middle = static_cast<double>(part.root_box.middle[k]),
                 half = static_cast<double>(part.root_box.half[k]);
      lower[k] = std::min(lower[k], middle - half);
      upper[k] = std::max(upper[k], middle + half);
    }
    whole.extent = std::max(whole.extent, part.extent);
    whole.reach = std::max(whole.reach, part.reach);
  }
  for (std::size_t k = 0; k < 3; ++k) {
    whole.root_box.middle[k] = static_cast<float>((lower[k] + upper[k]) / 2);
    const double middle = widened(whole.root_box.middle[k]);
    whole.root_box.half[k] = float_above(std::max(upper[k] - middle, middle - lower[k]) * (1 + 0x1p-50));
  }
  top.set(0, whole.root_box);
  top.set_child(0, node);
  whole.root_size = top.size[0];
  store.nodes.push_back(all);
  store.nodes.push_back(top);
  return whole;
}

/// The radius of a ball around the middle of `box` that contains the members: it covers their balls or `box`,
/// whichever is smaller.
inline float merged_radius(const PartSet& links, std::span<const std::uint32_t> members, const TreeBox& box) {
  double around = 0.0, corner = 0.0;
  for (const std::uint32_t p : members) {
    const PartRow& row = links.rows[p / simd::width];
    double square = 0.0;
    for (std::size_t k = 0; k < 3; ++k) {
      const double off =
          static_cast<double>(row.middle[k * simd::width + p % simd::width]) - static_cast<double>(box.middle[k]);
      square += off * off;
    }
    around = std::max(around, std::sqrt(square) + static_cast<double>(row.radius[p % simd::width]));
  }
  for (const float half : box.half) corner += static_cast<double>(half) * static_cast<double>(half);
  return float_above(std::min(around, std::sqrt(corner)) * (1 + 0x1p-40));
}

/// Merges links of a group that are tested with the same links, up to sixteen into one tree part. The result is empty
/// if no links are merged, and for models with very many links: the search takes quadratic time and memory.
inline PartSet merge_alike(const PartSet& links, TreeStore& store) {
  constexpr std::size_t most_links = 1024;
  const std::size_t n = links.size(), row_count = links.rows.size();
  PartSet alike;
  if (n > most_links) return alike;
  // For each link, all links it is tested with, also later ones.
  std::vector<std::uint16_t> tested(n * row_count, 0);
  const auto set = [&](std::size_t p, std::size_t q) {
    std::uint16_t& word = tested[p * row_count + q / simd::width];
    word = static_cast<std::uint16_t>(word | 1U << q % simd::width);
  };
  const auto tests = [&](std::size_t p, std::size_t q) {
    return (tested[p * row_count + q / simd::width] >> q % simd::width & 1U) != 0;
  };
  for (std::size_t p = 0; p < n; ++p)
    for (std::size_t q = 0; q < p; ++q)
      if ((links.tested.get(p, q / simd::width) >> q % simd::width & 1U) != 0) {
        set(p, q);
        set(q, p);
      }
  const auto row = [&](std::uint32_t p) { return std::span(tested).subspan(std::size_t{p} * row_count, row_count); };
  const auto same = [&](std::uint32_t p, std::uint32_t q) {
    const auto x = row(p), y = row(q);
    return links.parts[p].group == links.parts[q].group && std::equal(x.begin(), x.end(), y.begin(), y.end());
  };
  std::vector<std::uint32_t> order(n), first;  // first[m]: one link of merged part m
  std::iota(order.begin(), order.end(), 0U);
  std::stable_sort(order.begin(), order.end(), [&](std::uint32_t p, std::uint32_t q) {
    if (links.parts[p].group != links.parts[q].group) return links.parts[p].group < links.parts[q].group;
    const auto x = row(p), y = row(q);
    return std::lexicographical_compare(x.begin(), x.end(), y.begin(), y.end());
  });
  if (std::adjacent_find(order.begin(), order.end(), same) == order.end()) return alike;
  for (std::size_t start = 0, end = 0; start < n; start = end) {
    while (end < n && end < start + simd::width && same(order[start], order[end])) ++end;
    const std::span members = std::span(order).subspan(start, end - start);
    const PartRow& own = links.rows[members[0] / simd::width];
    const std::size_t lane = members[0] % simd::width;
    if (members.size() == 1) {
      TreeBox box;
      for (std::size_t k = 0; k < 3; ++k) {
        box.middle[k] = own.middle[k * simd::width + lane];
        box.half[k] = own.half[k * simd::width + lane];
      }
      alike.add(links.parts[members[0]], box, own.radius[lane]);
    } else {
      const TreePart part = merge_parts(links.parts, members, store);
      alike.add(part, part.root_box, merged_radius(links, members, part.root_box));
    }
    first.push_back(members[0]);
  }
  for (std::size_t m = 0, group = 0; m < alike.size(); ++m) {
    if (alike.parts[group].group != alike.parts[m].group) group = m;
    alike.tested.add(group);
    for (std::size_t other = 0; other < group; ++other)
      if (!tests(first[m], first[other])) alike.tested.leave_out(other);
  }
  return alike;
}

}  // namespace hinge::detail
