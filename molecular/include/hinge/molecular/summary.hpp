// SPDX-License-Identifier: BSD-3-Clause
// Counts of a structure's residues and torsions by kind.
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <span>
#include <string>

#include "hinge/core/api.hpp"
#include "hinge/molecular/structure.hpp"
#include "hinge/molecular/torsions.hpp"

namespace hinge::molecular {

/// Returns "protein", "DNA", "RNA", "cap" (of a chain's end), "ion" or "ligand". A nucleotide with O2' is RNA, modified
/// or not. An ion is a residue of one atom outside polymers. residue: index in structure.residues.
HINGE_API std::string residue_class(const Structure& structure, std::uint32_t residue);

/// Number of residues of one class.
struct ClassSummary {
  std::size_t residues = 0;                   ///< in all chains
  std::map<std::string, std::size_t> chains;  ///< number of residues by chain; "_": blank name
  std::map<std::string, std::size_t> names;   ///< number of residues by residue name
};

/// Returns the residues of a structure by residue_class.
HINGE_API std::map<std::string, ClassSummary> residues_by_class(const Structure& structure);

/// Returns the number of torsions by name. Rotatable bonds, which are named by their atoms, are counted by residue
/// name, as "bonds of KNI".
HINGE_API std::map<std::string, std::size_t> torsions_by_kind(const Structure& structure,
                                                              std::span<const Torsion> torsions);

}  // namespace hinge::molecular
