// SPDX-License-Identifier: BSD-3-Clause
// SphereBodies: the spheres of each link prepared for float lanes, and the pairs of links that are tested.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <memory>
#include <span>
#include <utility>
#include <vector>

#include "hinge/core/finite.hpp"
#include "hinge/core/id.hpp"
#include "hinge/detail/batch/lane_error.hpp"
#include "hinge/detail/batch/lane_kinematics.hpp"
#include "hinge/detail/bounds/float_box.hpp"
#include "hinge/model/selected_model.hpp"
#include "hinge/policy/pair_filter.hpp"
#include "hinge/primitive/sphere.hpp"

namespace hinge::detail {

/// A sphere in its group's lane frame: scaled, radius enlarged and reduced by the error bound of its position.
struct LaneBall {
  float x = 0, y = 0, z = 0;
  float grown = 0;
  float shrunk = 0;  ///< -infinity: never surely touching

  [[gnu::always_inline]] LaneVector placed_by(const LaneFrame& frame) const noexcept { return placed(frame, x, y, z); }
};

/// The spheres of one link; in this file a body is one link with spheres.
struct SphereBody {
  GroupId group{};
  LinkId link{};
  std::uint32_t first = 0;  ///< its balls are first .. first + count - 1
  std::uint32_t count = 0;
  Sphere enclosing{};  ///< in the group's frame
  LaneBall ball{};     ///< ball around all its spheres, enlarged by the error bounds
};

/// A pair of bodies that is tested.
struct BodyPair {
  static constexpr std::size_t all_admitted = std::numeric_limits<std::size_t>::max();
  std::uint32_t a = 0, b = 0;        ///< b has at least as many spheres as a
  float near_squared = 0;            ///< squared sum of the radii of the enclosing balls
  std::size_t table = all_admitted;  ///< start of the pair's rows in admitted(); all_admitted: no rows
};

/// A sphere that encloses the given spheres up to rounding. Its centre is near the optimal one.
inline Sphere enclosing_sphere(std::span<const Sphere> spheres) noexcept {
  Sphere around = spheres.front();
  const auto reach = [&](const Sphere& s) {
    return std::sqrt(squared_norm(Vec3(s.center - around.center))) + s.radius;
  };
  const auto farthest = [&] {
    return *std::max_element(spheres.begin(), spheres.end(),
                             [&](const Sphere& s, const Sphere& t) { return reach(s) < reach(t); });
  };
  // Badoiu and Clarkson: after k steps towards the farthest sphere, the centre is within 1 / k of the optimum.
  for (int k = 1; k <= 1000 && spheres.size() > 1; ++k) {
    const Sphere far = farthest();
    const double distance = reach(far) - far.radius;
    if (!(distance > 0.0)) break;
    const Vec3 tip = far.center + (far.center - around.center) * (far.radius / distance);
    around.center += (tip - around.center) / (k + 1.0);
  }
  around.radius = reach(farthest());
  return around;
}

/// Copies share the model only.
class SphereBodies {
 public:
  template <PairFilter F>
  SphereBodies(std::shared_ptr<const SelectedModel<Sphere>> model, const F& filter)
      : model_(std::move(model)), kinematics_(*model_->groups()) {
    add_bodies();
    for (std::size_t a = 0; a < bodies_.size(); ++a)
      for (std::size_t b = a + 1; b < bodies_.size(); ++b) add_pair(a, b, filter);
    set_slide(least_slide());
  }

  LaneKinematics& kinematics() noexcept { return kinematics_; }
  std::span<const SphereBody> bodies() const noexcept { return bodies_; }
  std::span<const LaneBall> balls() const noexcept { return balls_; }
  PrimitiveId primitive(std::size_t ball) const noexcept { return primitives_[ball]; }
  /// The caller may reorder the pairs.
  std::span<BodyPair> pairs() noexcept { return pairs_; }
  bool admitted(const BodyPair& pair, std::size_t i, std::size_t j) const noexcept {
    return pair.table == BodyPair::all_admitted || admitted_[pair.table + i * bodies_[pair.b].count + j];
  }
  std::size_t sphere_pair_count() const noexcept { return sphere_pair_count_; }

  /// Makes the error bounds valid for values of sliding joints up to `slide`. Wider bounds cost only time. A factor of
  /// 16 avoids recomputing them for every block.
  void cover_slide(double slide) noexcept {
    if (slide > slide_ || (slide < slide_ / 16 && slide_ > least_slide()))
      set_slide(std::max(2 * slide, least_slide()));
  }

 private:
  void add_bodies();
  template <PairFilter F>
  void add_pair(std::size_t a, std::size_t b, const F& filter);
  void set_slide(double slide) noexcept;
  void set_body(SphereBody& body, const LaneError& error) noexcept;
  void set_centre(LaneBall& ball, const Vec3& centre) const noexcept {
    ball.x = static_cast<float>(centre[0] * scale_);
    ball.y = static_cast<float>(centre[1] * scale_);
    ball.z = static_cast<float>(centre[2] * scale_);
  }
  double least_slide() const noexcept { return extent_ * 0x1p-10; }

