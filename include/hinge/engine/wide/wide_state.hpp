// SPDX-License-Identifier: BSD-3-Clause
// WideState: what changes with the configuration: float coordinates of the blocks and boxes, made when first touched.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <memory>
#include <vector>

#include "hinge/bounds/float_box.hpp"
#include "hinge/engine/wide/block_layout.hpp"
#include "hinge/engine/wide/rigid_blocks.hpp"
#include "hinge/kinematics/frame.hpp"
#include "hinge/model/placement.hpp"
#include "hinge/primitive/batch.hpp"

namespace hinge {

/// The constant half, shared by copies of an engine.
template <Primitive P>
struct WideParts {
  BlockLayout layout;
  ThresholdClasses classes;
  RigidBlocks<P> rigid;
  std::vector<std::uint8_t> slot_class;  ///< threshold class per slot

  WideParts(BlockLayout blocks, ThresholdClasses threshold_classes, const SelectedModel<P>& model)
      : layout(std::move(blocks)), classes(std::move(threshold_classes)), rigid(layout, model, classes) {
    for (const std::uint32_t i : layout.primitive) slot_class.push_back(classes.class_of(i));
  }
};

/// Coordinates are (world - origin) * scale in float. Everything is made from the placement when first asked for in an
/// update, and kept while its groups stand still.
template <Primitive P>
class WideState {
 public:
  explicit WideState(std::shared_ptr<const WideParts<P>> parts)
      : parts_(std::move(parts)),
        packed_(parts_->layout.block_count() * Batch<P>::floats),
        block_box_(parts_->layout.block_count()),
        block_at_(parts_->layout.block_count(), 0),
        unit_at_(parts_->layout.units.size(), 0),
        boxes_((parts_->layout.units.size() + simd::width - 1) / simd::width),
        hulls_((boxes_.size() + simd::width - 1) / simd::width),
        tree_rows_(parts_->rigid.rows.size()),
        row_at_(parts_->rigid.rows.size(), 0),
        origin_(parts_->layout.origin) {}

  const WideParts<P>& parts() const noexcept { return *parts_; }
  const Vec3& origin() const noexcept { return origin_; }

  /// To be called before the units of an update are asked for.
  void begin(Placement<P>& placement) noexcept {
    extent_ = translation_ = 0.0;
    if (placement.groups_may_deform() && placement.model().size() != 0) {
      const Aabb box = placement.placed().front().bounds();
      for (int k = 0; k < 3; ++k) origin_[k] = box.middle(k);
    }
  }

  /// Brings the box of a unit up to date, and with it the coordinates of a mixed block. Units are asked for in order.
  void refresh(std::size_t u, Placement<P>& placement) noexcept {
    const Unit& unit = parts_->layout.units[u];
    const std::uint32_t b = unit.first_block;
    const Block& block = parts_->layout.blocks[b];
    const bool current = is_current(block, unit_at_[u], placement);
    BoxRow& row = boxes_[u / simd::width];
    if (!current) {
      unit_at_[u] = placement.update_number();
      FloatBox box;
      if (block.rigid) {
        box = turned(parts_->rigid.unit[u], placement.frame(parts_->layout.groups_of(block).front()));
        block_box_[b] = box;
      } else {
        place_mixed(b, placement);
        box = block_box_[b];
      }
      row.set(u % simd::width, box.grown(parts_->rigid.unit_reach[u]));
    }
    if (block.rigid) {
      const Frame& frame = placement.frame(parts_->layout.groups_of(block).front());
      for (std::size_t k = 12; k < 15; ++k) translation_ = std::max(translation_, std::abs(frame.column[k]));
    }
    const FloatBox box = row.get(u % simd::width);
    extent_ = std::max(extent_, static_cast<double>(std::min(box.extent(), std::numeric_limits<float>::max())));
    if (u % simd::width == simd::width - 1 || u + 1 == unit_at_.size())
      hulls_[u / simd::width / simd::width].set(u / simd::width % simd::width, row.hull());
  }

  const BoxRow& boxes(std::size_t row) const noexcept { return boxes_[row]; }
  /// Boxes around rows of boxes; only of rows all of whose units were refreshed.
  const BoxRow& hulls(std::size_t row) const noexcept { return hulls_[row]; }
  FloatBox box(std::size_t u) const noexcept { return boxes_[u / simd::width].get(u % simd::width); }

