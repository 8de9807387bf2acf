// SPDX-License-Identifier: BSD-3-Clause
// Finds the rigid groups of --rigid-from, and reports how well they fit the conformations.
#pragma once

#include <memory>
#include <optional>
#include <span>
#include <string>

#include "hinge/molecular/ensemble_groups.hpp"
#include "hinge/molecular/molecule.hpp"
#include "options.hpp"
#include "report.hpp"

namespace biocd {

/// Returns the rigid groups of the conformations of --rigid-from. torsions: the torsions that may turn, as indices into
/// Molecule::torsions(). Throws LoadError, naming file and frame, if a conformation cannot be used; ModelError if there
/// are fewer than two.
hinge::molecular::EnsembleGroups find_rigid_groups(const Options& options, const hinge::molecular::Molecule& molecule,
                                                   std::span<const std::size_t> torsions);

/// Returns a table of the groups, the free torsions, and the deviations of groups and rebuilt molecule. Reads all
/// conformations of --rigid-from again and throws LoadError as find_rigid_groups does.
std::string rigid_groups_text(const Options& options, const Job& job);
/// Returns the same as JSON.
Json rigid_groups_json(const Options& options, const Job& job);

}  // namespace biocd
