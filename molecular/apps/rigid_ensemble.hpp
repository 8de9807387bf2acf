// SPDX-License-Identifier: BSD-3-Clause
// Rigid groups of --rigid-from: found before a question is asked, and how well they stand for the conformations.
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

/// The groups of --rigid-from, of a molecule whose `torsions` may turn. LoadError names file and frame.
hinge::molecular::EnsembleGroups find_rigid_groups(const Options& options, const hinge::molecular::Molecule& molecule,
                                                   std::span<const std::size_t> torsions);

/// What the groups and the model they make leave of each conformation, for people or as JSON; goes through them again.
std::string rigid_groups_text(const Options& options, const Job& job);
Json rigid_groups_json(const Options& options, const Job& job);

}  // namespace biocd
