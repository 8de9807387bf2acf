// SPDX-License-Identifier: BSD-3-Clause
// Finds the rigid groups of an ensemble in one pass over its conformations, and measures their deviations in a second.
#include "rigid_ensemble.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

#include "frames.hpp"
#include "hinge/core/error.hpp"
#include "hinge/molecular/fit_torsions.hpp"
#include "hinge_tools/counted.hpp"

namespace biocd {

using namespace hinge::molecular;
using hinge::tool::counted;

namespace {

/// Calls use(positions, name) for each conformation of --rigid-from; positions: angstrom, one per atom of the molecule.
/// A LoadError of use gets the name of the frame.
template <class Use>
void for_conformations(const Options& options, const Structure& s, const Use& use) {
  const Frames frames(options.rigid_from, options.file, s, options.read, true);
  for (std::size_t k = 0; k < frames.size(); ++k) {
    const Trajectory& source = frames.file(k);
    const std::vector<hinge::Vec3> positions = source.kept(source.frame(frames.place(k).frame));
    try {
      use(positions, frames.name(k));
    } catch (const hinge::LoadError& error) {
      throw hinge::LoadError(frames.name(k) + ": " + error.what());
    }
  }
}

/// Deviations of a rigid group, or of the rebuilt molecule, from the conformations.
struct Deviation {
  double sum = 0.0, worst = 0.0, farthest = 0.0;  // sum of RMSD, worst RMSD, largest distance of an atom: angstrom
  std::string worst_name;
  std::uint32_t farthest_atom = 0;
  std::size_t count = 0;

