// SPDX-License-Identifier: BSD-3-Clause
// Chooses the closures that a solver keeps closed.
#include "hinge/molecular/kept_closures.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <functional>
#include <utility>

#include "hinge/kinematics/closure_solver.hpp"
#include "hinge/molecular/closed_sampler.hpp"

namespace hinge::molecular {

namespace {

constexpr double open_from = 1e-6;                              // angstrom; a closure with a larger residual is open
constexpr std::size_t start_count = 16;                         // random starts per attempt
constexpr std::uint64_t first_start = std::uint64_t{1} << 63U;  // stream index that no sample uses

bool ends_loop(const Molecule& molecule, std::size_t closure) {
  const auto [i, j] = molecule.closure_atoms()[closure];
  const Structure& s = molecule.structure();
  const Atom &a = s.atoms[i], &b = s.atoms[j];
  const std::uint32_t residue = a.residue;
  const auto named = [&](const char* first, const char* second) { return a.name == first && b.name == second; };
  return residue == b.residue && (named("CA", "C") || named("C", "CA")) &&
         std::ranges::any_of(molecule.loops(), [&](const Loop& loop) { return loop.last == residue; });
}

bool contains(std::span<const std::size_t> numbers, std::size_t number) {
  return std::ranges::find(numbers, number) != numbers.end();
}

}  // namespace

KeptClosures find_kept_closures(const Molecule& molecule, std::span<const std::size_t> torsions, Closures which,
                                std::span<const std::size_t> open) {
  KeptClosures kept;
  const KinematicTree& tree = molecule.model().tree();
  const auto left_open = [&](std::size_t c, const char* why) {
    kept.notes.push_back("closure " + tree.closures()[c].name + " is left open: " + why);
  };
  const DofSelection all = molecule.select_placed(torsions);
  const ClosureEquations equations(tree, all);
  std::vector<std::size_t> candidates;
  for (std::size_t c = 0; c < tree.closures().size(); ++c) {
    if (which == Closures::of_loops && !ends_loop(molecule, c)) continue;
    const auto columns = equations.columns_of(c);
    if (std::ranges::any_of(columns, [&](std::size_t k) {
          return molecule.torsion_of(all.dofs()[equations.position(k)]) == Molecule::no_torsion;
        }))
      left_open(c, "it joins a placed part and atoms that are not placed with it");
    else if (contains(open, c))
      left_open(c, "no random start could close it");
    else
      candidates.push_back(c);
  }
  // A loop with six torsions is held as well, but it has other conformations to jump to.
  if (molecule.loops().empty()) kept.held = find_held_torsions(molecule, torsions, candidates);
  for (const std::size_t t : torsions)
    if (!std::ranges::binary_search(kept.held, t)) kept.torsions.push_back(t);
  const ClosureEquations free(tree, molecule.select_placed(kept.torsions), candidates);
  for (std::size_t k = 0; k < candidates.size(); ++k)
    if (!free.columns_of(k).empty()) kept.closures.push_back(candidates[k]);
  return kept;
}

std::vector<std::size_t> find_unclosable(const Molecule& molecule, const DofSelection& selection,
                                         const Sampling& sampling, std::span<const PlacementRange> ranges,
                                         std::span<const std::size_t> closures) {
  std::vector<std::size_t> kept(closures.begin(), closures.end()), dropped;
  while (!kept.empty()) {
    ClosureSolver solver(molecule.model().tree(), selection, kept);
    std::vector<std::size_t> failures(kept.size(), 0);
    for (std::uint64_t k = 0; k < start_count; ++k) {
      std::vector<double> q = StartStream(sampling, first_start + k, molecule, selection, ranges).next();
      if (solver.close(q)) {
        std::ranges::sort(dropped);
        return dropped;
      }
      for (std::size_t c = 0; c < kept.size(); ++c)
        if (solver.residual(c) > open_from) ++failures[c];
    }
    // Gives up the half of the failing closures that fail most often, rounded up.
    std::vector<std::size_t> failing;
    for (std::size_t c = 0; c < kept.size(); ++c)
      if (failures[c] > 0 && !ends_loop(molecule, kept[c])) failing.push_back(c);
    if (failing.empty()) break;
    std::ranges::stable_sort(failing, std::ranges::greater{}, [&](std::size_t c) { return failures[c]; });
    failing.resize((failing.size() + 1) / 2);
    std::vector<std::size_t> rest;
    for (std::size_t c = 0; c < kept.size(); ++c) (contains(failing, c) ? dropped : rest).push_back(kept[c]);
    kept = std::move(rest);
  }
  std::ranges::sort(dropped);
  return dropped;
}

}  // namespace hinge::molecular
