// SPDX-License-Identifier: BSD-3-Clause
// NearList: pairs that may come too close in some of sixteen neighbouring configurations, tested in all lanes at once.
#pragma once

#include <array>
#include <cmath>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <utility>
#include <vector>

#include "hinge/core/id.hpp"
#include "hinge/core/vec3.hpp"
#include "hinge/detail/batch/displacement_bounds.hpp"
#include "hinge/detail/batch/frame_lanes.hpp"
#include "hinge/detail/bounds/float_box.hpp"
#include "hinge/detail/query/pair_threshold.hpp"
#include "hinge/detail/simd/lanes.hpp"
#include "hinge/model/selected_model.hpp"
#include "hinge/policy/primitive.hpp"
#include "hinge/primitive/point.hpp"

namespace hinge::detail {

/// A pair with its relative position at the reference configuration. Threshold: the result type of threshold_of().
template <class Threshold>
struct NearPair {
  PrimitiveId first, second;
  std::uint32_t first_place, second_place;  // indices in listed_
  std::array<float, 3> apart;               // from the second to the first
  float above, below;                       // the threshold, rounded up and down
  float error;                              // error of the float coordinates
  Threshold threshold;
};

/// Points are tested by their displacement vectors. For other primitives only the lengths of displacements are used.
template <Primitive P, class Threshold>
class NearList {
 public:
  using Pair = NearPair<Threshold>;

  explicit NearList(std::size_t primitives) : place_of_(primitives, nowhere) {}

  std::size_t size() const noexcept { return pairs_.size(); }

  /// Replaces the list. pairs: sorted. The reference of `travel` must be the configuration at which they were found.
  template <class D>
  void assign(std::span<const std::pair<PrimitiveId, PrimitiveId>> pairs, const D& matrix,
              const SelectedModel<P>& model, const DisplacementBounds& travel) {
    for (const Listed& listed : listed_) place_of_[index(listed.primitive)] = nowhere;
    listed_.clear();
    pairs_.clear();
    for (const auto& [i, j] : pairs) {
      const Threshold threshold = threshold_of(matrix, i, j);
      if constexpr (IsPointLike<P>)
        if (threshold == 0.0) continue;
      Pair pair{i, j, place(i, model, travel), place(j, model, travel), {}, 0.0F, 0.0F, 0.0F, threshold};
      if constexpr (by_ways) {
        const Vec3 d =
            listed_[pair.first_place].at_reference.position - listed_[pair.second_place].at_reference.position;
        for (std::size_t k = 0; k < 3; ++k) pair.apart[k] = static_cast<float>(d[static_cast<Eigen::Index>(k)]);
        pair.error = float_above(4 * unit * std::sqrt(squared_norm(d)));
        pair.above = float_above(threshold);
        pair.below = -float_above(-threshold);
      }
      pairs_.push_back(pair);
    }
    const simd::Float16 none(0.0F);
    ways_.assign(by_ways ? listed_.size() : 0, Way{{none, none, none}, 0.0F});
  }

  /// Calls visit(pair, lanes surely below the threshold, lanes possibly below it) -> bool; it returns false to stop. In
  /// all other lanes the pair is free.
  template <class Visit>
  void visit(const FrameLanes& frames, const SelectedModel<P>& model, const DisplacementBounds& travel,
             simd::Bits lanes, const Visit& visit) {
    if constexpr (by_ways) {
      place_ways(frames, model, travel);
      for (const Pair& pair : pairs_) {
        const Way &p = ways_[pair.first_place], &q = ways_[pair.second_place];
        const simd::Float16 squared = squared_distances(pair, p.way - q.way);
        const float error = pair.error + p.error + q.error, near = (pair.above + error) * (1.0F + rounding) + lost;
        // Negated on purpose: overflow and NaN must remain.
        const simd::Bits maybe = ~simd::Bits(less(simd::Float16(near * near), squared)) & lanes;
        if (maybe == 0) [[likely]]
          continue;
        const float sure = (pair.below - error) * (1.0F - rounding) - lost;
        const simd::Bits surely = sure > 0.0F ? less(squared, simd::Float16(sure * sure)) & maybe : 0;
        if (!visit(pair, surely, maybe & ~surely)) return;
      }
    } else {
      for (const Pair& pair : pairs_) {
        const double ways = travel.bound(model.group_of(pair.first)) + travel.bound(model.group_of(pair.second));
        // Covers the rounding of both sums.
        const double near = (pair.threshold + ways) * (1.0 + 0x1p-50);
        const P &p = listed_[pair.first_place].at_reference, &q = listed_[pair.second_place].at_reference;
        if (closer_than(p, q, near) && !visit(pair, simd::Bits{0}, lanes)) return;
      }
    }
  }

 private:
  static constexpr bool by_ways = std::same_as<P, Point>;
  static constexpr std::uint32_t nowhere = std::numeric_limits<std::uint32_t>::max();
  static constexpr double unit = 0x1p-24;  // relative error of one rounding to float
  /// Rounding of the threshold's sum, product and square, and of the squared distance.
  static constexpr float rounding = 16 * static_cast<float>(unit);
  /// Loss of squares by underflow, as a length.
  static constexpr float lost = 0x1p-60F;

  struct Listed {
    PrimitiveId primitive;
    P at_reference;
  };
  struct Way {
    LaneVector way;
    float error;
  };

  std::uint32_t place(PrimitiveId i, const SelectedModel<P>& model, const DisplacementBounds& travel) {
    std::uint32_t& place = place_of_[index(i)];
    if (place == nowhere) {
      place = static_cast<std::uint32_t>(listed_.size());
      const GroupId group = model.group_of(i);
      const P& local = model.primitives()[index(i)];
      listed_.push_back({i, group == GroupId{0} ? local : local.placed(travel.reference(group))});
    }
    return place;
  }

  void place_ways(const FrameLanes& frames, const SelectedModel<P>& model, const DisplacementBounds& travel) noexcept {
    GroupId present{};  // the world does not move
    LaneStep step;
    for (std::size_t k = 0; k < listed_.size(); ++k) {
      const PrimitiveId i = listed_[k].primitive;
      const GroupId group = model.group_of(i);
      if (group == GroupId{0}) continue;
      if (group != present) step.set(frames[group], travel.reference(group));
      present = group;
      ways_[k].way = step.travel(model.primitives()[index(i)].position);
      // Covers the rounding of sums and differences of displacements.
      ways_[k].error = float_above(travel.error(group) + 4 * unit * travel.bound(group));
    }
  }

  [[gnu::always_inline]] static simd::Float16 squared_distances(const Pair& pair, const LaneVector& ways) noexcept {
    using simd::Float16;
    const Float16 x = ways.x + Float16(pair.apart[0]), y = ways.y + Float16(pair.apart[1]),
                  z = ways.z + Float16(pair.apart[2]);
    return x * x + y * y + z * z;
  }

  std::vector<Pair> pairs_;
  std::vector<Listed> listed_;
  simd::AlignedVector<Way> ways_;        // in the order of listed_
  std::vector<std::uint32_t> place_of_;  // per primitive
};

}  // namespace hinge::detail
