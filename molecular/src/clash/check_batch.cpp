// SPDX-License-Identifier: BSD-3-Clause
// Implements Checker::check_batch: many conformations, one by one or sixteen at a time.
#include <algorithm>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <span>
#include <variant>
#include <vector>

#include "hinge/batch/state_batch.hpp"
#include "hinge/core/error.hpp"
#include "hinge/detail/batch/configuration_count.hpp"
#include "hinge/molecular/checker.hpp"

namespace hinge::molecular {

std::vector<std::uint8_t> Checker::check_batch(std::span<const double> conformations) {
  const std::size_t values = dof_count();
  const std::size_t count = hinge::detail::configuration_count(conformations, values);
  std::vector<std::uint8_t> verdicts(count);
  const auto update = [&](auto& hierarchy, std::size_t k) {
    hinge::detail::naming_configuration(k, [&] { hierarchy.update(conformations.subspan(k * values, values)); });
  };
  const auto one_by_one = [&](auto& hierarchy, std::size_t first, std::size_t end) {
    for (std::size_t k = first; k < end; ++k) {
      update(hierarchy, k);
      verdicts[k] = hierarchy.self_collides() ? 1 : 0;
    }
  };
  const auto together = [&](MolecularHierarchy<Simd>& hierarchy, std::size_t first, std::size_t end) {
    if (!batch_) batch_.emplace(molecule_->model(), hierarchy.model().selection(), *exclusions_, thresholds_->matrix);
    try {
      return batch_->collides(conformations.subspan(first * values, (end - first) * values));
    } catch (const ConfigurationError&) {
      one_by_one(hierarchy, first, end);  // throws the error that names the configuration
      throw;
    }
  };
  // Which way is faster depends on the conformations. One by one, a clash near the root ends the work early, so blocks
  // are not tried while most conformations collide.
  const auto in_blocks = [&](MolecularHierarchy<Simd>& hierarchy) {
    using Batch = StateBatch<Point, BondExclusions, TypedThresholds>;
    using Clock = std::chrono::steady_clock;
    for (std::size_t first = 0; first < count; first += Batch::size) {
      const std::size_t end = std::min(first + Batch::size, count);
      const Clock::time_point start = Clock::now();
      const bool alone = mostly_collide_ || faster_.next() == 0;
      if (alone) {
        one_by_one(hierarchy, first, end);
      } else {
        const std::uint32_t hits = together(hierarchy, first, end);
        for (std::size_t k = first; k < end; ++k) verdicts[k] = hits >> (k - first) & 1U;
      }
      if (!mostly_collide_) faster_.took(std::chrono::duration<double>(Clock::now() - start).count());
      const auto colliding = std::count(verdicts.begin() + static_cast<std::ptrdiff_t>(first),
                                        verdicts.begin() + static_cast<std::ptrdiff_t>(end), 1);
      mostly_collide_ = 2 * static_cast<std::size_t>(colliding) > end - first;
    }
    update(hierarchy, count - 1);
  };
  auto* const simd = std::get_if<MolecularHierarchy<Simd>>(&*hierarchy_);
  if (simd != nullptr && count > 1)
    in_blocks(*simd);
  else
    std::visit([&](auto& hierarchy) { one_by_one(hierarchy, 0, count); }, *hierarchy_);
  return verdicts;
}

}  // namespace hinge::molecular
