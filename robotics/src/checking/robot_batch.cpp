// SPDX-License-Identifier: BSD-3-Clause
// Implements RobotChecker::check_batch: many configurations, sixteen at a time if the robot is made of spheres.
#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "hinge/batch/sphere_batch.hpp"
#include "hinge/core/error.hpp"
#include "hinge/detail/batch/configuration_count.hpp"
#include "hinge/robotics/robot_checker.hpp"
#include "hinge/robotics/sphere_model.hpp"

namespace hinge::robotics {

namespace {

/// Number of configurations that show which links collide most often.
constexpr std::size_t learned = 256;

}  // namespace

bool RobotChecker::fits_sphere_batch() const {
  if (engine_ != "simd" || robot_->model().size() == 0) return false;
  if (robot_->tessellation().manner != Tessellation::Manner::rounded || !has_only_spheres(*robot_)) return false;
  const auto pairs = filter_.tested().list();
  return std::ranges::all_of(pairs,
                             [&](const auto& pair) { return margins_.clearance(pair.first, pair.second) == 0.0; });
}

std::vector<std::uint8_t> RobotChecker::check_batch(std::span<const double> configurations) {
  const std::size_t values = robot_->independent_joints().size();
  const std::size_t count = detail::configuration_count(configurations, values);
  const auto at = [&](std::size_t k) { return configurations.subspan(k * values, values); };
  std::vector<std::uint8_t> verdicts(count);
  if (count < 2 || !fits_sphere_batch_ || kinematics_) {
    for (std::size_t k = 0; k < count; ++k) {
      detail::naming_configuration(k, [&] { update(at(k)); });
      verdicts[k] = collides() ? 1 : 0;
    }
    return verdicts;
  }
  const std::size_t dof = full_.size();
  std::vector<double> full;
  const auto expanded = [&](std::size_t first, std::size_t most) -> std::span<const double> {
    full.resize(std::min(most, count - first) * dof);
    for (std::size_t k = 0; k * dof < full.size(); ++k)
      detail::naming_configuration(first + k, [&] { expand(at(first + k), std::span(full).subspan(k * dof, dof)); });
    return full;
  };
  if (!spheres_) {
    spheres_.emplace(spheres_of(*robot_), filter_);
    spheres_->learn(expanded(0, learned));
  }
  for (std::size_t first = 0; first < count; first += SphereBatch::size) {
    const std::span<const double> block = expanded(first, SphereBatch::size);
    const std::uint32_t hits = spheres_->each(block);
    for (std::size_t k = 0; k * dof < block.size(); ++k) verdicts[first + k] = hits >> k & 1U;
  }
  update(at(count - 1));
  return verdicts;
}

}  // namespace hinge::robotics
