// SPDX-License-Identifier: BSD-3-Clause
// RigidBlocks: blocks and trees of large rigid groups in the group's frame, made once.
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "hinge/bounds/aabb.hpp"
#include "hinge/detail/bounds/float_box.hpp"
#include "hinge/detail/engine/simd/block_layout.hpp"
#include "hinge/detail/engine/simd/threshold_classes.hpp"
#include "hinge/detail/primitive/batch.hpp"
#include "hinge/model/selected_model.hpp"

namespace hinge::detail {

/// Sixteen boxes as middles and half lengths, scaled, relative to the middle of their group's box.
struct alignas(64) LocalRow {
  std::array<float, 3 * simd::width> middle{};
  std::array<float, 3 * simd::width> half{};
};

/// Static sixteen-wide boxes over a group's blocks, without child indices: row r of a level holds the boxes of rows (or
/// blocks) 16 r .. 16 r + 15 of the level below. A group of sixteen blocks or fewer has one row.
struct BlockTree {
  struct Level {
    std::uint32_t first_row = 0;  ///< in RigidBlocks::rows
    std::uint32_t boxes = 0;      ///< number of boxes in all rows of the level
  };
  std::vector<Level> levels;  ///< the first level is above the blocks; the last level has one row
};

/// A box in a group's frame: middle in model units, half lengths scaled and rounded up.
struct LocalBox {
  std::array<double, 3> middle{};
  std::array<float, 3> half{};
};

/// The constant float data of all blocks. Scaled lengths are in the unit of the layout.
template <Primitive P>
struct RigidBlocks {
  RigidBlocks(const BlockLayout& layout, const SelectedModel<P>& model, const ThresholdClasses& classes);

  std::vector<LocalBox> block;  ///< per block; unused for mixed blocks
  std::vector<LocalBox> entry;  ///< per first entry of a rigid group: box of the whole group
  /// per block, if P transforms batches: scaled floats relative to the block's middle
  simd::AlignedVector<float> offsets;
  std::vector<float> reach;        ///< per block: largest reach, scaled, rounded up
  std::vector<float> entry_reach;  ///< per entry: largest reach of its rigid group, or of its mixed block
  float largest_reach = 0.0F;      ///< over all blocks
  std::vector<BlockTree> tree;     ///< per entry; empty if the entry has no tree
  /// Per first entry of a rigid group without a tree: number of its entries, and the first of its rows. In these rows,
  /// the box of entry u is in lane u % 16.
  std::vector<std::uint32_t> flat_count, flat_row;
  std::vector<LocalRow> rows;  ///< rows of all trees, and of all groups without a tree
  float largest_half = 0.0F;   ///< largest half length over all blocks, scaled
  double largest_local = 0.0;  ///< largest magnitude of a coordinate in its group's frame, model unit

