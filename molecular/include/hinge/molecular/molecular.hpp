// SPDX-License-Identifier: BSD-3-Clause
// Every public header of hinge::molecular.
#pragma once

#include "hinge/molecular/bond_exclusions.hpp"
#include "hinge/molecular/bond_gauge.hpp"
#include "hinge/molecular/bonds.hpp"
#include "hinge/molecular/checker.hpp"
#include "hinge/molecular/clash_rules.hpp"
#include "hinge/molecular/closed_sampler.hpp"
#include "hinge/molecular/components.hpp"
#include "hinge/molecular/ensemble_groups.hpp"
#include "hinge/molecular/ensemble_spread.hpp"
#include "hinge/molecular/fit_coordinates.hpp"
#include "hinge/molecular/fit_torsions.hpp"
#include "hinge/molecular/free_sampler.hpp"
#include "hinge/molecular/held_placement.hpp"
#include "hinge/molecular/ideal_protein.hpp"
#include "hinge/molecular/join_structures.hpp"
#include "hinge/molecular/kept_closures.hpp"
#include "hinge/molecular/loop.hpp"
#include "hinge/molecular/molecule.hpp"
#include "hinge/molecular/pair_scope.hpp"
#include "hinge/molecular/part.hpp"
#include "hinge/molecular/path_checker.hpp"
#include "hinge/molecular/plan.hpp"
#include "hinge/molecular/radii.hpp"
#include "hinge/molecular/read_structure.hpp"
#include "hinge/molecular/relax.hpp"
#include "hinge/molecular/sampler.hpp"
#include "hinge/molecular/selection.hpp"
#include "hinge/molecular/severity.hpp"
#include "hinge/molecular/structure.hpp"
#include "hinge/molecular/summary.hpp"
#include "hinge/molecular/torsion_prior.hpp"
#include "hinge/molecular/torsions.hpp"
#include "hinge/molecular/trajectory.hpp"
#include "hinge/molecular/walker.hpp"
#include "hinge/molecular/write_structure.hpp"
#include "hinge/molecular/write_trajectory.hpp"

/// Proteins, nucleic acids and ligands as articulated models: files, torsions, clash rules, sampling. Lengths in
/// angstroms, angles in radians.
namespace hinge::molecular {}
