// SPDX-License-Identifier: BSD-3-Clause
// Loads the molecule, selection and rules that the options name, and explains one pair.
#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "hinge/core/error.hpp"
#include "hinge/detail/primitive/grid_point.hpp"
#include "hinge/molecular/bond_exclusions.hpp"
#include "hinge/molecular/loop.hpp"
#include "hinge/molecular/selection.hpp"
#include "hinge/primitive/point.hpp"
#include "options.hpp"
#include "rigid_ensemble.hpp"
#include "scene.hpp"

namespace biocd {

using namespace hinge::molecular;

namespace {

bool loops_have_chi(const Molecule& molecule) {
  return std::any_of(molecule.torsions().begin(), molecule.torsions().end(), [&](const Torsion& torsion) {
    return torsion.name.starts_with("chi") &&
           std::any_of(molecule.loops().begin(), molecule.loops().end(),
                       [&](const Loop& loop) { return loop.first <= torsion.residue && torsion.residue <= loop.last; });
  });
}

}  // namespace

Job load(const Options& options) {
  Structure structure = read_files(options);
  MoleculeOptions made;
  std::vector<PlacementRange> ranges;
  for (const std::string& word : options.place) {
    const auto [part, range] = read_placement(word);
    made.placed.push_back(find_part(structure, part, ResidueNames::only));
    ranges.push_back(range);
  }
  CheckOptions rules = options.check;
  rules.scope = read_scope(options, structure);
  const bool loops = !options.loop.empty();
  if (loops) made.loops = find_loops(structure, options.loop);
  made.keep_hydrogen_bonds = options.keep_hydrogen_bonds;
  auto molecule = std::make_shared<const Molecule>(std::move(structure), made);
  // Loops of glycine and alanine have no side chains to free.
  const std::string free = options.free_by_loop && !loops_have_chi(*molecule) ? "none" : options.free;
  SelectedTorsions selected = read_selection(*molecule, free, options.omega);
  auto torsions = loops ? select_loop_torsions(*molecule, free, options.omega) : selected.torsions;
  std::optional<EnsembleGroups> ensemble;
  if (!options.rigid_from.empty()) {
    if (loops) throw hinge::ModelError("--rigid-from and --loop are both given, expected one of the two");
    ensemble = find_rigid_groups(options, *molecule, torsions);
    torsions = ensemble->torsions;
    made.held = held_placements(*molecule, *ensemble);
    if (!made.held.empty()) molecule = std::make_shared<const Molecule>(molecule->structure(), made);
  }
  KeptClosures kept;
  if (options.keep_closures) {
    const Closures which = *options.keep_closures ? Closures::all : Closures::of_loops;
    kept = find_kept_closures(*molecule, torsions, which);
    if (options.draws && !kept.closures.empty()) {
      const auto open = find_unclosable(*molecule, molecule->select_placed(kept.torsions), sampling_of(options), ranges,
                                        kept.closures);
      if (!open.empty()) kept = find_kept_closures(*molecule, torsions, which, open);
    }
    torsions = kept.torsions;
  }
  Checker checker(molecule, molecule->select_placed(torsions), rules);
  return {std::move(molecule), std::move(checker), std::move(selected),
          std::move(kept),     std::move(ranges),  std::move(ensemble)};
}

namespace {

std::uint32_t read_atom(std::string_view text, std::size_t atoms) {
  std::uint32_t atom = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), atom);
  if (error != std::errc{} || end != text.data() + text.size() || atom >= atoms)
    throw hinge::ModelError(fmt::format("--explain atom '{}': expected a number from 0 to {}", text, atoms - 1));
  return atom;
}

}  // namespace

void explain(const Options& options, const Job& job) {
  const Structure& s = job.molecule->structure();
  const std::string_view text = options.explain;
  const std::size_t comma = text.find(',');
  const std::uint32_t i = read_atom(text.substr(0, comma), s.atoms.size());
  const std::uint32_t j = read_atom(comma == std::string_view::npos ? "" : text.substr(comma + 1), s.atoms.size());
  if (i == j) throw hinge::ModelError("--explain: expected two different atoms");
  const Checker& checker = job.checker;
  const Thresholds& t = checker.thresholds();
  const auto a = hinge::id<hinge::PrimitiveId>(i), b = hinge::id<hinge::PrimitiveId>(j);
  const std::size_t type_i = t.matrix.type(a), type_j = t.matrix.type(b);
  const hinge::Point p{s.models.front()[i]}, q{s.models.front()[j]};
  const double threshold = t.between(type_i, type_j);
  const bool closer = hinge::detail::closer_as_written(p, q, threshold);

  fmt::print("pair {} {} - {} {}\n", i, label(s, i), j, label(s, j));
  fmt::print("  types        {} - {} ({} v{}, {}, hydrogen-bond rule {})\n", t.type_names[type_i], t.type_names[type_j],
             t.radii, t.radii_version,
             t.rho ? fmt::format("rho {}", *t.rho) : fmt::format("rules {} v{}", t.rules->name, t.rules->version),
             t.hydrogen_bonds ? "on" : "off");
  fmt::print("  threshold    {:.4f} angstrom\n", threshold);
  fmt::print("  distance     {:.4f} angstrom in the first model\n", distance(p, q));
  const int min_bonds = checker.min_bonds().of(s, i, j), bonds = bond_distance(s, i, j, min_bonds - 1);
  if (bonds >= 0)
    fmt::print("  dropped      {} bonds apart, expected at least {}\n", bonds, min_bonds);
  else if (!checker.exclusions().in_scope(a, b))
    fmt::print("  dropped      not in a pair of --between or --inside\n");
  else if (!t.rules->inside_residues && s.atoms[i].residue == s.atoms[j].residue)
    fmt::print("  dropped      both atoms in one residue\n");
  else if (!checker.exclusions().admits(a, b))
    fmt::print("  dropped      collides in the reference, so it is exempt\n");
  else if (checker.constant(i, j))
    fmt::print(
        "  kept         for coordinates from a file; samples leave it out, because its distance is constant under "
        "this selection\n");
  else
    fmt::print("  kept         at least {} bonds apart, distance changes under this selection\n", min_bonds);
  fmt::print("  verdict      {}\n", closer ? "closer than the threshold" : "not closer than the threshold");
}

void require_free_torsions(const Options& options, const Job& job) {
  if (job.checker.dof_count() == 0)
    throw hinge::ModelError(
        "--free " + options.free + ": no torsion is free, expected at least one" +
        (job.kept.held.empty() ? "" : " (closed cycles hold the torsions; --closures open frees them)"));
}

}  // namespace biocd
