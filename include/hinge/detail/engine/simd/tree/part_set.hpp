// SPDX-License-Identifier: BSD-3-Clause
// PartSet: trees of a model that are held against one another: their boxes, and which of them are tested.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "hinge/core/id.hpp"
#include "hinge/detail/engine/simd/rigid_blocks.hpp"
#include "hinge/detail/engine/simd/tree/admitted_pairs.hpp"
#include "hinge/detail/engine/simd/tree/static_tree.hpp"
#include "hinge/detail/simd/lanes.hpp"

namespace hinge::detail {

/// The primitives of one link, or of several of one group. Lengths in the unit of the trees.
struct TreePart {
  BoxId root = 0;
  std::uint32_t top = 0;  ///< what the root's box holds: a node or a leaf
  TreeBox root_box{};     ///< the same as in its node, all in one place
  float root_size = 0.0F;
  std::uint32_t group = 0;
  LinkId link{};        ///< the first
  float extent = 0.0F;  ///< largest magnitude of a coordinate, without reaches
  float reach = 0.0F;   ///< the largest
  LocalBox box;         ///< in the group's frame, around everything, reaches included
};

/// Sixteen parts' boxes and balls about their middles, relative to their trees' origins.
struct alignas(64) PartRow {
  std::array<float, 3 * simd::width> middle{};
  std::array<float, 3 * simd::width> half{};  ///< reaches included, here and below
  std::array<float, simd::width> radius{};
};

struct PartSet {
  std::size_t size() const noexcept { return parts.size(); }
  /// Bits of the parts 16 row ... 16 row + 15 that there are.
  simd::Bits used(std::size_t row) const noexcept {
    const std::size_t left = parts.size() - row * simd::width;
    return left >= simd::width ? simd::all_bits : (simd::Bits{1} << left) - 1;
  }
  void add(const TreePart& part, const TreeBox& box, float radius) {
    const std::size_t lane = parts.size() % simd::width;
    if (lane == 0) rows.emplace_back();
    PartRow& row = rows.back();
    for (std::size_t k = 0; k < 3; ++k) {
      row.middle[k * simd::width + lane] = box.middle[k];
      row.half[k * simd::width + lane] = box.half[k];
    }
    row.radius[lane] = radius;
    parts.push_back(part);
  }

  std::vector<TreePart> parts;  ///< by group
  simd::AlignedVector<PartRow> rows;
  AdmittedPairs tested;  ///< parts of one group are not
};

}  // namespace hinge::detail
