// SPDX-License-Identifier: BSD-3-Clause
// SphereBatch: tests models of spheres at sixteen configurations at once, one per SIMD lane.
#pragma once

#include <algorithm>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <numeric>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "hinge/core/error.hpp"
#include "hinge/core/id.hpp"
#include "hinge/detail/batch/configuration_block.hpp"
#include "hinge/detail/batch/configuration_count.hpp"
#include "hinge/detail/batch/lane_kinematics.hpp"
#include "hinge/detail/batch/sphere_bodies.hpp"
#include "hinge/detail/simd/lanes.hpp"
#include "hinge/model/model.hpp"
#include "hinge/model/selected_model.hpp"
#include "hinge/model/state.hpp"
#include "hinge/policy/pair_filter.hpp"
#include "hinge/primitive/sphere.hpp"

namespace hinge {

/// Tests whether an admitted pair of spheres touches or overlaps. Verdicts equal those of a Hierarchy with clearance 0,
/// bit for bit: floats decide outside a proven error band, doubles inside it (docs/explanation/sphere_batch.md).
/// Obstacles are spheres on the world link or on links fixed to it; obstacles on separate links are culled separately.
/// One per thread; queries do not allocate.
class SphereBatch {
 public:
  static constexpr std::size_t size = detail::simd::width;  ///< configurations in a full block

  /// Frees every DOF. The filter is evaluated only here. Throws ModelError if the filter was made for another number of
  /// primitives.
  template <PairFilter F>
  SphereBatch(const Model<Sphere>& model, const F& filter)
      : SphereBatch(model, DofSelection::all(model.tree()), filter) {}
  /// Frees only the selected DOF; all others stay at their reference. Throws ModelError also for a selection of another
  /// tree.
  template <PairFilter F>
  SphereBatch(const Model<Sphere>& model, const DofSelection& selection, const F& filter)
      : SphereBatch(std::make_shared<const SelectedModel<Sphere>>(checked(model, filter), selection), filter) {}

  // --- A block holds 1 to 16 configurations, one after the other, dof_count() values each (rad or model length unit).
  // Both queries throw ConfigurationError if the number of values is wrong, or a value is not finite or too long a
  // slide. ---

  /// Returns true if any configuration of the block collides. Stops at the first hit.
  bool any(std::span<const double> block) {
    const detail::PresentBlock present(block_, block);
    const detail::simd::Bits lanes = place(block);
    for (const detail::BodyPair& pair : bodies_.pairs())
      if (hits<true>(pair, lanes) != 0) return true;
    return false;
  }

  /// Returns a mask: bit k is set if configuration k collides.
  std::uint32_t each(std::span<const double> block) {
    const detail::PresentBlock present(block_, block);
    const detail::simd::Bits lanes = place(block);
    detail::simd::Bits hit = 0;
    for (const detail::BodyPair& pair : bodies_.pairs()) {
      hit |= hits<false>(pair, lanes & ~hit);
      if (hit == lanes) break;
    }
    return hit;
  }

  /// Sorts the pairs of links by the number of these configurations in which they collide; queries test them in this
  /// order. Answers do not change. Any number of configurations. Throws ConfigurationError as the queries do.
  void learn(std::span<const double> configurations);

  /// Number of values per configuration.
  std::size_t dof_count() const noexcept { return exact_.model().selection().size(); }
  /// Number of sphere pairs that are tested.
  std::size_t pair_count() const noexcept { return bodies_.sphere_pair_count(); }
  /// Number of pairs decided in double, over all queries so far.
  std::uint64_t decided_count() const noexcept { return decided_; }

 private:
  struct Survivor {
    std::uint32_t ball = 0;
    detail::simd::Bits lanes = 0;
  };

  template <PairFilter F>
  SphereBatch(std::shared_ptr<const SelectedModel<Sphere>> model, const F& filter)
      : bodies_(model, filter),
        exact_(std::move(model)),
        is_placed_(bodies_.bodies().size()),
        enclosing_centres_(bodies_.bodies().size()),
        centres_(bodies_.balls().size()),
        near_a_(bodies_.balls().size()),
        near_b_(bodies_.balls().size()) {}

