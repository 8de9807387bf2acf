// SPDX-License-Identifier: BSD-3-Clause
// Samples closed conformations, and finds the torsions that closed cycles hold fixed.
#include "hinge/molecular/closed_sampler.hpp"

#include <algorithm>
#include <array>
#include <string>
#include <utility>

#include "hinge/core/error.hpp"
#include "hinge/detail/kinematics/rigid_cycles.hpp"

namespace hinge::molecular {

StartStream::StartStream(const Sampling& sampling, std::uint64_t index, const Molecule& molecule,
                         const DofSelection& selection, std::span<const PlacementRange> ranges)
    : sampling_(sampling), turns_(sampling.seed, index), q_(selection.size()) {
  if (ranges.size() != molecule.placed_parts().size())
    throw ModelError(std::to_string(ranges.size()) + " ranges of placements, expected one for each of " +
                     std::to_string(molecule.placed_parts().size()) + " placed parts");
  const auto dofs = selection.dofs();
  std::vector<bool> places(dofs.size(), false);
  for (std::size_t part = 0; part < ranges.size(); ++part) {
    SampleStream stream(sampling.seed, index, static_cast<std::uint32_t>(part + 1));
    const std::array<double, 6> values = sample_placement(stream, ranges[part]);
    for (std::size_t k = 0; k < 6; ++k) {
      const auto found = std::lower_bound(dofs.begin(), dofs.end(), molecule.placed_parts()[part].dofs[k]);
      const auto position = static_cast<std::size_t>(found - dofs.begin());
      places.at(position) = true;
      q_[position] = values[k];
    }
  }
  for (std::size_t k = 0; k < dofs.size(); ++k)
    if (!places[k]) turning_.push_back(k);
}

std::vector<double> StartStream::next() {
  const std::vector<double> turns = draw_configuration(sampling_, turns_, turning_.size());
  for (std::size_t k = 0; k < turning_.size(); ++k) q_[turning_[k]] = turns[k];
  return q_;
}

ClosedSampler::ClosedSampler(const Molecule& molecule, const DofSelection& selection, const Sampling& sampling,
                             std::uint64_t most_tries, const std::vector<std::size_t>& closures,
                             std::span<const PlacementRange> ranges)
    : molecule_(&molecule),
      selection_(selection),
      solver_(molecule.model().tree(), selection, closures),
      sampling_(sampling),
      ranges_(ranges.begin(), ranges.end()),
      most_tries_(most_tries) {
  if (most_tries == 0) throw ModelError("0 tries per sample, expected at least one");
  if (selection.size() == 0) throw ModelError("no torsion is free, expected at least one");
  static_cast<void>(sample_configuration(sampling, 0, molecule, selection, ranges));  // validates the ranges
}

ClosedSample ClosedSampler::sample(std::uint64_t index) {
  StartStream stream(sampling_, index, *molecule_, selection_, ranges_);
  ClosedSample result;
  while (!result.found() && result.unclosed < most_tries_) {
    std::vector<double> q = stream.next();
    if (solver_.close(q))
      result.q = std::move(q);
    else
      ++result.unclosed;
  }
  return result;
}

std::vector<std::size_t> find_held_torsions(const Molecule& molecule, std::span<const std::size_t> torsions) {
  return find_held_torsions(molecule, torsions, all_closures(molecule.model().tree()));
}

std::vector<std::size_t> find_held_torsions(const Molecule& molecule, std::span<const std::size_t> torsions,
                                            std::span<const std::size_t> closures) {
  // Uncertainty of coordinates with three decimals: a point is off by sqrt(3) * 0.0005 angstrom; an axis by twice that
  // over a bond of 1.2 angstrom (rad).
  constexpr double point = 8.7e-4, axis = 2.0 * point / 1.2;
  std::vector<std::size_t> held;
  for (const DofId dof :
       detail::rigid_cycle_dofs(molecule.model().tree(), molecule.select(torsions), {point, axis}, closures))
    held.push_back(molecule.torsion_of(dof));
  std::sort(held.begin(), held.end());
  return held;
}

}  // namespace hinge::molecular
