// SPDX-License-Identifier: BSD-3-Clause
// fit_coordinates: the conformation nearest to given coordinates. match_atoms: the atoms of another structure by name.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "hinge/core/api.hpp"
#include "hinge/core/vec3.hpp"
#include "hinge/molecular/checker.hpp"
#include "hinge/molecular/fit_torsions.hpp"
#include "hinge/molecular/structure.hpp"

namespace hinge::molecular {

/// Some atoms of a molecule, and where they should be.
struct TargetCoordinates {
  std::vector<std::uint32_t> atoms;  ///< indices in Structure::atoms, each once
  std::vector<Vec3> positions;       ///< one per entry of `atoms`, angstrom, in any frame
};

/// Returns a target of all atoms; positions: one per atom, angstrom.
HINGE_API TargetCoordinates all_atoms(std::vector<Vec3> positions);

/// Returns the distances from the target after superposition (superpose() of two lists), angstrom; `atom` is an index
/// in Structure::atoms. positions: one per atom of the structure, angstrom. The target has at least one atom, and all
/// of its atoms are in the structure.
HINGE_API Superposition superpose(std::span<const Vec3> positions, const TargetCoordinates& target);

/// Options of fit_coordinates().
struct FitOptions {
  std::vector<std::size_t> closures{};  ///< closures to keep (find_kept_closures), indices in the tree's
  bool collision_free = false;          ///< move the result, as little as possible, until no pair collides
};

/// The result of fit_coordinates().
struct CoordinateFit {
  std::vector<double> q;       ///< one value per selected DOF, relative to the reference, rad or angstrom
  double rmsd = 0.0;           ///< root mean square distance from the target after superposition, angstrom
  double farthest = 0.0;       ///< largest distance, angstrom
  std::uint32_t atom = 0;      ///< the atom with that distance, index in Structure::atoms
  std::size_t collisions = 0;  ///< pairs that collide at q
  bool stopped = false;        ///< stop() ended the search
};

/// Finds the conformation whose atoms are nearest to the target: it minimises the mean squared distance after the best
/// superposition (superpose()) with L-BFGS (Nocedal 1980; NLopt). Bond lengths, bond angles and torsions that are not
/// selected stay as in the reference, so the target is met as closely as the selection allows. Collisions do not count
/// unless `collision_free` is set: then the steric energy is added (Checker::steric), with a growing weight, until no
/// pair collides. `collisions` says whether it did.
///
/// It descends from the reference, and from the torsions that the target has where their four atoms are known
/// (turn_of()), and returns the better minimum. It is not the best of all for certain. Angles are within half a turn of
/// the reference. Closures are closed by ClosureSolver. stop: called at every evaluation; if it returns true, the
/// search ends with the best conformation so far. The checker is copied. Throws ModelError if the target has no atom or
/// other numbers of atoms and positions, or an atom or closure does not exist; ConfigurationError if a position is not
/// finite.
HINGE_API CoordinateFit fit_coordinates(const Checker& checker, const TargetCoordinates& target,
                                        const FitOptions& options = {}, const std::function<bool()>& stop = {});

/// Returns the atoms of `structure` that `other` has as well, with the positions of its first model. Atoms match by
/// chain name, residue number, insertion code, residue name and atom name; the order does not matter. If no chain name
/// of the two is the same, the first chain with a residue of a kind matches the first one, the second the second, and
/// so on. Throws LoadError if no atom matches, or if a residue has the same number and another name; `name` is the
/// name of the file in the message.
HINGE_API TargetCoordinates match_atoms(const Structure& structure, const Structure& other, const std::string& name);

}  // namespace hinge::molecular
