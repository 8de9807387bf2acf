// SPDX-License-Identifier: BSD-3-Clause
// BodyPair: a robot or a body that it holds, paired with another body, and the query of one such pair.
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

/// Admits triangles of links that may not touch the other model.
struct OtherLinks {
  std::span<const LinkId> links;
  const std::vector<bool>* may_touch = nullptr;  // by link; null: no link may

  bool admits(LinkId link, LinkId) const noexcept { return may_touch == nullptr || !(*may_touch)[index(link)]; }
  bool admits(PrimitiveId i, PrimitiveId) const noexcept { return admits(links[index(i)], LinkId{}); }
};

static_assert(PairFilter<OtherLinks>);

struct RobotChecker::BodyPair {
  Environment::Body* held = nullptr;  ///< the body held by the robot; null: the robot itself
  BodyId held_id{};
  Environment::Body* body = nullptr;
  BodyId body_id{};
  std::vector<bool> may_touch{};  ///< links of the robot to skip; empty: test all
  double lower = 0.0;             ///< m, lower bound of d - M for all pairs of triangles

  bool tests(std::size_t link) const noexcept { return may_touch.empty() || !may_touch[link]; }
};

/// Calls f(mine, theirs, filter, options) with all thresholds raised by `extra` (m).
template <class Ask>
auto RobotChecker::ask(const BodyPair& pair, const Environment& environment, const Ask& f, double extra) {
  const bool is_held = pair.held != nullptr;
  AnyHierarchy& first = is_held ? pair.held->hierarchy : *hierarchy_;
  // Every body already has the full clearance of the environment, so a held body needs no more.
  const double missing = is_held ? 0.0 : missing_clearance(margins_.clearance(), environment.clearance());
  const std::vector<double> more = for_all_groups(first, missing + extra);
  const OtherLinks filter{robot_->model().links(), pair.may_touch.empty() ? nullptr : &pair.may_touch};
  return with_same_engine(first, pair.body->hierarchy, [&](auto& mine, auto& theirs) {
    return f(mine, theirs, filter, QueryOptions{false, more, {}, nullptr});
  });
}

}  // namespace hinge::robotics