  std::shared_ptr<const SelectedModel<Sphere>> model_;
  LaneKinematics kinematics_;
  std::vector<SphereBody> bodies_;
  std::vector<LaneBall> balls_;          // sorted by body
  std::vector<PrimitiveId> primitives_;  // per ball
  std::vector<BodyPair> pairs_;
  std::vector<bool> admitted_;  // for pairs that the filter admits partly: one row per sphere of a
  std::size_t sphere_pair_count_ = 0;
  double extent_ = 0.0;  // extent of the model without slides
  double scale_ = 1.0;
  double slide_ = 0.0;
  std::vector<LaneError> errors_;  // per group, for slide_
};

inline void SphereBodies::add_bodies() {
  const auto links = model_->model().links();
  std::vector<Sphere> spheres;
  for (std::size_t l = 0; l < model_->model().tree().link_count(); ++l) {
    SphereBody body{model_->groups()->group_of(id<LinkId>(l)), id<LinkId>(l),
                    static_cast<std::uint32_t>(primitives_.size())};
    spheres.clear();
    for (const PrimitiveId i : model_->primitives_of(body.group)) {
      if (links[index(i)] != body.link) continue;
      primitives_.push_back(i);
      spheres.push_back(model_->primitives()[index(i)]);
    }
    if (spheres.empty()) continue;
    body.count = static_cast<std::uint32_t>(spheres.size());
    body.enclosing = enclosing_sphere(spheres);
    bodies_.push_back(body);
  }
  balls_.resize(primitives_.size());
  kinematics_.compute_errors(0.0, errors_);
  for (const SphereBody& body : bodies_) {
    const Vec3 centre = kinematics_.in_lane_frame(body.group, body.enclosing.center);
    extent_ =
        std::max(extent_, errors_[index(body.group)].reach(std::sqrt(squared_norm(centre))) + body.enclosing.radius);
  }
  // Squares of lengths near 1 are in the middle of the float range.
  if (is_finite(extent_) && extent_ > 0.0) scale_ = std::ldexp(1.0, std::clamp(-std::ilogb(extent_), -1000, 1000));
  kinematics_.set_scale(scale_);
}

template <PairFilter F>
void SphereBodies::add_pair(std::size_t a, std::size_t b, const F& filter) {
  if (bodies_[a].group == bodies_[b].group) return;
  if constexpr (AdmitsLinks<F>)
    if (!filter.admits(bodies_[a].link, bodies_[b].link)) return;
  if (bodies_[b].count < bodies_[a].count) std::swap(a, b);
  std::vector<bool> table;
  for (std::size_t i = 0; i < bodies_[a].count; ++i)
    for (std::size_t j = 0; j < bodies_[b].count; ++j) {
      const PrimitiveId p = primitives_[bodies_[a].first + i], q = primitives_[bodies_[b].first + j];
      table.push_back(filter.admits(p, q) && !model_->constant(p, q));
    }
  const auto count = static_cast<std::size_t>(std::count(table.begin(), table.end(), true));
  if (count == 0) return;
  sphere_pair_count_ += count;
  BodyPair& pair = pairs_.emplace_back(BodyPair{static_cast<std::uint32_t>(a), static_cast<std::uint32_t>(b)});
  if (count == table.size()) return;
  pair.table = admitted_.size();
  admitted_.insert(admitted_.end(), table.begin(), table.end());
}

inline void SphereBodies::set_slide(double slide) noexcept {
  slide_ = slide;
  kinematics_.compute_errors(slide, errors_);
  for (SphereBody& body : bodies_) set_body(body, errors_[index(body.group)]);
  for (BodyPair& pair : pairs_) {
    const float near = bodies_[pair.a].ball.grown + bodies_[pair.b].ball.grown;
    pair.near_squared = near * near;
  }
}

inline void SphereBodies::set_body(SphereBody& body, const LaneError& error) noexcept {
  constexpr float infinity = std::numeric_limits<float>::infinity();
  // 8 u: 2.5 u for the distance, 1.5 u for sum and square of the radii, the rest for the double rule. 2^-60: underflow
  // of squares. Above 2^60 squares overflow; such balls, and NaN, are never decided in float.
  constexpr double relative = 8 * LaneError::u, least = 0x1p-60, most = 0x1p60;
  const auto grown = [&](double length) {
    const double scaled = length * scale_ * (1.0 + relative) + least;
    return scaled <= most ? float_above(scaled) : infinity;
  };
  const auto shrunk = [&](double length) {
    const double scaled = length * scale_ * (1.0 - relative) - least;
    return scaled > 0.0 && scaled <= most ? -float_above(-scaled) : -infinity;
  };
  const auto norm = [](const Vec3& x) { return std::sqrt(squared_norm(x)); };
  const double to_frame = norm(kinematics_.in_group(body.group).translation);
  double largest = 0.0;
  for (std::size_t k = body.first; k < body.first + body.count; ++k) {
    const Sphere& sphere = model_->primitives()[index(primitives_[k])];
    const Vec3 centre = kinematics_.in_lane_frame(body.group, sphere.center);
    const double band = error.of_point(norm(centre), norm(sphere.center) + to_frame);
    set_centre(balls_[k], centre);
    balls_[k].grown = grown(sphere.radius + band);
    balls_[k].shrunk = shrunk(sphere.radius - band);
    largest = band <= largest ? largest : band;  // keeps NaN
  }
  const Vec3 centre = kinematics_.in_lane_frame(body.group, body.enclosing.center);
  const double band = error.of_point(norm(centre), norm(body.enclosing.center) + to_frame);
  set_centre(body.ball, centre);
  body.ball.grown = grown(body.enclosing.radius * error.stretch() + band + largest);
}

}  // namespace hinge::detail
