// SPDX-License-Identifier: BSD-3-Clause
// PartSet: the tree parts of a model with their boxes, and the pairs of them that are tested.
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

/// A tree part: the primitives of one link in a rigid group, or of several links of it. Lengths in tree units.
struct TreePart {
  BoxId root = 0;
  std::uint32_t top = 0;  ///< the node or leaf below the root's box
  TreeBox root_box{};     ///< copy of the root node's box, for locality
  float root_size = 0.0F;
  std::uint32_t group = 0;
  LinkId link{};        ///< the first link
  float extent = 0.0F;  ///< largest magnitude of a coordinate, without reaches
  float reach = 0.0F;   ///< largest reach
  LocalBox box;         ///< box of the whole tree part in the group's frame, reaches included
};

/// Boxes of sixteen tree parts, and balls around their middles, relative to their trees' origins.
struct alignas(64) PartRow {
  std::array<float, 3 * simd::width> middle{};
  std::array<float, 3 * simd::width> half{};  ///< reaches included, also in the radius
  std::array<float, simd::width> radius{};
};

/// Tree parts sorted by group, and rows of their boxes for tests in lanes.
struct PartSet {
  std::size_t size() const noexcept { return parts.size(); }
  /// Mask of the parts 16 row .. 16 row + 15 that exist.
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

  std::vector<TreePart> parts;  ///< sorted by group
  simd::AlignedVector<PartRow> rows;
  AdmittedPairs tested;  ///< parts of the same group are never tested
};

}  // namespace hinge::detail