  /// Float coordinates of a block, placing it first where it is rigid.
  const float* block(std::uint32_t b, Placement<P>& placement) noexcept {
    if (parts_->layout.blocks[b].rigid && !is_current(parts_->layout.blocks[b], block_at_[b], placement)) {
      block_at_[b] = placement.update_number();
      place_rigid(b, placement);
    }
    return packed(b);
  }
  const float* packed(std::uint32_t b) const noexcept { return packed_.data() + b * Batch<P>::floats; }
  /// Not grown by the reach; tight once the block is placed.
  const FloatBox& block_box(std::uint32_t b) const noexcept { return block_box_[b]; }

  /// World boxes of a row of a unit's tree, grown by the unit's reach.
  const BoxRow& tree_row(std::size_t u, std::uint32_t row, Placement<P>& placement) noexcept {
    const Unit& unit = parts_->layout.units[u];
    const Block& block = parts_->layout.blocks[unit.first_block];
    if (!is_current(block, row_at_[row], placement)) {
      row_at_[row] = placement.update_number();
      turn_row(u, row, placement.frame(parts_->layout.groups_of(block).front()));
    }
    return tree_rows_[row];
  }

  /// How far float distances and boxes may be off, scaled, for things of the size seen since begin(), with thresholds
  /// and cutoffs up to `largest` (scaled). docs/explanation/float_filter.md derives it.
  double band(double largest) const noexcept {
    constexpr double u = 0x1p-24, v = 0x1p-53;
    const double scale = parts_->layout.scale;
    const double world_size = 2 * parts_->rigid.largest_local + translation_ + largest_of(origin_);
    return 6 * u * (2 * extent_ + 10 * static_cast<double>(parts_->rigid.largest_half)) + 8 * u * largest +
           16 * v * world_size * scale;
  }

 private:
  /// Beyond this squares leave the range of floats: such units overlap everything and are judged in double.
  static constexpr float far = 1e15F;

  static double largest_of(const Vec3& x) noexcept {
    return std::max({std::abs(x[0]), std::abs(x[1]), std::abs(x[2])});
  }

  bool is_current(const Block& block, std::uint64_t at, Placement<P>& placement) const noexcept {
    if (!placement.few_moved()) return at == placement.update_number() || (at != 0 && is_static(block, placement));
    for (const GroupId g : parts_->layout.groups_of(block))
      if (placement.version(g) > at) return false;
    return at != 0;
  }
  bool is_static(const Block& block, Placement<P>& placement) const noexcept {
    return block.group_count == 1 && parts_->layout.groups[block.first_group] == GroupId{0} &&
           !placement.groups_may_deform();
  }

  static FloatBox checked(const FloatBox& box) noexcept {
    if (box.extent() <= far) return box;
    FloatBox everything;
    everything.lower.fill(-std::numeric_limits<float>::infinity());
    everything.upper.fill(std::numeric_limits<float>::infinity());
    return everything;
  }

  void place_mixed(std::uint32_t b, Placement<P>& placement) noexcept {
    const BlockLayout& layout = parts_->layout;
    const SelectedModel<P>& model = placement.model();
    float* at = packed_.data() + b * Batch<P>::floats;
    const bool given = placement.groups_may_deform();
    for (std::size_t k = 0; k < simd::width; ++k) {
      const std::uint32_t i = layout.primitive[b * simd::width + k];
      if (given)
        Batch<P>::set(at, k, placement.placed()[i], origin_, layout.scale);
      else
        Batch<P>::place(at, k, model.primitives()[i], placement.frame(model.group_of(id<PrimitiveId>(i))), origin_,
                        layout.scale);
    }
    block_box_[b] = checked(Batch<P>::hull(at));
  }

