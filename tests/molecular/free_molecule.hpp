// SPDX-License-Identifier: BSD-3-Clause
// FreeMolecule: a molecule with free torsions and the closures to keep, as the tools make it.
#pragma once

#include <memory>
#include <string>

#include "hinge/molecular/checker.hpp"
#include "hinge/molecular/kept_closures.hpp"
#include "hinge/molecular/loop.hpp"
#include "hinge/molecular/molecule.hpp"
#include "hinge/molecular/part.hpp"
#include "hinge/molecular/selection.hpp"
#include "hinge/molecular/structure.hpp"

namespace hinge::test {

/// Options as in biocd: free torsions, loops whose ends are held, the part that can be placed. Empty: none.
struct FreeMolecule {
  FreeMolecule(const molecular::Structure& structure, const std::string& free, const std::string& loop = "",
               const std::string& placed = "") {
    molecular::MoleculeOptions made;
    if (!loop.empty()) made.loops = find_loops(structure, loop);
    if (!placed.empty()) made.placed.push_back(find_part(structure, placed));
    molecule = std::make_shared<const molecular::Molecule>(structure, made);
    const auto torsions =
        loop.empty() ? select_torsions(*molecule, free, false) : select_loop_torsions(*molecule, free, false);
    kept = find_kept_closures(*molecule, torsions, molecular::Closures::all);
  }
  /// A checker of the free torsions and placements. engine: replaces that of the options.
  molecular::Checker checker(molecular::CheckOptions options, const std::string& engine) const {
    options.engine = engine;
    return {molecule, molecule->select_placed(kept.torsions), options};
  }

  std::shared_ptr<const molecular::Molecule> molecule;
  molecular::KeptClosures kept;
};

}  // namespace hinge::test
