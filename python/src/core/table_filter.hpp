// SPDX-License-Identifier: BSD-3-Clause
// TableFilter: a pair filter from data: excluded pairs of primitives, and a matrix of admitted pairs of groups.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "hinge/core/error.hpp"
#include "hinge/core/id.hpp"
#include "hinge/policy/pair_filter.hpp"

namespace hinge::python {

/// Admits a pair if its two groups are admitted and the pair is not excluded. Copies share constant data.
class TableFilter {
 public:
  /// group_of: one group below `groups` per primitive. admitted: groups x groups, row-major and symmetric. excluded:
  /// pairs of different primitives, in any order. Throws ModelError otherwise.
  TableFilter(std::vector<std::uint32_t> group_of, std::size_t groups, std::vector<std::uint8_t> admitted,
              const std::vector<std::pair<std::uint32_t, std::uint32_t>>& excluded)
      : data_(make(std::move(group_of), groups, std::move(admitted), excluded)) {}

  bool admits(PrimitiveId i, PrimitiveId j) const noexcept {
    const Data& d = *data_;
    if (d.admitted[d.group_of[index(i)] * d.groups + d.group_of[index(j)]] == 0) return false;
    const auto list = excluded(i);
    return list.empty() || !std::binary_search(list.begin(), list.end(), j);
  }
  std::span<const PrimitiveId> excluded(PrimitiveId i) const noexcept {
    return std::span(data_->excluded)
        .subspan(data_->start[index(i)], data_->start[index(i) + 1] - data_->start[index(i)]);
  }
  std::size_t size() const noexcept { return data_->group_of.size(); }

 private:
  struct Data {
    std::vector<std::uint32_t> group_of;
    std::size_t groups = 0;
    std::vector<std::uint8_t> admitted;
    std::vector<std::size_t> start;
    std::vector<PrimitiveId> excluded;
  };
  static std::shared_ptr<const Data> make(std::vector<std::uint32_t> group_of, std::size_t groups,
                                          std::vector<std::uint8_t> admitted,
                                          const std::vector<std::pair<std::uint32_t, std::uint32_t>>& excluded) {
    const std::size_t size = group_of.size();
    for (std::size_t g = 0; g < groups; ++g)
      for (std::size_t h = 0; h < g; ++h)
        if (admitted[g * groups + h] != admitted[h * groups + g])
          throw ModelError("admitted: (" + std::to_string(g) + ", " + std::to_string(h) + ") and its mirror differ");
    for (const std::uint32_t group : group_of)
      if (group >= groups)
        throw ModelError("groups: group " + std::to_string(group) + ", expected below " + std::to_string(groups));
    std::vector<std::vector<PrimitiveId>> lists(size);
    for (const auto& [i, j] : excluded) {
      if (i >= size || j >= size || i == j)
        throw ModelError("exclude: pair (" + std::to_string(i) + ", " + std::to_string(j) +
                         "), expected two different primitives below " + std::to_string(size));
      lists[i].push_back(id<PrimitiveId>(j));
      lists[j].push_back(id<PrimitiveId>(i));
    }
    auto data = std::make_shared<Data>(Data{std::move(group_of), groups, std::move(admitted), {0}, {}});
    for (auto& list : lists) {
      std::sort(list.begin(), list.end());
      list.erase(std::unique(list.begin(), list.end()), list.end());
      data->excluded.insert(data->excluded.end(), list.begin(), list.end());
      data->start.push_back(data->excluded.size());
    }
    return data;
  }

  std::shared_ptr<const Data> data_;
};

static_assert(ListsExclusions<TableFilter> && KnowsSize<TableFilter>);

}  // namespace hinge::python
