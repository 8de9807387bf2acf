// SPDX-License-Identifier: BSD-3-Clause
// Scenes from bytes: a small mechanism with adversarial coordinates, thresholds with ties, and excluded pairs.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "fuzz/bytes.hpp"
#include "fuzz/numbers.hpp"
#include "hinge/core/id.hpp"
#include "hinge/kinematics/dof_selection.hpp"
#include "hinge/kinematics/joint.hpp"
#include "hinge/model/model.hpp"
#include "hinge/policy/distance_matrix.hpp"
#include "hinge/policy/pair_filter.hpp"
#include "hinge/primitive/capsule.hpp"
#include "hinge/primitive/point.hpp"
#include "hinge/primitive/sphere.hpp"
#include "hinge/primitive/triangle.hpp"

namespace fuzz {

/// Returns a primitive with adversarial coordinates; capsules and triangles may be degenerate.
template <class P>
P make_primitive(Numbers& numbers);

template <>
inline hinge::Point make_primitive(Numbers& numbers) {
  return {numbers.vector()};
}
template <>
inline hinge::Sphere make_primitive(Numbers& numbers) {
  const hinge::Vec3 centre = numbers.vector();
  return {centre, numbers.positive()};
}
template <>
inline hinge::Capsule make_primitive(Numbers& numbers) {
  const hinge::Vec3 a = numbers.vector();
  const hinge::Vec3 b = numbers.bytes().one_in(4) ? a : numbers.vector();
  return {a, b, numbers.positive()};
}
template <>
inline hinge::Triangle make_primitive(Numbers& numbers) {
  const hinge::Vec3 a = numbers.vector();
  const hinge::Vec3 b = numbers.bytes().one_in(8) ? a : numbers.vector();
  return {a, b, numbers.vector()};
}

/// A filter that excludes a few pairs.
class ExcludedPairs {
 public:
  ExcludedPairs(std::size_t n, Bytes& bytes) : excluded_(n) {
    if (n < 2 || !bytes.one_in(3)) return;
    for (std::size_t k = bytes.below(16); k-- > 0;) {
      const std::size_t i = bytes.byte() % n, j = bytes.byte() % n;
      if (i == j) continue;
      excluded_[i].push_back(hinge::id<hinge::PrimitiveId>(j));
      excluded_[j].push_back(hinge::id<hinge::PrimitiveId>(i));
    }
    for (auto& list : excluded_) {
      std::sort(list.begin(), list.end());
      list.erase(std::unique(list.begin(), list.end()), list.end());
    }
  }
  bool admits(hinge::PrimitiveId i, hinge::PrimitiveId j) const noexcept {
    const auto list = excluded(i);
    return !std::binary_search(list.begin(), list.end(), j);
  }
  std::span<const hinge::PrimitiveId> excluded(hinge::PrimitiveId i) const noexcept {
    return excluded_[hinge::index(i)];
  }
  std::size_t size() const noexcept { return excluded_.size(); }

 private:
  std::vector<std::vector<hinge::PrimitiveId>> excluded_;
};

static_assert(hinge::ListsExclusions<ExcludedPairs>);

/// Thresholds of up to three types. They tie with distances, because both use numbers of the same kind.
struct ThresholdTable {
  explicit ThresholdTable(Numbers& numbers) : types(1 + numbers.bytes().below(3)), entries(types * types) {
    for (std::size_t s = 0; s < types; ++s)
      for (std::size_t t = 0; t <= s; ++t)
        entries[s * types + t] = entries[t * types + s] = numbers.bytes().one_in(4) ? 0.0 : numbers.positive();
  }
  hinge::TypedThresholds of(std::size_t n, Bytes& bytes) const {
    std::vector<std::uint16_t> type(n);
    for (std::uint16_t& t : type) t = static_cast<std::uint16_t>(bytes.below(types));
    return {std::move(type), types, entries};
  }
  std::size_t types;
  std::vector<double> entries;
};

/// Returns a pose; some rotations change no bits of coordinates.
inline hinge::Pose make_pose(Numbers& numbers) {
  hinge::Pose pose;
  switch (numbers.bytes().below(4)) {
    case 0: return pose;
    case 1: pose.rotation << 0, -1, 0, 1, 0, 0, 0, 0, 1; break;
    case 2: pose.rotation = hinge::rotation_about(hinge::Vec3::UnitX(), numbers.number()); break;
    default: break;
  }
  pose.translation = numbers.vector();
  return pose;
}

/// Returns a fixed, prismatic or revolute joint.
inline hinge::Joint make_joint(Numbers& numbers) {
  Bytes& bytes = numbers.bytes();
  hinge::Pose origin;
  if (bytes.one_in(4)) origin = make_pose(numbers);
  hinge::Vec3 axis = hinge::Vec3::Zero();
  axis[static_cast<int>(bytes.below(3))] = 1.0;
  if (bytes.one_in(4)) axis += hinge::Vec3(0.5, -0.25, 2.0);
  switch (bytes.below(4)) {
    case 0: return hinge::Fixed{origin};
    case 1: return hinge::Prismatic{axis, origin, {}};
    default:
      return hinge::Revolute{axis, bytes.bit() ? numbers.vector() : hinge::Vec3(hinge::Vec3::Zero()), origin, {}};
  }
}

/// Returns a model of up to seven links, including the world, with at most `most` primitives in all.
template <hinge::Primitive P>
hinge::Model<P> make_model(Numbers& numbers, std::size_t most) {
  Bytes& bytes = numbers.bytes();
  hinge::ModelBuilder<P> builder;
  std::vector<hinge::LinkId> links{hinge::world};
  for (std::size_t l = bytes.below(7); l-- > 0;)
    links.push_back(builder.add_link(links[bytes.byte() % links.size()], make_joint(numbers)));
  std::vector<std::uint32_t> labels;
  for (std::size_t n = bytes.below(most + 1); n-- > 0;) {
    const std::uint8_t choice = bytes.byte();
    builder.add_primitive(links[choice % links.size()], make_primitive<P>(numbers));
    labels.push_back(choice / 64U);
  }
  if (bytes.one_in(3) && !labels.empty()) builder.set_basic_groups(labels);
  return builder.finish();
}

/// Returns a selection of DOF; the bits of one byte leave DOF out.
inline hinge::DofSelection make_selection(const hinge::KinematicTree& tree, Bytes& bytes) {
  std::vector<hinge::DofId> free;
  const std::uint8_t left_out = bytes.byte();
  for (std::size_t k = 0; k < tree.dof_count(); ++k)
    if ((left_out >> k & 1U) == 0) free.push_back(hinge::id<hinge::DofId>(k));
  return {tree, std::move(free)};
}

}  // namespace fuzz
