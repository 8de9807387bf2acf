// SPDX-License-Identifier: BSD-3-Clause
// ModelInBlocks: one model with the data of engine/simd, all primitives placed, and random models for it.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <numbers>
#include <vector>

#include "engine/random_mechanism.hpp"
#include "hinge/detail/engine/simd/simd_side.hpp"
#include "hinge/model/model.hpp"
#include "hinge/model/selected_model.hpp"
#include "hinge/model/state.hpp"
#include "hinge/policy/distance_matrix.hpp"
#include "hinge/policy/pair_filter.hpp"

namespace hinge::test {

template <class P>
struct ModelInBlocks {
  static constexpr std::size_t n = detail::simd::width;

  ModelInBlocks(const Model<P>& model, bool inside_groups, double clearance = 0.0)
      : selected(std::make_shared<const SelectedModel<P>>(model, DofSelection::all(model.tree()))),
        state(selected),
        side(std::make_shared<const detail::SimdParts<P>>(
                 inside_groups ? detail::BlockLayout::by_index(*selected) : detail::BlockLayout::by_groups(*selected),
                 detail::ThresholdClasses(UniformClearance(clearance), model.size()), *selected),
             *selected, AdmitAll{}, inside_groups) {}

  void make() {
    side.begin(state, false, {});
    for (std::size_t k = 0; k < side.layout().entries.size(); ++k) side.blocks().refresh(k, state);
    for (std::uint32_t b = 0; b < side.layout().block_count(); ++b) side.blocks().block(b, state);
  }
  /// The primitive of a slot in double, which decides pairs.
  const P& primitive(std::size_t slot) {
    return side.blocks().exact(static_cast<std::uint32_t>(slot / n), state)[slot % n];
  }
  /// The floats of a slot, and of a block.
  const float* floats(std::size_t slot) const {
    return side.blocks().packed(static_cast<std::uint32_t>(slot / n)) + slot % n;
  }
  bool rigid(std::size_t slot) const { return side.layout().blocks[slot / n].rigid; }
  std::size_t slots() const { return side.layout().primitive.size(); }

  std::shared_ptr<const SelectedModel<P>> selected;
  State<P> state;
  detail::SimdSide<P> side;
};

/// A random rotation; in half of the cases nearly one with the largest sums of absolute entries.
inline Mat3 wide_rotation(Random& random) {
  Mat3 r = random.pose(1.0).rotation;
  if (random.one_in(2)) {
    const Vec3 axis = Vec3(Vec3(1, 1, 1) + random.vector(1e-3)).normalized();
    r = rotation_about(axis, std::numbers::pi);  // entries of magnitude 1/3 and 2/3
  }
  return r;
}

/// Random poses: each rigid group rotates about `offset` and moves by up to `travel`.
inline std::vector<Pose> turned(std::size_t groups, const Vec3& offset, double travel, Random& random) {
  std::vector<Pose> poses(groups);
  for (std::size_t g = 1; g < poses.size(); ++g) {
    poses[g].rotation = wide_rotation(random);
    poses[g].translation = Vec3(offset - poses[g].rotation * offset + random.vector(travel));
  }
  return poses;
}

/// Links on the world, each with `per_link` primitives made by make(random, offset).
template <class P, class Make>
Model<P> separate_links(std::size_t links, std::size_t per_link, const Vec3& offset, Random& random, const Make& make) {
  ModelBuilder<P> builder;
  for (std::size_t l = 0; l < links; ++l) {
    std::vector<P> primitives;
    for (std::size_t k = 0; k < per_link; ++k) primitives.push_back(make(random, offset));
    builder.add_link(world, Revolute{{0, 0, 1}, offset, {}, {}}, primitives);
  }
  return builder.finish();
}

}  // namespace hinge::test
