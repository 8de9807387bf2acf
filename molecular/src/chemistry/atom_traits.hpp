// SPDX-License-Identifier: BSD-3-Clause
// AtomTraits: the properties of an atom that the named rules use; atoms with equal traits share a type.
#pragma once

#include <string>
#include <tuple>
#include <vector>

#include "hinge/molecular/radii.hpp"
#include "hinge/molecular/structure.hpp"

namespace hinge::molecular {

/// Properties of an atom under one of the named rules.
struct AtomTraits {
  std::string name;              ///< name of the type, without the suffixes of the properties below
  double radius = 0.0;           ///< angstrom
  double covalent_radius = 0.0;  ///< angstrom; posebusters only, for pairs with an ion
  bool donor = false;            ///< of a hydrogen bond
  bool acceptor = false;         ///< of a hydrogen bond
  int charge = 0;                ///< sign of the charge of the atom or its group: -1, 0, 1
  bool ion = false;              ///< monatomic ion
  bool ignored = false;          ///< no pair with it is a clash

  friend bool operator<(const AtomTraits& a, const AtomTraits& b) {
    const auto all = [](const AtomTraits& t) {
      return std::tie(t.name, t.radius, t.covalent_radius, t.donor, t.acceptor, t.charge, t.ion, t.ignored);
    };
    return all(a) < all(b);
  }
};

/// Return one value per atom, by the rules of the program.
std::vector<AtomTraits> molprobity_atoms(const Structure& structure);
std::vector<AtomTraits> chimerax_atoms(const Structure& structure);
std::vector<AtomTraits> posebusters_atoms(const Structure& structure);

/// classify_atoms with Probe's classes by residue name: aromatic bases and haems, and only elements in residues that it
/// does not know.
std::vector<AtomClass> probe_classes(const Structure& structure);

/// True if the class donates or accepts hydrogen bonds, in a structure with hydrogens.
bool is_polar_hydrogen(AtomClass c);
bool is_acceptor(AtomClass c);

/// Returns "C.aromatic"; for class `other` the element.
std::string type_name(AtomClass c, const std::string& element);

/// Returns the thresholds of rules other than biocd.
Thresholds make_named_thresholds(const Structure& structure, const ClashRules& rules);

}  // namespace hinge::molecular
