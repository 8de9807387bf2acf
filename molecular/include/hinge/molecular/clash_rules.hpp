// SPDX-License-Identifier: BSD-3-Clause
// ClashRules: definitions of a clash by name: BioCD's own criterion, and those of programs that users compare with.
#pragma once

#include <string_view>
#include <vector>

#include "hinge/core/api.hpp"
#include "hinge/molecular/bond_exclusions.hpp"

namespace hinge::molecular {

/// Radii, cutoff, hydrogen bonds and bond distance of a program, so that verdicts equal those of that program.
struct ClashRules {
  std::string_view name;           ///< name on the command line
  std::string_view version;        ///< changes with every change of a number
  std::string_view source;         ///< publication or program
  std::string_view radii;          ///< name of the radii set; empty: chosen by the user
  std::string_view radii_version;  ///< empty: chosen by the user
  MinBonds min_bonds;              ///< number of bonds from which a pair counts
  bool inside_residues;            ///< pairs inside one residue count
  double hydrogen_bond_allowance;  ///< angstrom, of an uncharged hydrogen bond; 0: chosen by the user, or none
};

/// The rules biocd, severe, molprobity, chimerax and posebusters; a static object.
HINGE_API const std::vector<ClashRules>& all_clash_rules();

/// Returns the rules of this name; a static object. Throws ModelError, with the known names, if there are none.
HINGE_API const ClashRules& clash_rules(std::string_view name);

}  // namespace hinge::molecular
