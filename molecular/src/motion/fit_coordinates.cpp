// SPDX-License-Identifier: BSD-3-Clause
// Minimises the distance to given coordinates.
#include "hinge/molecular/fit_coordinates.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numeric>
#include <utility>

#include "motion/coordinate_descent.hpp"

namespace hinge::molecular {

namespace {

constexpr double exact_from = 1e-3;  // angstrom: the rounding of a file
constexpr int most_fit_evaluations = 2000, most_free_evaluations = 400;
constexpr double free_stiffness = 10.0;

class CoordinateFitter {
 public:
  CoordinateFitter(const Checker& checker, const TargetCoordinates& target, const FitOptions& options,
                   const std::function<bool()>& stop)
      : checker_(checker), target_(target), options_(options), descent_(checker_, target, options.closures, stop) {}

  CoordinateFit run() {
    const std::vector<double> reference(checker_.dof_count(), 0.0), turned = by_torsions();
    CoordinateFit best = measured(reference);
    const auto offer = [&](std::vector<double> q) {
      if (!descent_.close(q)) return;
      CoordinateFit found = measured(std::move(q));
      if (found.rmsd < best.rmsd) best = std::move(found);
    };
    offer(turned);
    if (best.rmsd > exact_from) {
      offer(descend(reference));
      offer(descend(turned));
    }
    best.collisions = collisions(best.q);
    if (options_.collision_free && best.collisions > 0) {
      std::vector<double> q = best.q;
      if (descent_.make_free(q, most_free_evaluations, free_stiffness)) best = measured(std::move(q));
    }
    best.stopped = descent_.stopped();
    return best;
  }

 private:
  std::size_t collisions(std::span<const double> q) { return checker_.check(q, Mode{Mode::Kind::all}).pairs.size(); }

  /// Returns the torsions of the target, and placements that superpose the parts, as far as they are known.
  std::vector<double> by_torsions();
  std::vector<double> descend(std::vector<double> q) {
    descent_.approach(q, most_fit_evaluations);
    return q;
  }
  CoordinateFit measured(std::vector<double> q) {
    const Superposition found = superpose(descent_.place(q), target_.positions);
    return {std::move(q), found.rmsd, found.farthest, target_.atoms[found.atom]};
  }

  Checker checker_;
  const TargetCoordinates& target_;
  const FitOptions& options_;
  CoordinateDescent descent_;
};

std::vector<double> CoordinateFitter::by_torsions() {
  const Molecule& molecule = checker_.molecule();
  const std::size_t atoms = molecule.structure().atoms.size();
  std::vector<Vec3> positions(atoms, Vec3::Zero());
  std::vector<bool> known(atoms, false);
  for (std::size_t k = 0; k < target_.atoms.size(); ++k) {
    positions[target_.atoms[k]] = target_.positions[k];
    known[target_.atoms[k]] = true;
  }
  const auto dofs = checker_.selection().dofs();
  std::vector<double> q(dofs.size(), 0.0);
  for (std::size_t k = 0; k < q.size(); ++k) {
    const std::size_t torsion = molecule.torsion_of(dofs[k]);
    if (torsion == Molecule::no_torsion) continue;
    const auto& four = molecule.torsions()[torsion].atoms;
    if (!std::ranges::all_of(four, [&](std::uint32_t atom) { return known[atom]; })) continue;
    const double angle = dihedral(positions[four[0]], positions[four[1]], positions[four[2]], positions[four[3]]);
    if (!std::isnan(angle)) q[k] = turn_of(molecule, torsion, positions);
  }
  if (molecule.placed_parts().empty()) return q;
  // A part is superposed after its own torsions are set.
  checker_.check(q, Mode{});
  const auto placements = fit_placements(molecule, checker_.positions(), positions, known);
  for (std::size_t part = 0; part < placements.size(); ++part)
    for (std::size_t c = 0; c < 6; ++c) {
      const auto dof = std::ranges::find(dofs, molecule.placed_parts()[part].dofs[c]);
      if (dof != dofs.end()) q[static_cast<std::size_t>(dof - dofs.begin())] = placements[part][c];
    }
  return q;
}

}  // namespace

TargetCoordinates all_atoms(std::vector<Vec3> positions) {
  TargetCoordinates target{std::vector<std::uint32_t>(positions.size()), std::move(positions)};
  std::iota(target.atoms.begin(), target.atoms.end(), 0U);
  return target;
}

Superposition superpose(std::span<const Vec3> positions, const TargetCoordinates& target) {
  std::vector<Vec3> matched;
  for (const std::uint32_t atom : target.atoms) matched.push_back(positions[atom]);
  Superposition found = superpose(matched, target.positions);
  found.atom = target.atoms[found.atom];
  return found;
}

CoordinateFit fit_coordinates(const Checker& checker, const TargetCoordinates& target, const FitOptions& options,
                              const std::function<bool()>& stop) {
  CoordinateFit found = CoordinateFitter(checker, target, options, stop).run();
  const auto dofs = checker.selection().dofs();
  const std::vector<double> reference(1, 0.0);
  for (std::size_t k = 0; k < dofs.size(); ++k)
    if (checker.molecule().torsion_of(dofs[k]) != Molecule::no_torsion)
      take_shorter_way(reference, std::span(found.q).subspan(k, 1));
  return found;
}

}  // namespace hinge::molecular
