// SPDX-License-Identifier: BSD-3-Clause
// SimdParts: what engine/simd makes once of a model: its blocks, threshold classes and constant coordinates.
#pragma once

#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

#include "hinge/core/id.hpp"
#include "hinge/detail/engine/simd/block_layout.hpp"
#include "hinge/detail/engine/simd/rigid_blocks.hpp"
#include "hinge/detail/engine/simd/threshold_classes.hpp"
#include "hinge/detail/primitive/batch.hpp"
#include "hinge/detail/simd/lanes.hpp"
#include "hinge/model/selected_model.hpp"
#include "hinge/policy/primitive.hpp"

namespace hinge::detail {

/// The constant data of one layout, shared by copies of an engine.
template <Primitive P>
struct SimdParts {
  SimdParts(BlockLayout blocks, ThresholdClasses threshold_classes, const SelectedModel<P>& model)
      : layout(std::move(blocks)),
        classes(std::move(threshold_classes)),
        rigid(layout, model, classes),
        position_class(layout.block_count() * Batch<P>::floats) {
    for (std::size_t slot = 0; slot < layout.primitive.size(); ++slot) {
      const std::uint32_t i = layout.primitive[slot];
      position_class[slot / simd::width * Batch<P>::floats + slot % simd::width] = classes.class_of(i);
      if (slot % simd::width == 0) mixed_slot.push_back(static_cast<std::uint32_t>(mixed_group.size()));
      if (layout.blocks[slot / simd::width].rigid) continue;
      mixed.push_back(model.primitives()[i]);
      mixed_group.push_back(static_cast<std::uint32_t>(index(model.group_of(id<PrimitiveId>(i)))));
    }
  }

  BlockLayout layout;
  ThresholdClasses classes;
  RigidBlocks<P> rigid;
  std::vector<std::uint8_t> position_class;  ///< threshold class at the position of each primitive's floats
  std::vector<std::uint32_t> mixed_slot;     ///< per block: start of its slots in the next two vectors, if it is mixed
  std::vector<P> mixed;                      ///< primitives of mixed blocks, in their groups' frames
  std::vector<std::uint32_t> mixed_group;    ///< their groups
};

}  // namespace hinge::detail
