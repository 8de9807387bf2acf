// SPDX-License-Identifier: BSD-3-Clause
// What a structure is made of: residues by kind, torsions by kind.
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <span>
#include <string>

#include "hinge/molecular/structure.hpp"
#include "hinge/molecular/torsions.hpp"

namespace hinge::molecular {

/// "protein", "DNA", "RNA", "ion", "cap" (of a chain's end) or "ligand". A nucleotide with O2' is RNA's, modified or
/// not; an ion is one atom outside of polymers.
std::string residue_class(const Structure& structure, std::uint32_t residue);

/// Residues of one class.
struct ClassSummary {
  std::size_t residues = 0;
  std::map<std::string, std::size_t> chains;  ///< residues by chain
  std::map<std::string, std::size_t> names;   ///< residues by name
};

std::map<std::string, ClassSummary> residues_by_class(const Structure& structure);

/// Torsions by name; rotatable bonds, which are called by their atoms, as "bonds of KNI".
std::map<std::string, std::size_t> torsions_by_kind(const Structure& structure, std::span<const Torsion> torsions);

}  // namespace hinge::molecular
