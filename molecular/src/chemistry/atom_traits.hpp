// SPDX-License-Identifier: BSD-3-Clause
// AtomTraits: what the named rules look at in an atom; atoms that agree in all of it share a type.
#pragma once

#include <string>
#include <tuple>
#include <vector>

#include "hinge/molecular/radii.hpp"
#include "hinge/molecular/structure.hpp"

namespace hinge::molecular {

struct AtomTraits {
  std::string name;              ///< of the type, before what follows is added
  double radius = 0.0;           ///< angstrom
  double covalent_radius = 0.0;  ///< angstrom; posebusters only, for pairs with an ion
  bool donor = false;            ///< of hydrogen bonds
  bool acceptor = false;
  int charge = 0;  ///< -1, 0, 1
  bool ion = false;
  bool ignored = false;  ///< no pair of it is a clash

  friend bool operator<(const AtomTraits& a, const AtomTraits& b) {
    const auto all = [](const AtomTraits& t) {
      return std::tie(t.name, t.radius, t.covalent_radius, t.donor, t.acceptor, t.charge, t.ion, t.ignored);
    };
    return all(a) < all(b);
  }
};

std::vector<AtomTraits> molprobity_atoms(const Structure& structure);
std::vector<AtomTraits> chimerax_atoms(const Structure& structure);
std::vector<AtomTraits> posebusters_atoms(const Structure& structure);

/// classify_atoms, with what Probe sees in residues by their names: aromatic bases and haems, and only atoms in
/// residues that it does not know.
std::vector<AtomClass> probe_classes(const Structure& structure);

/// In hydrogen bonds of a structure whose hydrogens are there.
bool is_polar_hydrogen(AtomClass c);
bool is_acceptor(AtomClass c);

/// "C.aromatic"; of other atoms the element.
std::string type_name(AtomClass c, const std::string& element);

/// By the named rules.
Thresholds make_named_thresholds(const Structure& structure, const ClashRules& rules);

}  // namespace hinge::molecular
