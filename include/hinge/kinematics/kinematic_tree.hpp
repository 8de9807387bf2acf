// SPDX-License-Identifier: BSD-3-Clause
// KinematicTree: links and joints as a spanning tree, and closures that close cycles.
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

/// Closes a cycle of the mechanism: two points on a line (a hinge or a bond) must coincide on two links that have no
/// joint in the spanning tree. Points in the frames of the two links, model length unit. With `lengths` the condition
/// is weaker: points 0 are the ends of a bond and points 1 their neighbours, and only the distances 0-0, 0-1 and 1-0
/// (first link - second link) are fixed. These are the bond length and its two bond angles; torsions stay free.
struct Closure {
  LinkId first{};                                  ///< first link
  LinkId second{};                                 ///< second link
  std::array<Vec3, 2> in_first{};                  ///< points 0 and 1 in the frame of the first link
  std::array<Vec3, 2> in_second{};                 ///< points 0 and 1 in the frame of the second link
  std::string name{};                              ///< for error messages; may be empty
  std::optional<std::array<double, 3>> lengths{};  ///< distances 0-0, 0-1, 1-0, each > 0
};

/// Point indices (first link, second link) of the three distances that a closure with lengths fixes.
inline constexpr std::array<std::array<std::size_t, 2>, 3> kept_lengths{{{0, 0}, {0, 1}, {1, 0}}};

/// Link 0 is the world. Every other link has one joint to a parent with a smaller index. DOF are numbered in the order
/// in which their links were added. A configuration has one value per DOF: rad (revolute) or model length unit
/// (prismatic). Const access is thread-safe. References and spans are valid until the next change of the tree.
class KinematicTree {
 public:
  /// A tree with the world link only.
  KinematicTree() : parent_{world}, joint_(1), dof_of_link_(1) {}

  /// Adds a link and returns its id. ModelError: unknown parent, an axis that is zero or not finite, an axis point that
  /// is not a length, or an origin that is not rigid (is_rigid). The tree does not change on error, here and below.
  LinkId add_link(LinkId parent, Joint joint);
  /// Returns the joint as add_link would store it: with a unit axis. ModelError: as add_link.
  Joint checked(LinkId parent, Joint joint) const;

  /// Adds a closure. ModelError: unknown or equal links, points that are not lengths, or lengths that are not above 0.
  void add_closure(Closure closure);

  /// Returns the number of links, including the world.
  std::size_t link_count() const noexcept { return parent_.size(); }
  /// Returns the number of DOF.
  std::size_t dof_count() const noexcept { return link_of_dof_.size(); }
  /// Returns the parent of a link. The world is its own parent.
  LinkId parent(LinkId link) const noexcept { return parent_[index(link)]; }
  /// Returns the joint between a link and its parent.
  const Joint& joint(LinkId link) const noexcept { return joint_[index(link)]; }
  /// Returns the link that a DOF moves.
  LinkId link_of(DofId dof) const noexcept { return link_of_dof_[index(dof)]; }
  /// Returns the DOF of a link's joint. Only valid when the joint has a DOF.
  DofId dof_of(LinkId link) const noexcept { return dof_of_link_[index(link)]; }
  /// Returns all closures in the order in which they were added.
  std::span<const Closure> closures() const noexcept { return closures_; }

 private:
  std::vector<LinkId> parent_;
  std::vector<Joint> joint_;
  std::vector<DofId> dof_of_link_;
  std::vector<LinkId> link_of_dof_;
  std::vector<Closure> closures_;
};

/// Returns the residual of a closure for the given world poses of its links (model length unit): the largest distance
/// between its paired points or, with lengths, the largest deviation of a distance.
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
    throw ModelError(who + ": parent " + std::to_string(index(parent)) +
                     " does not exist yet, expected a link added before");
  if (!is_rigid(joint.origin))
    throw ModelError(who + ": its origin is not a rigid placement (finite, R R^T = 1 within 1e-9, det 1)");
  if (!is_finite(joint.axis)) throw ModelError(who + ": the axis is not finite");
  if (!is_length(joint.point)) throw ModelError(who + ": the axis point is not finite, or beyond 2^1000");
  if (!joint.has_dof()) return joint;
  // Scale by a power of two first, which is exact: squares of a tiny or huge axis would underflow or overflow.
  double largest = 0.0;
  for (const double x : joint.axis) largest = std::max(largest, std::abs(x));
  if (largest == 0.0) throw ModelError(who + ": the axis has length 0, expected a length above 0");
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
    throw ModelError(who + ": joins a link that does not exist, expected below " + std::to_string(link_count()));
  if (closure.first == closure.second)
    throw ModelError(who + ": joins a link with itself, expected two different links");
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
