// SPDX-License-Identifier: BSD-3-Clause
// KinematicTree: links joined by joints as a spanning tree, plus the closures that turn it into cycles.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "hinge/core/error.hpp"
#include "hinge/core/finite.hpp"
#include "hinge/core/id.hpp"
#include "hinge/core/number_text.hpp"
#include "hinge/core/pose.hpp"
#include "hinge/kinematics/joint.hpp"

namespace hinge {

/// A cycle of the mechanism: two links that the spanning tree does not join must agree on two points of a line (the
/// hinge or bond that closes the cycle). Points in the frames of the two links, model length unit.
/// With `lengths`, less is asked: points 0 are the ends of a bond and points 1 their neighbours, and only the distances
/// 0-0, 0-1 and 1-0 (first link - second link) are kept: the bond's length and its two angles, none of its torsions.
struct Closure {
  LinkId first{};
  LinkId second{};
  std::array<Vec3, 2> in_first{};
  std::array<Vec3, 2> in_second{};
  std::string name{};
  std::optional<std::array<double, 3>> lengths{};
};

/// The points whose distances a closure with lengths keeps: of the first link and of the second.
inline constexpr std::array<std::array<std::size_t, 2>, 3> kept_lengths{{{0, 0}, {0, 1}, {1, 0}}};

/// Link 0 is the world; every other link hangs on an earlier one by one joint. Degrees of freedom are numbered in the
/// order their links were added. A configuration is one value per DOF: rad (revolute) or model length unit (prismatic).
class KinematicTree {
 public:
  KinematicTree() : parent_{world}, joint_(1), dof_of_link_(1) {}

  /// Adds a link. ModelError: unknown parent, an axis that is zero or not finite, an axis point that is no length, an
  /// origin that is no rigid placement. What is refused, here and below, leaves the tree as it was.
  LinkId add_link(LinkId parent, Joint joint);
  /// The link add_link would add, with its axis at unit length; the same refusals.
  Joint checked(LinkId parent, Joint joint) const;

  /// Adds a closure. ModelError: unknown or equal links, points that are no lengths, lengths not above 0.
  void add_closure(Closure closure);

  std::size_t link_count() const noexcept { return parent_.size(); }
  std::size_t dof_count() const noexcept { return link_of_dof_.size(); }
  LinkId parent(LinkId link) const noexcept { return parent_[index(link)]; }
  const Joint& joint(LinkId link) const noexcept { return joint_[index(link)]; }
  LinkId link_of(DofId dof) const noexcept { return link_of_dof_[index(dof)]; }
  /// The DOF of a link's own joint; only for links whose joint has one.
  DofId dof_of(LinkId link) const noexcept { return dof_of_link_[index(link)]; }
  std::span<const Closure> closures() const noexcept { return closures_; }

 private:
  std::vector<LinkId> parent_;
  std::vector<Joint> joint_;
  std::vector<DofId> dof_of_link_;
  std::vector<LinkId> link_of_dof_;
  std::vector<Closure> closures_;
};

/// Largest distance (model length unit) between the two positions a closure's points have, given the poses of its
/// links; of a closure with lengths, the largest departure from one of them.
inline double closure_residual(const Closure& closure, const Pose& first, const Pose& second) noexcept {
  double worst = 0.0;
  if (closure.lengths) {
    for (std::size_t k = 0; k < 3; ++k) {
      const Vec3 apart = first * closure.in_first[kept_lengths[k][0]] - second * closure.in_second[kept_lengths[k][1]];
      worst = std::max(worst, std::abs(norm(apart) - (*closure.lengths)[k]));
    }
    return worst;
  }
  for (std::size_t k = 0; k < 2; ++k) {
    const Vec3 apart = first * closure.in_first[k] - second * closure.in_second[k];
    worst = std::max(worst, std::sqrt(squared_norm(apart)));
  }
  return worst;
}

inline Joint KinematicTree::checked(LinkId parent, Joint joint) const {
  const std::string who = "link " + std::to_string(link_count()) + (joint.name.empty() ? "" : " (" + joint.name + ")");
  if (index(parent) >= link_count())
    throw ModelError(who + ": parent " + std::to_string(index(parent)) + " does not exist yet");
  if (!is_rigid(joint.origin))
    throw ModelError(who + ": its origin is not a rigid placement (finite, R R^T = 1 within 1e-9, det 1)");
  if (!is_finite(joint.axis)) throw ModelError(who + ": the axis is not finite");
  if (!is_length(joint.point)) throw ModelError(who + ": the axis point is not finite, or beyond 2^1000");
  if (!joint.has_dof()) return joint;
  // By a power of two first, which rounds nothing: the squares of a tiny or huge axis leave the range of doubles.
  double largest = 0.0;
  for (const double x : joint.axis) largest = std::max(largest, std::abs(x));
  if (largest == 0.0) throw ModelError(who + ": the axis has length 0, expected any other");
  int exponent = 0;
  std::frexp(largest, &exponent);
  for (double& x : joint.axis) x = std::ldexp(x, -exponent);
  joint.axis /= std::sqrt(squared_norm(joint.axis));
  return joint;
}

inline LinkId KinematicTree::add_link(LinkId parent, Joint joint) {
  joint = checked(parent, std::move(joint));
  const LinkId link = id<LinkId>(link_count());
  parent_.push_back(parent);
  dof_of_link_.push_back(id<DofId>(dof_count()));
  if (joint.has_dof()) link_of_dof_.push_back(link);
  joint_.push_back(std::move(joint));
  return link;
}

inline void KinematicTree::add_closure(Closure closure) {
  const std::string who =
      "closure " + std::to_string(closures_.size()) + (closure.name.empty() ? "" : " (" + closure.name + ")");
  if (index(closure.first) >= link_count() || index(closure.second) >= link_count())
    throw ModelError(who + ": joins a link that does not exist");
  if (closure.first == closure.second) throw ModelError(who + ": joins a link with itself");
  for (std::size_t k = 0; k < 2; ++k)
    if (!is_length(closure.in_first[k]) || !is_length(closure.in_second[k]))
      throw ModelError(who + ": a point is not finite, or beyond 2^1000");
  for (std::size_t k = 0; closure.lengths && k < 3; ++k)
    if (const double length = (*closure.lengths)[k]; !(length > 0.0) || !is_length(length))
      throw ModelError(who + ": kept length " + number_text(k) + " is " + number_text(length) +
                       ", expected a finite length above 0");
  closures_.push_back(std::move(closure));
}

}  // namespace hinge