 private:
  static LocalBox local_box(const Aabb& box, double scale) noexcept {
    LocalBox local;
    for (int k = 0; k < 3; ++k) {
      const auto i = static_cast<std::size_t>(k);
      local.middle[i] = box.middle(k);
      local.half[i] = float_above(std::max(box.upper[k] - local.middle[i], local.middle[i] - box.lower[k]) * scale *
                                  (1.0 + 0x1p-50));
    }
    return local;
  }
  void make_tree(const BlockLayout& layout, std::size_t u, std::vector<Aabb> level);
  static void set(LocalRow& row, std::size_t lane, const Aabb& box, const LocalBox& whole, double scale) noexcept;
};

template <Primitive P>
RigidBlocks<P>::RigidBlocks(const BlockLayout& layout, const SelectedModel<P>& model, const ThresholdClasses& classes)
    : block(layout.block_count()),
      entry(layout.entries.size()),
      tree(layout.entries.size()),
      flat_count(layout.entries.size()),
      flat_row(layout.entries.size()) {
  std::vector<Aabb> boxes(layout.block_count());
  if constexpr (TransformsBatch<P>) offsets.resize(layout.block_count() * Batch<P>::floats);
  for (std::size_t b = 0; b < layout.block_count(); ++b) {
    double block_reach = 0.0;
    for (std::size_t k = 0; k < simd::width; ++k) {
      const std::uint32_t i = layout.primitive[b * simd::width + k];
      const Aabb box = model.primitives()[i].bounds();
      boxes[b].extend(box);
      block_reach = std::max(block_reach, classes.reach(classes.class_of(i)));
      for (int axis = 0; axis < 3; ++axis)
        largest_local = std::max({largest_local, std::abs(box.lower[axis]), std::abs(box.upper[axis])});
    }
    reach.push_back(float_above(block_reach * layout.scale));
    largest_reach = std::max(largest_reach, reach.back());
    if (!layout.blocks[b].rigid) continue;
    block[b] = local_box(boxes[b], layout.scale);
    largest_half = std::max({largest_half, block[b].half[0], block[b].half[1], block[b].half[2]});
    if constexpr (TransformsBatch<P>) {
      const Vec3 middle(block[b].middle[0], block[b].middle[1], block[b].middle[2]);
      for (std::size_t k = 0; k < simd::width; ++k)
        Batch<P>::set(offsets.data() + b * Batch<P>::floats, k,
                      model.primitives()[layout.primitive[b * simd::width + k]], middle, layout.scale);
    }
  }
  entry_reach.resize(layout.entries.size());
  for (std::size_t u = 0; u < layout.entries.size();) {
    const std::size_t end = layout.group_end(u);
    const std::uint32_t first = layout.entries[u].first_block;
    const std::uint32_t last = layout.entries[end - 1].first_block + layout.entries[end - 1].block_count;
    std::fill(entry_reach.begin() + static_cast<std::ptrdiff_t>(u),
              entry_reach.begin() + static_cast<std::ptrdiff_t>(end),
              *std::max_element(reach.begin() + first, reach.begin() + last));
    if (layout.blocks[first].rigid) {
      Aabb whole;
      for (std::uint32_t b = first; b < last; ++b) whole.extend(boxes[b]);
      entry[u] = local_box(whole, layout.scale);
      if (layout.entries[u].block_count > 1) {
        make_tree(layout, u, {boxes.begin() + first, boxes.begin() + last});
      } else {
        flat_count[u] = static_cast<std::uint32_t>(end - u);
        flat_row[u] = static_cast<std::uint32_t>(rows.size());
        rows.resize(rows.size() + (end - 1) / simd::width - u / simd::width + 1);
        for (std::size_t w = u; w < end; ++w)
          set(rows[flat_row[u] + w / simd::width - u / simd::width], w % simd::width,
              boxes[layout.entries[w].first_block], entry[u], layout.scale);
      }
    }
    u = end;
  }
}

template <Primitive P>
void RigidBlocks<P>::set(LocalRow& row, std::size_t lane, const Aabb& box, const LocalBox& whole,
                         double scale) noexcept {
  // Bound of the relative error of a middle rotated in float, over its three products and sums.
  constexpr double turning_error = 16 * 0x1p-24;
  const LocalBox local = local_box(box, scale);
  double size = 0.0;
  for (std::size_t axis = 0; axis < 3; ++axis)
    size += std::abs(local.middle[axis] - whole.middle[axis]) * scale + static_cast<double>(local.half[axis]);
  for (std::size_t axis = 0; axis < 3; ++axis) {
    row.middle[axis * simd::width + lane] = static_cast<float>((local.middle[axis] - whole.middle[axis]) * scale);
    row.half[axis * simd::width + lane] = float_above(static_cast<double>(local.half[axis]) + turning_error * size);
  }
}

template <Primitive P>
void RigidBlocks<P>::make_tree(const BlockLayout& layout, std::size_t u, std::vector<Aabb> level) {
  do {
    std::vector<Aabb> above;
    tree[u].levels.push_back({static_cast<std::uint32_t>(rows.size()), static_cast<std::uint32_t>(level.size())});
    for (std::size_t first = 0; first < level.size(); first += simd::width) {
      LocalRow row;
      Aabb all;
      for (std::size_t k = 0; k < simd::width && first + k < level.size(); ++k) {
        set(row, k, level[first + k], entry[u], layout.scale);
        all.extend(level[first + k]);
      }
      rows.push_back(row);
      above.push_back(all);
    }
    level = std::move(above);
  } while (level.size() > 1);
}

}  // namespace hinge::detail
