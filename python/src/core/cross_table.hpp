// SPDX-License-Identifier: BSD-3-Clause
// CrossTable: a filter of pairs between two models, from data.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <utility>
#include <vector>

#include "hinge/core/id.hpp"
#include "hinge/policy/pair_filter.hpp"

namespace hinge::python {

/// Admits the pairs (primitive of this model, primitive of the other) whose groups are admitted, except listed ones.
/// Copies share constant data.
class CrossTable {
 public:
  struct Data {
    std::vector<std::uint32_t> group, other_group;  ///< per primitive of each model
    std::size_t columns = 0;                        ///< number of groups of the other model
    std::vector<std::uint8_t> admitted;             ///< row-major; empty: all
    std::vector<std::pair<std::uint32_t, std::uint32_t>> excluded;
  };
  explicit CrossTable(Data data) {
    std::sort(data.excluded.begin(), data.excluded.end());
    data_ = std::make_shared<const Data>(std::move(data));
  }

  bool admits(PrimitiveId i, PrimitiveId j) const noexcept {
    const Data& d = *data_;
    const std::pair pair(static_cast<std::uint32_t>(index(i)), static_cast<std::uint32_t>(index(j)));
    if (!d.admitted.empty() && d.admitted[d.group[pair.first] * d.columns + d.other_group[pair.second]] == 0)
      return false;
    return d.excluded.empty() || !std::binary_search(d.excluded.begin(), d.excluded.end(), pair);
  }

 private:
  std::shared_ptr<const Data> data_;
};

static_assert(PairFilter<CrossTable>);

}  // namespace hinge::python
