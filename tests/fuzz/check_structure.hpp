// SPDX-License-Identifier: BSD-3-Clause
// Runs a molecular file from reading to the answers of a checker.
#pragma once

#include <cstddef>
#include <memory>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "fuzz/require.hpp"
#include "fuzz/scratch_file.hpp"
#include "hinge/core/finite.hpp"
#include "hinge/molecular/checker.hpp"
#include "hinge/molecular/molecule.hpp"
#include "hinge/molecular/read_structure.hpp"
#include "hinge/molecular/selection.hpp"

namespace fuzz {

/// Requires that every index is in range, every range is in order, and every coordinate is finite.
inline void check_well_formed(const hinge::molecular::Structure& s) {
  require(!s.atoms.empty() && !s.models.empty(), "a structure without atoms or models");
  require(s.models.size() == s.model_numbers.size(), "models without numbers");
  for (const auto& model : s.models) {
    require(model.size() == s.atoms.size(), "a model of another number of atoms");
    for (const hinge::Vec3& x : model) require(hinge::is_finite(x), "a coordinate that is not finite");
  }
  std::size_t atom = 0, residue = 0;
  for (const auto& chain : s.chains) {
    require(chain.first_residue == residue && chain.last_residue >= residue, "chains that leave out residues");
    residue = chain.last_residue;
  }
  require(residue == s.residues.size(), "residues of no chain");
  for (const auto& r : s.residues) {
    require(r.first_atom == atom && r.last_atom >= atom, "residues that leave out atoms");
    require(r.chain < s.chains.size(), "a residue of a chain that is not there");
    atom = r.last_atom;
  }
  require(atom == s.atoms.size(), "atoms of no residue");
  for (const auto& a : s.atoms) require(a.residue < s.residues.size(), "an atom of a residue that is not there");
  for (const auto& bond : s.bonds) require(bond.first < bond.second && bond.second < atom, "a bond of no two atoms");
  for (const auto& bond : s.bond_records)
    require(bond.first < atom && bond.second < atom, "a bond record of an atom that is not there");
  for (const auto& element : s.secondary_structure)
    require(element.first <= element.last && element.last < residue, "a helix or strand of no residues");
}

/// Starts with the reference, where the coordinates equal those of the file.
inline void check_answers(const std::shared_ptr<const hinge::molecular::Molecule>& molecule) {
  using hinge::molecular::Checker;
  using hinge::molecular::Mode;
  hinge::molecular::CheckOptions options;
  std::vector<std::size_t> all;
  for (std::size_t k = 0; k < molecule->torsions().size(); ++k) all.push_back(k);
  Checker simd(molecule, molecule->select(all), options);
  options.engine = "brute";
  Checker brute(molecule, molecule->select(all), options);
  std::vector<double> q(simd.dof_count(), 0.0);
  const auto& read = molecule->structure().models.front();
  simd.check(q, {Mode::Kind::all, 0.0});
  require(simd.positions() == read, "the reference differs from the file");
  for (double& value : q) value = 0.5;
  for (const Mode& mode : {Mode{Mode::Kind::all, 0.0}, Mode{Mode::Kind::within, 0.5}, Mode{Mode::Kind::any, 0.0},
                           Mode{Mode::Kind::closest, 0.0}}) {
    const auto fast = simd.check(q, mode), slow = brute.check(q, mode);
    require(fast.collides == slow.collides, "simd and brute differ in a yes or no");
    require(fast.pairs == slow.pairs, "simd and brute differ in their pairs");
    require(fast.closest.has_value() == slow.closest.has_value() &&
                (!fast.closest || fast.closest->hit.gap() == slow.closest->hit.gap()),
            "simd and brute differ in the closest pair");
  }
  require(simd.check_coordinates(read, {}).pairs == brute.check_coordinates(read, {}).pairs,
          "simd and brute differ in the file's coordinates");
}

/// The length of the file selects the options, so that a find is only a file.
inline void check_structure(const std::string& name, std::string_view content) {
  using hinge::molecular::ReadOptions;
  const ScratchFile file(name, content);
  ReadOptions options;
  if (content.size() % 4 == 1) options = {1, 'B', true, false};
  if (content.size() % 4 == 2) options.hetero = true;
  accepts([&] {
    hinge::molecular::Structure structure = hinge::molecular::read_structure(file.path(), options);
    check_well_formed(structure);
    // Brute force is quadratic, but inputs of fuzzers are small.
    check_answers(std::make_shared<const hinge::molecular::Molecule>(std::move(structure)));
  });
}

}  // namespace fuzz
