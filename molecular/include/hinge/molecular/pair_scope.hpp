// SPDX-License-Identifier: BSD-3-Clause
// PairScope: which pairs of atoms are asked about, by the parts they belong to.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <utility>
#include <vector>

#include "hinge/core/id.hpp"
#include "hinge/molecular/part.hpp"
#include "hinge/molecular/structure.hpp"

namespace hinge::molecular {

/// Empty, every pair is asked about; else those of an atom of one part and one of the other (`between`), and those
/// inside one part (`inside`): the union counts.
class PairScope {
 public:
  PairScope() = default;
  /// ModelError: two parts of `between` that share a residue, which would be neither between nor inside.
  PairScope(const Structure& structure, std::span<const std::pair<Part, Part>> between, std::span<const Part> inside);

  bool asks_all() const noexcept { return data_ == nullptr; }
  /// Atoms of the structure it was made for; any where asks_all().
  bool holds(PrimitiveId i, PrimitiveId j) const noexcept {
    return data_ == nullptr || data_->asked[data_->kind[index(i)] * data_->kinds + data_->kind[index(j)]] != 0;
  }

 private:
  /// Atoms of one kind lie in the same parts.
  struct Data {
    std::vector<std::uint32_t> kind;  // per atom
    std::size_t kinds = 0;
    std::vector<std::uint8_t> asked;  // kind x kind, symmetric
  };
  std::shared_ptr<const Data> data_;  // shared by the copies that engines and threads hold
};

}  // namespace hinge::molecular
