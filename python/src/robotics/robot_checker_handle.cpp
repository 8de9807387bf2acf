// SPDX-License-Identifier: BSD-3-Clause
// Implements RobotCheckerHandle.
#include "robot_checker_handle.hpp"

#include <algorithm>

namespace hinge::python {

using namespace hinge::robotics;

Against as_against(const std::string& text) {
  if (text == "all") return {};
  if (text == "self") return {true, false};
  if (text == "environment") return {false, true};
  throw pybind11::value_error("against: '" + text + "', expected 'all', 'self' or 'environment'");
}

void RobotCheckerHandle::replace(const RobotChecker& checker) {
  pool = std::make_shared<RobotPool>(RobotWorker{checker});
}

std::shared_ptr<PathPool> RobotCheckerHandle::path_checkers(const std::shared_ptr<RobotPool>& of) {
  const std::shared_ptr<EnvironmentHandle> through = environment;  // another thread may replace it meanwhile
  const bool around = through != nullptr && through->bodies().size() > 0;
  const std::uint64_t version = around ? through->version() : 0;
  if (paths_ && paths_of_ == of && paths_through_ == through && paths_at_ == version) return paths_;
  std::optional<Environment> bodies;
  if (around) bodies = through->bodies();
  auto made = run_aside([of, bodies] {
    const RobotChecker& alone = of->prototype().checker;
    auto checkers = std::make_shared<PathPool>(bodies ? PathChecker(alone, *bodies) : PathChecker(alone));
    checkers->make_one();
    return checkers;
  });
  paths_ = made;
  paths_of_ = of;
  paths_through_ = through;
  paths_at_ = version;
  return made;
}

LinkDistanceRow distance_row(std::size_t configuration, const ClosestLinks& found) {
  LinkDistanceRow row{};
  row.configuration = static_cast<std::int64_t>(configuration);
  row.first = link_row(found.link1);
  row.second = link_row(found.link2);
  row.triangle1 = static_cast<std::uint32_t>(index(found.triangle1));
  row.triangle2 = static_cast<std::uint32_t>(index(found.triangle2));
  row.distance = found.distance;
  row.gap = found.gap;
  const Vec3 between = found.point2 - found.point1;
  const double length = norm(between);
  for (int c = 0; c < 3; ++c) {
    row.point1[c] = found.point1[c];
    row.point2[c] = found.point2[c];
    row.normal[c] = length > 0.0 ? between[c] / length : 0.0;
  }
  row.collides = found.collides();
  return row;
}

}  // namespace hinge::python
