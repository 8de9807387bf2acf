// SPDX-License-Identifier: BSD-3-Clause
// tested_pairs and LinkPairFilter: the pairs of links that a robot tests, and their filter over triangles.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "hinge/core/api.hpp"
#include "hinge/core/id.hpp"
#include "hinge/policy/pair_filter.hpp"
#include "hinge/robotics/link_pairs.hpp"
#include "hinge/robotics/robot.hpp"

namespace hinge::robotics {

/// Returns the pairs of links that are tested: all pairs with geometry, except pairs within one rigid group, pairs of
/// two groups that one movable joint connects, and disabled pairs. Rigid groups are those with all joints free. Throws
/// ModelError if `disabled` was made for another number of links.
HINGE_API LinkPairs tested_pairs(const Robot& robot, const LinkPairs& disabled);
/// The same without disabled pairs.
HINGE_API LinkPairs tested_pairs(const Robot& robot);

/// Admits pairs of triangles whose links are tested. Copies share one constant table, so reading is thread-safe.
class HINGE_API LinkPairFilter {
 public:
  /// Throws ModelError if `tested` was made for another number of links.
  LinkPairFilter(const Robot& robot, LinkPairs tested);

  /// Returns true if the pair of triangles is tested.
  bool admits(PrimitiveId i, PrimitiveId j) const noexcept { return admits(link_of(i), link_of(j)); }
  /// Returns true if the pair of links is tested.
  bool admits(LinkId a, LinkId b) const noexcept { return data_->tested.contains(a, b); }
  /// Returns the link of a triangle.
  LinkId link_of(PrimitiveId i) const noexcept { return data_->link_of[index(i)]; }
  /// Returns the number of triangles.
  std::size_t size() const noexcept { return data_->link_of.size(); }
  /// Returns the tested pairs.
  const LinkPairs& tested() const noexcept { return data_->tested; }

  /// How many pairs between two sets of links are admitted.
  enum class Admission : std::uint8_t { none, some, all };
  /// Returns how many pairs between the links of two rigid groups are admitted. The lists must contain only links with
  /// triangles, at least one each. If the result is not `some`, queries need no look-up per link.
  Admission between(std::span<const LinkId> a, std::span<const LinkId> b) const noexcept;

 private:
  struct Data {
    std::vector<LinkId> link_of;  // by triangle
    LinkPairs tested;
  };
  std::shared_ptr<const Data> data_;
};

static_assert(PairFilter<LinkPairFilter> && KnowsSize<LinkPairFilter>);

}  // namespace hinge::robotics
