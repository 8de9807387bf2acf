// SPDX-License-Identifier: BSD-3-Clause
// The pair rule of robots, and the pair filter over triangles it makes.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "hinge/core/id.hpp"
#include "hinge/policy/pair_filter.hpp"
#include "hinge/robotics/link_pairs.hpp"
#include "hinge/robotics/robot.hpp"

namespace hinge::robotics {

/// Pairs of links with geometry, except: links of one rigid group; links of two groups joined by one movable joint;
/// disabled ones. Rigid groups are those of all joints free. ModelError: `disabled` made for another number of links.
LinkPairs tested_pairs(const Robot& robot, const LinkPairs& disabled);
LinkPairs tested_pairs(const Robot& robot);

/// Admits triangles of links that are tested against each other. Copies share one constant table.
class LinkPairFilter {
 public:
  /// ModelError: pairs made for another number of links.
  LinkPairFilter(const Robot& robot, LinkPairs tested);

  bool admits(PrimitiveId i, PrimitiveId j) const noexcept { return admits(link_of(i), link_of(j)); }
  bool admits(LinkId a, LinkId b) const noexcept { return data_->tested.contains(a, b); }
  LinkId link_of(PrimitiveId i) const noexcept { return data_->link_of[index(i)]; }
  std::size_t size() const noexcept { return data_->link_of.size(); }
  const LinkPairs& tested() const noexcept { return data_->tested; }

  enum class Admission : std::uint8_t { none, some, all };
  /// Of the pairs between the links of two rigid groups (each with at least one link that has triangles; only those
  /// are to be listed): if not `some`, the groups need no look-up by link.
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
