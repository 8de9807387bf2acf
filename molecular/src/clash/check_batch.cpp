// SPDX-License-Identifier: BSD-3-Clause
// Implements Checker::check_batch: many conformations, sixteen at a time on the SIMD engine.
#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "hinge/batch/state_batch.hpp"
#include "hinge/detail/batch/configuration_count.hpp"
#include "hinge/molecular/checker.hpp"

namespace hinge::molecular {

std::vector<std::uint8_t> Checker::check_batch(std::span<const double> conformations) {
  const std::size_t values = dof_count();
  const std::size_t count = detail::configuration_count(conformations, values);
  std::vector<std::uint8_t> verdicts(count);
  const auto update = [&](auto& hierarchy, std::size_t k) {
    hierarchy.update(conformations.subspan(k * values, values));
  };
  const auto one_by_one = [&](auto& hierarchy) {
    for (std::size_t k = 0; k < count; ++k) {
      update(hierarchy, k);
      verdicts[k] = hierarchy.self_collides() ? 1 : 0;
    }
  };
  const auto together = [&](MolecularHierarchy<Simd>& hierarchy) {
    using Batch = StateBatch<Point, BondExclusions, TypedThresholds>;
    if (count < 2) return one_by_one(hierarchy);
    if (!batch_) batch_.emplace(molecule_->model(), hierarchy.model().selection(), *exclusions_, thresholds_->matrix);
    for (std::size_t first = 0; first < count; first += Batch::size) {
      const std::size_t lanes = std::min<std::size_t>(Batch::size, count - first);
      const std::uint32_t hits = batch_->collides(conformations.subspan(first * values, lanes * values));
      for (std::size_t k = 0; k < lanes; ++k) verdicts[first + k] = hits >> k & 1U;
    }
    update(hierarchy, count - 1);
  };
  if (auto* const simd = std::get_if<MolecularHierarchy<Simd>>(&*hierarchy_))
    together(*simd);
  else
    std::visit(one_by_one, *hierarchy_);
  return verdicts;
}

}  // namespace hinge::molecular
