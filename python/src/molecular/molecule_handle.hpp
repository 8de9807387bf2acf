// SPDX-License-Identifier: BSD-3-Clause
// MoleculeHandle: a molecule as Python holds it, and what its arguments share with other classes.
#pragma once

#include <pybind11/pybind11.h>

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "hinge/core/vec3.hpp"
#include "hinge/molecular/molecule.hpp"
#include "hinge/molecular/part.hpp"
#include "hinge/molecular/read_structure.hpp"
#include "hinge/molecular/sampler.hpp"
#include "made_caster.hpp"

namespace hinge::python {

/// A molecule that Python objects share. It does not change.
struct MoleculeHandle {
  using MadeByInit = void;
  std::shared_ptr<const molecular::Molecule> molecule;
  std::vector<molecular::PlacementRange> ranges{};  ///< one per placed part
  molecular::ReadOptions read{};                    ///< how its files were read

  const molecular::Molecule& operator*() const noexcept { return *molecule; }
  const molecular::Molecule* operator->() const noexcept { return molecule.get(); }
  const molecular::Structure& structure() const noexcept { return molecule->structure(); }
  std::size_t atom_count() const noexcept { return structure().atoms.size(); }
};

/// Returns a part from words or from indices of residues. Throws as find_part() does, TypeError and IndexError.
molecular::Part as_part(const molecular::Structure& structure, pybind11::handle value, const char* name,
                        molecular::ResidueNames names = molecular::ResidueNames::all);

/// Returns the positions as rows of three numbers.
inline const double* numbers(const Vec3* positions) noexcept { return positions->data(); }
/// Returns rows of three numbers as positions.
inline std::span<const Vec3> positions_at(const double* numbers, std::size_t count) noexcept {
  static_assert(sizeof(Vec3) == 3 * sizeof(double) && alignof(Vec3) == alignof(double));
  return {reinterpret_cast<const Vec3*>(numbers), count};
}

void bind_molecule(pybind11::module_& module);
void bind_checker(pybind11::module_& module);
void bind_trajectory(pybind11::module_& module);
void bind_ensemble(pybind11::module_& module);

}  // namespace hinge::python
