// SPDX-License-Identifier: BSD-3-Clause
// PairScope: which pairs of atoms are tested, by the parts that they belong to.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <utility>
#include <vector>

#include "hinge/core/api.hpp"
#include "hinge/core/id.hpp"
#include "hinge/molecular/part.hpp"
#include "hinge/molecular/structure.hpp"

namespace hinge::molecular {

/// A set of pairs: those with one atom in each part of a pair in `between`, and those with both atoms in one part of
/// `inside`. A default-constructed scope holds every pair. Copies share their data; const members may be called by many
/// threads at once.
class HINGE_API PairScope {
 public:
  PairScope() = default;
  /// Both lists empty: every pair. Throws ModelError if the two parts of a pair in `between` share a residue.
  PairScope(const Structure& structure, std::span<const std::pair<Part, Part>> between, std::span<const Part> inside);

  /// True if the scope holds every pair.
  bool asks_all() const noexcept { return data_ == nullptr; }
  /// True if the pair is in the scope. i, j: atoms of the structure it was made for; any if asks_all().
  bool holds(PrimitiveId i, PrimitiveId j) const noexcept {
    return data_ == nullptr || data_->asked[data_->kind[index(i)] * data_->kinds + data_->kind[index(j)]] != 0;
  }

 private:
  /// A kind is a set of parts: atoms of one kind lie in the same parts.
  struct Data {
    std::vector<std::uint32_t> kind;  // per atom
    std::size_t kinds = 0;
    std::vector<std::uint8_t> asked;  // kind x kind, symmetric
  };
  std::shared_ptr<const Data> data_;  // shared by the copies that engines and threads hold
};

}  // namespace hinge::molecular
