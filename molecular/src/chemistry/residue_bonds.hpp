// SPDX-License-Identifier: BSD-3-Clause
// ResidueBonds: bonds inside residues, by table, component, CONECT records or covalent radii; hydrogens by name, else
// by distance.
#pragma once

#include <cstdint>
#include <map>
#include <set>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "chemistry/bond_list.hpp"
#include "chemistry/counted.hpp"
#include "hinge/molecular/components.hpp"
#include "hinge/molecular/structure.hpp"

namespace hinge::molecular {

/// Adds bonds to a BondList, residue by residue. Keeps references to its arguments.
class ResidueBonds {
 public:
  ResidueBonds(Structure& structure, BondList& bonds, ComponentLibrary& components);

  /// Adds the bonds inside a residue, from the first source that knows it.
  void add(std::uint32_t residue);
  /// Writes Structure::bond_sources and the notes; call once, after the last add().
  void say();

 private:
  /// Calls visit(name, name) for each bond of the residue's table; false if it has no table.
  template <class Visit>
  bool for_each_table_bond(std::uint32_t residue, const Visit& visit) const;
  const Component* fitting_component(std::uint32_t r);
  bool may_bond(std::uint32_t i, std::uint32_t j) const;
  bool has_all(const std::set<std::uint32_t>& known, const Residue& residue) const;
  bool add_conect(const Residue& residue);
  void add_by_radii(const Residue& residue, const std::set<std::uint32_t>& known);
  void add_hydrogen(std::uint32_t h, std::uint32_t r);
  std::string source_of(std::uint32_t r);

  Structure& s_;
  BondList& bonds_;
  ComponentLibrary& components_;
  std::vector<BondRecord> conect_;                                      // bonds inside residues, sorted by first atom
  std::map<std::pair<std::string, std::string>, std::size_t> sources_;  // (residue name, source) -> residues
  std::map<std::string, Counted> misfits_;  // residues that a component of the dictionary does not fit, by its name
  Counted unknown_;                         // residues without any atom of their table
  Counted alone_;                           // hydrogens without a bond
  std::set<std::string> extended_;          // names of residues with atoms that their table or component lacks
};

/// Returns the heavy atoms of a polymer residue that can bear a hydrogen of this name (IUPAC 1998 and older styles):
/// HD11 is on CD1, HG1 of threonine on OG1, H61 of a purine on N6 or C6. Empty if the name tells nothing.
std::vector<std::uint32_t> bearers_by_name(const Structure& structure, std::uint32_t hydrogen);

}  // namespace hinge::molecular
