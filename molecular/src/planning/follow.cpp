// SPDX-License-Identifier: BSD-3-Clause
// Follows coordinates in steps that adapt to what is free.
#include "planning/follow.hpp"

#include <algorithm>
#include <cstddef>
#include <utility>

#include "motion/superpose.hpp"

namespace hinge::molecular {

namespace {

constexpr double first_step = 1.0 / 64.0, smallest_step = 1e-5;  // shares of the way
constexpr double longer = 1.5, shorter = 0.5;
constexpr double least_stiffness = 10.0;
constexpr double stiffer = 3.0, softer = 0.5;
constexpr int evaluations_of_a_step = 60;

}  // namespace

Followed follow(ConformationProblem& problem, CoordinateDescent& descent, std::span<const double> from,
                const std::vector<Vec3>& to, std::uint64_t most_motions, const std::function<bool()>& stop) {
  const std::vector<Vec3> start(descent.place(from));
  const Vec3 here = centre(start), there = centre(to);
  const Mat3 rotation = closest_rotation(to, there, start, here);
  const auto target = [&](double place) {
    std::vector<Vec3> positions(start);
    for (std::size_t k = 0; k < positions.size(); ++k)
      positions[k] += place * (here + product(rotation, Vec3(to[k] - there)) - start[k]);
    return positions;
  };

  Followed way;
  way.waypoints.assign(1, {from.begin(), from.end()});
  double place = 0.0, step = first_step, stiffness = least_stiffness;
  while (place < 1.0 && step > smallest_step && way.motions < most_motions && !(stop && stop())) {
    const double next = std::min(1.0, place + step);
    descent.aim(target(next));
    std::vector<double> q = way.waypoints.back();
    const bool moves = descent.make_free(q, evaluations_of_a_step, stiffness);
    if (moves) ++way.motions;
    if (moves && problem.is_motion_free(way.waypoints.back(), q)) {
      way.waypoints.push_back(std::move(q));
      place = next;
      step *= longer;
      stiffness = std::max(least_stiffness, softer * stiffness);
    } else {
      step *= shorter;
      stiffness *= stiffer;
    }
  }
  return way;
}

}  // namespace hinge::molecular