  template <PairFilter F>
  static const Model<Sphere>& checked(const Model<Sphere>& model, const F& filter) {
    if constexpr (KnowsSize<F>)
      if (filter.size() != model.size())
        throw ModelError("pair filter made for " + std::to_string(filter.size()) + " primitives, the model has " +
                         std::to_string(model.size()));
    return model;
  }

  detail::simd::Bits place(std::span<const double> block);
  void place_balls(std::size_t body) noexcept;
  std::size_t find_near(const detail::SphereBody& body, std::size_t other, detail::simd::Bits& lanes,
                        Survivor* to) const noexcept;
  template <bool first_only>
  detail::simd::Bits hits(const detail::BodyPair& pair, detail::simd::Bits lanes);
  detail::simd::Bits test_pair(detail::simd::Bits lanes, PrimitiveId i, PrimitiveId j);

  [[gnu::always_inline]] static detail::simd::Float16 squared_distance(const detail::LaneVector& a,
                                                                       const detail::LaneVector& b) noexcept {
    const detail::LaneVector d = a - b;
    return d.x * d.x + d.y * d.y + d.z * d.z;
  }
  /// Lanes that floats cannot rule out. NaN counts as near.
  [[gnu::always_inline]] static detail::simd::Bits not_beyond(float near_squared,
                                                              const detail::simd::Float16& squared) noexcept {
    return ~detail::simd::Bits(less(detail::simd::Float16(near_squared), squared));
  }