  void add(const Superposition& found, std::uint32_t atom, const std::string& name) {
    ++count;
    sum += found.rmsd;
    if (found.rmsd > worst || worst_name.empty()) {
      worst = found.rmsd;
      worst_name = name;
    }
    if (found.farthest > farthest || count == 1) {
      farthest = found.farthest;
      farthest_atom = atom;
    }
  }
};

struct Deviations {
  std::vector<Deviation> groups;
  Deviation model;  // the whole molecule, rebuilt from its free torsions; empty with placed parts
};

Deviations measure(const Options& options, const Job& job) {
  const Structure& s = job.molecule->structure();
  const std::vector<hinge::Vec3>& reference = s.models.front();
  const EnsembleGroups& found = *job.ensemble;
  Deviations all;
  std::vector<std::vector<std::uint32_t>> atoms;
  for (const EnsembleGroup& group : found.groups) atoms.push_back(group.atoms());
  all.groups.resize(atoms.size());
  Checker model = job.checker;
  std::vector<hinge::Vec3> own, other;
  for_conformations(options, s, [&](const std::vector<hinge::Vec3>& positions, const std::string& name) {
    for (std::size_t g = 0; g < atoms.size(); ++g) {
      own.clear();
      other.clear();
      for (const std::uint32_t i : atoms[g]) {
        own.push_back(reference[i]);
        other.push_back(positions[i]);
      }
      const Superposition superposed = superpose(own, other);
      all.groups[g].add(superposed, atoms[g][superposed.atom], name);
    }
    if (!job.molecule->placed_parts().empty()) return;
    model.check(fit_torsions(*job.molecule, job.checker.selection(), positions), Mode{Mode::Kind::any});
    const Superposition rebuilt = superpose(model.positions(), positions);
    all.model.add(rebuilt, rebuilt.atom, name);
  });
  return all;
}

/// Returns text such as "A:1-29 A:60-121": the residues with more than half of their atoms in `atoms`, or, if there are
/// none, all residues with an atom in it.
std::string residues_text(const Structure& s, const std::vector<std::uint32_t>& atoms) {
  std::vector<std::uint32_t> count(s.residues.size(), 0);
  for (const std::uint32_t i : atoms) ++count[s.atoms[i].residue];
  const auto most = [&](std::uint32_t r) { return 2 * count[r] > s.residues[r].last_atom - s.residues[r].first_atom; };
  bool any = false;
  for (std::uint32_t r = 0; r < count.size(); ++r) any = any || most(r);
  const auto in = [&](std::uint32_t r) { return r < count.size() && (any ? most(r) : count[r] > 0); };
  const auto number = [&](std::uint32_t r) {
    std::string text = std::to_string(s.residues[r].sequence_number);
    if (s.residues[r].insertion_code != '\0') text += s.residues[r].insertion_code;
    return text;
  };
  std::string text;
  for (std::uint32_t r = 0; r < count.size(); ++r) {
    if (!in(r)) continue;
    const std::uint32_t first = r;
    while (in(r + 1) && s.residues[r + 1].chain == s.residues[first].chain) ++r;
    const std::string& chain = s.chains[s.residues[first].chain].name;
    if (!text.empty()) text += ' ';
    text += chain.empty() ? "_" : chain;
    text += ':' + number(first);
    if (r > first) text += '-' + number(r);
  }
  return text;
}

Json deviation_json(const Structure& s, const Deviation& deviation) {
  if (deviation.count == 0) return {};
  return {{"mean_rmsd", rounded(deviation.sum / static_cast<double>(deviation.count))},
          {"worst_rmsd", rounded(deviation.worst)},
          {"worst", deviation.worst_name},
          {"farthest", rounded(deviation.farthest)},
          {"farthest_atom", label(s, deviation.farthest_atom)}};
}

std::string deviation_text(const Structure& s, const Deviation& deviation) {
  return fmt::format("RMSD {:.2f} A, at worst {:.2f} A ({}), farthest atom {:.2f} A ({})",
                     deviation.sum / static_cast<double>(deviation.count), deviation.worst, deviation.worst_name,
                     deviation.farthest, label(s, deviation.farthest_atom));
}

}  // namespace

EnsembleGroups find_rigid_groups(const Options& options, const Molecule& molecule,
                                 std::span<const std::size_t> torsions) {
  EnsembleSpread spread(molecule, torsions);
  for_conformations(options, molecule.structure(),
                    [&](const std::vector<hinge::Vec3>& positions, const std::string&) { spread.add(positions); });
  return find_ensemble_groups(spread, options.rigid_tolerance);
}

std::string rigid_groups_text(const Options& options, const Job& job) {
  constexpr std::size_t most = 20;  // groups shown in the table
  const Structure& s = job.molecule->structure();
  const EnsembleGroups& found = *job.ensemble;
  const Deviations all = measure(options, job);
  std::string text =
      fmt::format("rigid groups of {}, tolerance {} angstrom: {}\n", counted(all.groups.front().count, "conformation"),
                  options.rigid_tolerance, found.groups.size());
  for (std::size_t g = 0; g < std::min(most, found.groups.size()); ++g) {
    const EnsembleGroup& group = found.groups[g];
    text += fmt::format("  {} in {}, {}: distances vary by {:.2f} A; {}\n", counted(group.size(), "atom"),
                        counted(group.segments.size(), "segment"), residues_text(s, group.atoms()), group.spread,
                        deviation_text(s, all.groups[g]));
  }
  if (found.groups.size() > most)
    text += fmt::format("  and {}\n", counted(found.groups.size() - most, "smaller group"));
  for (std::size_t k = 0; k < found.torsions.size(); ++k)
    text += fmt::format("  free {:<22} spread {:.1f} degrees\n",
                        torsion_label(s, job.molecule->torsions()[found.torsions[k]]), found.turn_spreads[k] / degree);
  if (all.model.count > 0) text += "conformations rebuilt by these torsions: " + deviation_text(s, all.model) + "\n";
  return text;
}

Json rigid_groups_json(const Options& options, const Job& job) {
  const Structure& s = job.molecule->structure();
  const EnsembleGroups& found = *job.ensemble;
  const Deviations all = measure(options, job);
  Json json{{"conformations", all.groups.front().count}, {"groups", Json::array()}, {"torsions", Json::array()}};
  for (std::size_t g = 0; g < found.groups.size(); ++g) {
    const EnsembleGroup& group = found.groups[g];
    Json one{{"atoms", group.size()}, {"residues", residues_text(s, group.atoms())}, {"segments", Json::array()}};
    for (const auto& segment : group.segments) one["segments"].push_back(segment);
    one["distance_spread"] = rounded(group.spread);
    one["superposed"] = deviation_json(s, all.groups[g]);
    json["groups"].push_back(std::move(one));
  }
  for (std::size_t k = 0; k < found.torsions.size(); ++k)
    json["torsions"].push_back({{"torsion", torsion_label(s, job.molecule->torsions()[found.torsions[k]])},
                                {"spread_degrees", rounded(found.turn_spreads[k] / degree)}});
  json["rebuilt"] = deviation_json(s, all.model);
  return json;
}

}  // namespace biocd