  void place_rigid(std::uint32_t b, Placement<P>& placement) noexcept {
    const BlockLayout& layout = parts_->layout;
    const Frame& frame = placement.frame(layout.groups_of(layout.blocks[b]).front());
    float* at = packed_.data() + b * Batch<P>::floats;
    if constexpr (TurnsBatch<P>) {
      Batch<P>::turn(parts_->rigid.offsets.data() + b * Batch<P>::floats, rotation(frame),
                     placed(parts_->rigid.block[b].middle, frame), at);
    } else {
      for (std::size_t k = 0; k < simd::width; ++k)
        Batch<P>::place(at, k, placement.model().primitives()[layout.primitive[b * simd::width + k]], frame, origin_,
                        layout.scale);
    }
    block_box_[b] = checked(Batch<P>::hull(at));
  }

  static std::array<float, 9> rotation(const Frame& frame) noexcept {
    std::array<float, 9> r;
    for (std::size_t k = 0; k < 9; ++k) r[k] = static_cast<float>(frame.column[k / 3 * 4 + k % 3]);
    return r;
  }
  std::array<float, 3> placed(const std::array<double, 3>& point, const Frame& frame) const noexcept {
    std::array<double, 4> x;
    FrameColumns(frame).place(point[0], point[1], point[2]).store(x.data());
    std::array<float, 3> r;
    for (std::size_t k = 0; k < 3; ++k)
      r[k] = static_cast<float>((x[k] - origin_[static_cast<Eigen::Index>(k)]) * parts_->layout.scale);
    return r;
  }

  /// The box around the turned box. Its half lengths grow by the rounding of rotation, products and sums.
  FloatBox turned(const LocalBox& local, const Frame& frame) const noexcept {
    constexpr float rounding = 1.0F + 8 * 0x1p-24F;
    const std::array<float, 3> middle = placed(local.middle, frame);
    const std::array<float, 9> r = rotation(frame);
    FloatBox box;
    for (std::size_t k = 0; k < 3; ++k) {
      const float half =
          (std::abs(r[k]) * local.half[0] + std::abs(r[3 + k]) * local.half[1] + std::abs(r[6 + k]) * local.half[2]) *
          rounding;
      box.lower[k] = middle[k] - half;
      box.upper[k] = middle[k] + half;
    }
    return checked(box);
  }

  void turn_row(std::size_t u, std::uint32_t row, const Frame& frame) noexcept {
    using simd::Float16;
    constexpr std::size_t n = simd::width;
    const LocalRow& local = parts_->rigid.rows[row];
    const std::array<float, 9> r = rotation(frame);
    const std::array<float, 3> middle = placed(parts_->rigid.unit[u].middle, frame);
    const Float16 reach(parts_->rigid.unit_reach[u]);
    for (std::size_t k = 0; k < 3; ++k) {
      Float16 m(middle[k]), h(0.0F);
      for (std::size_t j = 0; j < 3; ++j) {
        m = m + Float16(r[3 * j + k]) * Float16(local.middle.data() + j * n);
        h = h + Float16(std::abs(r[3 * j + k])) * Float16(local.half.data() + j * n);
      }
      h = h * Float16(1.0F + 8 * 0x1p-24F) + reach;
      (m - h).store(tree_rows_[row].lower.data() + k * n);
      (m + h).store(tree_rows_[row].upper.data() + k * n);
    }
    if (std::isinf(box(u).upper[0]))  // too far for floats: every block is looked at
      for (std::size_t k = 0; k < n; ++k) {
        FloatBox everything;
        everything.lower.fill(-std::numeric_limits<float>::infinity());
        everything.upper.fill(std::numeric_limits<float>::infinity());
        tree_rows_[row].set(k, everything);
      }
  }

  std::shared_ptr<const WideParts<P>> parts_;
  std::vector<float> packed_;
  std::vector<FloatBox> block_box_;
  std::vector<std::uint64_t> block_at_;  // per rigid block: the update its coordinates are of
  std::vector<std::uint64_t> unit_at_;   // per unit: the update its box is of
  std::vector<BoxRow> boxes_;            // of units, grown by their reach
  std::vector<BoxRow> hulls_;            // of rows of units
  std::vector<BoxRow> tree_rows_;
  std::vector<std::uint64_t> row_at_;
  Vec3 origin_;
  double extent_ = 0.0;       // largest magnitude of a box coordinate, scaled
  double translation_ = 0.0;  // largest magnitude in a translation of a rigid block's frame, model unit
};

}  // namespace hinge
