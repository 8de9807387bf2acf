// SPDX-License-Identifier: BSD-3-Clause
// Implements tested_pairs and LinkPairFilter.
#include "hinge/robotics/tested_pairs.hpp"

#include <string>
#include <utility>

#include "hinge/core/error.hpp"
#include "hinge/kinematics/dof_selection.hpp"
#include "hinge/kinematics/rigid_groups.hpp"

namespace hinge::robotics {

namespace {

void check_size(const LinkPairs& pairs, const Robot& robot) {
  if (pairs.link_count() != robot.link_count())
    throw ModelError("the list of pairs is for " + std::to_string(pairs.link_count()) + " links, but robot '" +
                     robot.name() + "' and the world have " + std::to_string(robot.link_count()));
}

}  // namespace

LinkPairs tested_pairs(const Robot& robot) { return tested_pairs(robot, LinkPairs(robot.link_count())); }

LinkPairs tested_pairs(const Robot& robot, const LinkPairs& disabled) {
  check_size(disabled, robot);
  const KinematicTree& tree = robot.model().tree();
  const RigidGroups groups(tree, DofSelection::all(tree));
  const auto joined = [&](GroupId a, GroupId b) { return a != GroupId{} && groups[a].parent == b; };
  LinkPairs tested(robot.link_count());
  for (std::size_t k = 1; k < robot.link_count(); ++k)
    for (std::size_t l = 1; l < k; ++l) {
      const LinkId a = id<LinkId>(k), b = id<LinkId>(l);
      if (robot.triangle_count(a) == 0 || robot.triangle_count(b) == 0) continue;
      const GroupId ga = groups.group_of(a), gb = groups.group_of(b);
      if (ga != gb && !joined(ga, gb) && !joined(gb, ga) && !disabled.contains(a, b)) tested.insert(a, b);
    }
  return tested;
}

LinkPairFilter::LinkPairFilter(const Robot& robot, LinkPairs tested) {
  check_size(tested, robot);
  const std::span<const LinkId> links = robot.model().links();
  data_ = std::make_shared<const Data>(Data{{links.begin(), links.end()}, std::move(tested)});
}

LinkPairFilter::Admission LinkPairFilter::between(std::span<const LinkId> a, std::span<const LinkId> b) const noexcept {
  bool any = false, every = true;
  for (const LinkId k : a)
    for (const LinkId l : b) {
      any = any || admits(k, l);
      every = every && admits(k, l);
    }
  if (!any) return Admission::none;
  return every ? Admission::all : Admission::some;
}

}  // namespace hinge::robotics
