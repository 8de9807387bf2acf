// SPDX-License-Identifier: BSD-3-Clause
// LinkMargins: the distance matrix of robots, from radii of triangles and clearances between links.
#pragma once

#include <algorithm>
#include <cstddef>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "hinge/core/api.hpp"
#include "hinge/core/id.hpp"
#include "hinge/core/radius_sum.hpp"
#include "hinge/model/model.hpp"
#include "hinge/policy/distance_matrix.hpp"
#include "hinge/policy/pair_filter.hpp"
#include "hinge/primitive/triangle.hpp"
#include "hinge/robotics/robot.hpp"

namespace hinge::robotics {

/// The distance (m) that two links must keep. It replaces the general clearance for this pair.
struct PairClearance {
  LinkId link1{};          ///< one link
  LinkId link2{};          ///< another link; the order does not matter
  double clearance = 0.0;  ///< m, finite, >= 0
};

/// Distance matrix M(i, j) = radius(i) + radius(j) + clearance of the two links, in m. Verdicts use the exact real sum,
/// not a rounded one. Copies share one constant table, so reading is thread-safe.
class HINGE_API LinkMargins {
 public:
  /// clearance: for all pairs of links without an override, m. Throws ModelError, naming the links, if a clearance or
  /// radius is negative or not finite, a link does not exist, or an override names one link twice or a pair that was
  /// named before.
  explicit LinkMargins(const Robot& robot, double clearance = 0.0, std::span<const PairClearance> overrides = {});

  /// Returns the threshold of two triangles of one robot, as an unrounded sum.
  RadiusSum sum(PrimitiveId i, PrimitiveId j) const noexcept {
    if (data_->plain) return {0.0, 0.0, data_->clearance};
    return {radius(i), radius(j), clearance(link_of(i), link_of(j))};
  }
  /// Returns the threshold of two triangles of different models, as an unrounded sum. Each model contributes half of
  /// its general clearance: boxes inflated by reach() cover no more than that. RobotChecker passes the difference to
  /// the larger clearance as an extra clearance of the query.
  RadiusSum sum(PrimitiveId i, const LinkMargins& other, PrimitiveId j) const noexcept {
    return {radius(i), other.radius(j), data_->clearance / 2 + other.data_->clearance / 2};
  }
  /// The same thresholds, rounded to one double, m.
  double threshold(PrimitiveId i, PrimitiveId j) const noexcept { return sum(i, j); }
  /// The same for two triangles of different models.
  double threshold(PrimitiveId i, const LinkMargins& other, PrimitiveId j) const noexcept { return sum(i, other, j); }
  /// Always true: two robots may be queried against each other.
  bool compatible(const LinkMargins&) const noexcept { return true; }
  /// Returns a length (m) such that M(i, j) <= reach(i) + reach(j) for all j: the radius plus half the link's largest
  /// clearance, rounded up.
  double reach(PrimitiveId i) const noexcept { return data_->plain ? data_->plain_reach : data_->reach[index(i)]; }
  /// Returns the number of triangles.
  std::size_t size() const noexcept { return data_->model->size(); }

  /// Returns the clearance (m) of all pairs without an override.
  double clearance() const noexcept { return data_->clearance; }
  /// Returns the clearance (m) of two links.
  double clearance(LinkId a, LinkId b) const noexcept {
    return data_->table.empty() ? data_->clearance : data_->table[index(a) * data_->link_count + index(b)];
  }
  /// Returns true if a triangle may have a radius.
  bool has_radii() const noexcept { return !data_->radii.empty(); }
  /// Returns the radius (m) by which a triangle is inflated: that of its sphere or capsule, otherwise 0.
  double radius(PrimitiveId i) const noexcept { return data_->radii.empty() ? 0.0 : data_->radii[index(i)]; }

 private:
  struct Data {
    std::optional<Model<Triangle>> model;  // maps triangles to links
    double clearance = 0.0;
    bool plain = true;  // no radii and no overrides
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