  detail::SphereBodies bodies_;
  State<Sphere> exact_;
  std::span<const double> block_{};  // while a query runs
  std::size_t exact_lane_ = size;    // lane that exact_ is placed at; `size`: no lane of this block
  std::uint64_t decided_ = 0;
  std::vector<std::uint8_t> is_placed_;                // per body
  std::vector<detail::LaneVector> enclosing_centres_;  // per body
  std::vector<detail::LaneVector> centres_;            // per ball, of placed bodies
  std::vector<Survivor> near_a_, near_b_;              // scratch
};

/// Places the enclosing balls of all bodies. Returns the lanes that hold a configuration.
inline detail::simd::Bits SphereBatch::place(std::span<const double> block) {
  const std::size_t count = detail::check_block(block, dof_count(), *exact_.model().groups());
  exact_lane_ = size;
  detail::LaneKinematics& kinematics = bodies_.kinematics();
  bodies_.cover_slide(kinematics.largest_slide(block, dof_count()));
  kinematics.set(block, dof_count());
  const auto bodies = bodies_.bodies();
  for (std::size_t k = 0; k < bodies.size(); ++k) {
    is_placed_[k] = 0;
    enclosing_centres_[k] = bodies[k].ball.placed_by(kinematics[bodies[k].group]);
  }
  return (detail::simd::Bits{1} << count) - 1;
}

inline void SphereBatch::place_balls(std::size_t body) noexcept {
  if (is_placed_[body] != 0) return;
  is_placed_[body] = 1;
  const detail::SphereBody& b = bodies_.bodies()[body];
  const detail::LaneFrame& frame = bodies_.kinematics()[b.group];
  for (std::size_t k = b.first; k < b.first + b.count; ++k) centres_[k] = bodies_.balls()[k].placed_by(frame);
}

/// Finds the balls near the ball around the other body, and the lanes in which they are near. `lanes` is reduced to the
/// union of these lanes.
inline std::size_t SphereBatch::find_near(const detail::SphereBody& body, std::size_t other, detail::simd::Bits& lanes,
                                          Survivor* to) const noexcept {
  const detail::LaneVector centre = enclosing_centres_[other];
  const float reach = bodies_.bodies()[other].ball.grown;
  std::size_t count = 0;
  detail::simd::Bits any = 0;
  for (std::uint32_t k = body.first; k < body.first + body.count; ++k) {
    const float near = bodies_.balls()[k].grown + reach;
    const detail::simd::Bits in = not_beyond(near * near, squared_distance(centres_[k], centre)) & lanes;
    to[count] = {k, in};
    count += in != 0 ? 1 : 0;
    any |= in;
  }
  lanes = any;
  return count;
}

/// Returns the lanes in which the two bodies touch; with first_only, at least one of these lanes.
template <bool first_only>
detail::simd::Bits SphereBatch::hits(const detail::BodyPair& pair, detail::simd::Bits lanes) {
  lanes &= not_beyond(pair.near_squared, squared_distance(enclosing_centres_[pair.a], enclosing_centres_[pair.b]));
  if (lanes == 0) return 0;
  const detail::SphereBody& a = bodies_.bodies()[pair.a];
  const detail::SphereBody& b = bodies_.bodies()[pair.b];
  place_balls(pair.b);
  const std::size_t count_b = find_near(b, pair.a, lanes, near_b_.data());
  if (lanes == 0) return 0;
  place_balls(pair.a);
  const std::size_t count_a = find_near(a, pair.b, lanes, near_a_.data());
  detail::simd::Bits hit = 0;
  for (std::size_t i = 0; i < count_a; ++i) {
    const Survivor in_a = near_a_[i];
    const detail::LaneBall& p = bodies_.balls()[in_a.ball];
    for (std::size_t j = 0; j < count_b; ++j) {
      const Survivor in_b = near_b_[j];
      const detail::simd::Bits open = in_a.lanes & in_b.lanes & ~hit;
      if (open == 0) continue;
      const detail::LaneBall& q = bodies_.balls()[in_b.ball];
      const detail::simd::Float16 squared = squared_distance(centres_[in_a.ball], centres_[in_b.ball]);
      const float near = p.grown + q.grown;
      const detail::simd::Bits maybe = not_beyond(near * near, squared) & open;
      if (maybe == 0 || !bodies_.admitted(pair, in_a.ball - a.first, in_b.ball - b.first)) continue;
      const float sure = p.shrunk + q.shrunk;
      const detail::simd::Bits surely = sure > 0 ? less(squared, detail::simd::Float16(sure * sure)) & maybe : 0;
      hit |= surely | test_pair(maybe & ~surely, bodies_.primitive(in_a.ball), bodies_.primitive(in_b.ball));
      if (first_only && hit != 0) return hit;
    }
  }
  return hit;
}

/// Returns the lanes in which the two spheres touch, decided in double.
inline detail::simd::Bits SphereBatch::test_pair(detail::simd::Bits lanes, PrimitiveId i, PrimitiveId j) {
  detail::simd::Bits hit = 0;
  for (; lanes != 0; lanes &= lanes - 1) {
    const auto lane = static_cast<std::size_t>(std::countr_zero(lanes));
    if (exact_lane_ != lane) exact_.update(block_.subspan(lane * dof_count(), dof_count()));
    exact_lane_ = lane;
    ++decided_;
    if (closer_than(exact_.alone(i), exact_.alone(j), 0.0)) hit |= detail::simd::Bits{1} << lane;
  }
  return hit;
}

inline void SphereBatch::learn(std::span<const double> configurations) {
  const std::size_t dof = dof_count();
  detail::configuration_count(configurations, dof);  // checks the number of values
  const auto pairs = bodies_.pairs();
  std::vector<std::pair<std::int64_t, detail::BodyPair>> ranked;
  for (const detail::BodyPair& pair : pairs) ranked.emplace_back(0, pair);
  for (std::size_t k = 0; k < configurations.size(); k += size * dof) {
    const auto block = configurations.subspan(k, std::min(size * dof, configurations.size() - k));
    const detail::PresentBlock present(block_, block);
    const detail::simd::Bits lanes = place(block);
    for (std::size_t p = 0; p < pairs.size(); ++p) ranked[p].first -= std::popcount(hits<false>(pairs[p], lanes));
  }
  std::stable_sort(ranked.begin(), ranked.end(), [](const auto& x, const auto& y) { return x.first < y.first; });
  for (std::size_t p = 0; p < pairs.size(); ++p) pairs[p] = ranked[p].second;
}

}  // namespace hinge
