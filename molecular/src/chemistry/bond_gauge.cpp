// SPDX-License-Identifier: BSD-3-Clause
// BondGauge: compares distances in model 0 with those in other coordinates.
#include "hinge/molecular/bond_gauge.hpp"

#include <algorithm>
#include <cmath>

#include "hinge/molecular/bond_exclusions.hpp"

namespace hinge::molecular {

BondGauge::BondGauge(const Molecule& molecule) {
  const Structure& s = molecule.structure();
  const std::vector<Vec3>& x = s.models.front();
  const auto kept = [&](std::uint32_t i, std::uint32_t j) { return Kept{i, j, norm(Vec3(x[i] - x[j]))}; };
  for (const Bond& bond : s.bonds) bonds_.push_back(kept(bond.first, bond.second));
  const auto neighbours = bonded_neighbours(s);
  for (const auto& [a, b] : molecule.closure_atoms()) {
    std::vector<Kept>& of_closure = closures_.emplace_back();
    of_closure.push_back(kept(a, b));
    for (const std::uint32_t n : neighbours[a])
      if (n != b) of_closure.push_back(kept(n, b));
    for (const std::uint32_t n : neighbours[b])
      if (n != a) of_closure.push_back(kept(a, n));
  }
}

std::vector<double> BondGauge::closure_residuals(std::span<const Vec3> positions) const {
  std::vector<double> residuals;
  residuals.reserve(closures_.size());
  for (const std::vector<Kept>& of_closure : closures_) {
    double worst = 0.0;
    for (const auto& [i, j, length] : of_closure)
      worst = std::max(worst, std::abs(norm(Vec3(positions[i] - positions[j])) - length));
    residuals.push_back(worst);
  }
  return residuals;
}

BondDeviation BondGauge::worst_bond(std::span<const Vec3> positions) const {
  BondDeviation worst;
  for (const auto& [i, j, reference] : bonds_) {
    const double length = norm(Vec3(positions[i] - positions[j])), residual = std::abs(length - reference);
    if (residual > worst.residual || worst.first == worst.second) worst = {i, j, length, reference, residual};
  }
  return worst;
}

}  // namespace hinge::molecular
