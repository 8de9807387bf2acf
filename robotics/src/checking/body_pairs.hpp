// SPDX-License-Identifier: BSD-3-Clause
// BodyPair: a robot, or a body it holds, and another body; and how such a pair is asked.
#pragma once

#include <span>
#include <vector>

#include "approximation/between.hpp"
#include "hinge/core/id.hpp"
#include "hinge/policy/pair_filter.hpp"
#include "hinge/query/query_options.hpp"
#include "hinge/robotics/contact.hpp"
#include "hinge/robotics/environment.hpp"
#include "hinge/robotics/robot_checker.hpp"

namespace hinge::robotics {

/// Admits what is not on a link that may touch the body.
struct OtherLinks {
  std::span<const LinkId> links;
  const std::vector<bool>* may_touch = nullptr;  // by link; empty: none may

  bool admits(LinkId link, LinkId) const noexcept { return may_touch->empty() || !(*may_touch)[index(link)]; }
  bool admits(PrimitiveId i, PrimitiveId) const noexcept { return admits(links[index(i)], LinkId{}); }
};

static_assert(PairFilter<OtherLinks>);

struct RobotChecker::BodyPair {
  Environment::Body* held = nullptr;  ///< null: the robot itself
  BodyId held_id{};
  Environment::Body* body = nullptr;
  BodyId body_id{};
  std::vector<bool> may_touch{};  ///< links of the robot that are not tested; empty: all are
  double lower = 0.0;             ///< no pair of triangles has a d - M below it

  bool tests(std::size_t link) const noexcept { return may_touch.empty() || !may_touch[link]; }
};

/// f(mine, theirs, filter, options), with thresholds raised by `extra`.
template <class Ask>
auto RobotChecker::ask(const BodyPair& pair, const Environment& environment, const Ask& f, double extra) {
  const bool is_held = pair.held != nullptr;
  AnyHierarchy& first = is_held ? pair.held->hierarchy : *hierarchy_;
  // Bodies bring the clearance of the environment, all of them.
  const double missing = is_held ? 0.0 : missing_clearance(margins_.clearance(), environment.clearance());
  const std::vector<double> more = for_all_groups(first, missing + extra);
  const OtherLinks filter{robot_->model().links(), &pair.may_touch};
  return with_same_engine(first, pair.body->hierarchy, [&](auto& mine, auto& theirs) {
    return f(mine, theirs, filter, QueryOptions{false, more, {}, nullptr});
  });
}

}  // namespace hinge::robotics
