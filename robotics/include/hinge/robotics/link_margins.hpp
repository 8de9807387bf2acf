// SPDX-License-Identifier: BSD-3-Clause
// LinkMargins: the distance matrix of robots: radii of grown triangles, and clearances between links.
#pragma once

#include <algorithm>
#include <cstddef>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "hinge/core/id.hpp"
#include "hinge/core/radius_sum.hpp"
#include "hinge/model/model.hpp"
#include "hinge/policy/distance_matrix.hpp"
#include "hinge/policy/pair_filter.hpp"
#include "hinge/primitive/triangle.hpp"
#include "hinge/robotics/robot.hpp"

namespace hinge::robotics {

/// How far two links have to stay apart, m; takes the place of the clearance of all pairs.
struct PairClearance {
  LinkId link1{};
  LinkId link2{};
  double clearance = 0.0;
};

/// M(i, j) = radius(i) + radius(j) + clearance of their links, m, which verdicts take for the real sum. Copies share
/// one constant table.
class LinkMargins {
 public:
  /// ModelError, naming the links: a clearance or radius that is not finite or below 0, a link the robot does not have,
  /// a pair of a link with itself or named twice.
  explicit LinkMargins(const Robot& robot, double clearance = 0.0, std::span<const PairClearance> overrides = {});

  RadiusSum sum(PrimitiveId i, PrimitiveId j) const noexcept {
    if (data_->plain) return {0.0, 0.0, data_->clearance};
    return {radius(i), radius(j), clearance(link_of(i), link_of(j))};
  }
  /// Between two models: each brings half of its clearance of all pairs, the most that boxes grown by reach() bear.
  /// RobotChecker adds what is missing to the larger of the two clearances.
  RadiusSum sum(PrimitiveId i, const LinkMargins& other, PrimitiveId j) const noexcept {
    return {radius(i), other.radius(j), data_->clearance / 2 + other.data_->clearance / 2};
  }
  /// Both rounded.
  double threshold(PrimitiveId i, PrimitiveId j) const noexcept { return sum(i, j); }
  double threshold(PrimitiveId i, const LinkMargins& other, PrimitiveId j) const noexcept { return sum(i, other, j); }
  bool compatible(const LinkMargins&) const noexcept { return true; }
  double reach(PrimitiveId i) const noexcept { return data_->plain ? data_->plain_reach : data_->reach[index(i)]; }
  std::size_t size() const noexcept { return data_->model->size(); }

  /// Of all pairs without one of their own.
  double clearance() const noexcept { return data_->clearance; }
  double clearance(LinkId a, LinkId b) const noexcept {
    return data_->table.empty() ? data_->clearance : data_->table[index(a) * data_->link_count + index(b)];
  }
  /// What the triangle is grown by.
  double radius(PrimitiveId i) const noexcept { return data_->radii.empty() ? 0.0 : data_->radii[index(i)]; }

 private:
  struct Data {
    std::optional<Model<Triangle>> model;  // for its links
    double clearance = 0.0;
    bool plain = true;  // neither radii nor clearances of pairs
    double plain_reach = 0.0;
    std::vector<double> radii;  // by triangle; empty: all 0
    std::vector<double> reach;  // by triangle; empty when plain
    std::size_t link_count = 0;
    std::vector<double> table;  // link_count x link_count; empty: one clearance for all
  };
  LinkId link_of(PrimitiveId i) const noexcept { return data_->model->links()[index(i)]; }

  std::shared_ptr<const Data> data_;
};

static_assert(CrossMatrix<LinkMargins> && AdditiveRadii<LinkMargins> && KnowsSize<LinkMargins>);

}  // namespace hinge::robotics
