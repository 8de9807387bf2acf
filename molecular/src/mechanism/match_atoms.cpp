// SPDX-License-Identifier: BSD-3-Clause
// Matches the atoms of two structures by name.
#include <map>
#include <string>
#include <tuple>

#include "hinge/core/error.hpp"
#include "hinge/molecular/fit_coordinates.hpp"

namespace hinge::molecular {

namespace {

using Place = std::tuple<std::string, int, char>;  // chain, number, insertion code

/// Returns the residues by place; of several with one place the first.
std::map<Place, std::uint32_t> residues_by_place(const Structure& s,
                                                 const std::map<std::string, std::string>& renamed) {
  std::map<Place, std::uint32_t> found;
  for (std::uint32_t r = 0; r < s.residues.size(); ++r) {
    const Residue& residue = s.residues[r];
    const std::string& chain = s.chains[residue.chain].name;
    const auto other = renamed.find(chain);
    found.try_emplace({other == renamed.end() ? chain : other->second, residue.sequence_number, residue.insertion_code},
                      r);
  }
  return found;
}

/// Returns the new names of the chains of `other`, if no name is in both structures: those of `structure`, in order.
std::map<std::string, std::string> rename_chains(const Structure& structure, const Structure& other) {
  for (const Chain& a : structure.chains)
    for (const Chain& b : other.chains)
      if (a.name == b.name) return {};
  std::map<std::string, std::string> renamed;
  for (std::size_t c = 0; c < structure.chains.size() && c < other.chains.size(); ++c)
    renamed.try_emplace(other.chains[c].name, structure.chains[c].name);
  return renamed;
}

}  // namespace

TargetCoordinates match_atoms(const Structure& structure, const Structure& other, const std::string& name) {
  const auto places = residues_by_place(other, rename_chains(structure, other));
  TargetCoordinates target;
  for (std::uint32_t r = 0; r < structure.residues.size(); ++r) {
    const Residue& residue = structure.residues[r];
    const auto found =
        places.find({structure.chains[residue.chain].name, residue.sequence_number, residue.insertion_code});
    if (found == places.end()) continue;
    const Residue& same = other.residues[found->second];
    if (same.name != residue.name)
      throw LoadError(name + ": residue " + residue_label(other, found->second) + " is " + same.name + ", expected " +
                      residue.name + " as in " + residue_label(structure, r));
    std::map<std::string, std::uint32_t> atoms;
    for (std::uint32_t a = same.first_atom; a < same.last_atom; ++a) atoms.try_emplace(other.atoms[a].name, a);
    for (std::uint32_t a = residue.first_atom; a < residue.last_atom; ++a) {
      const auto atom = atoms.find(structure.atoms[a].name);
      if (atom == atoms.end()) continue;
      target.atoms.push_back(a);
      target.positions.push_back(other.models.front()[atom->second]);
    }
  }
  if (target.atoms.empty()) throw LoadError(name + ": no atom has the chain, residue and name of an atom of the model");
  return target;
}

}  // namespace hinge::molecular
