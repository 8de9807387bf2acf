// SPDX-License-Identifier: BSD-3-Clause
// ClashRules: what counts as a clash, by name: BioCD's own criterion, and those of programs people compare with.
#pragma once

#include <string_view>
#include <vector>

#include "hinge/molecular/bond_exclusions.hpp"

namespace hinge::molecular {

/// Radii, cutoff, hydrogen bonds and bond distance as another program has them, so that our verdicts are its verdicts.
struct ClashRules {
  std::string_view name;     ///< as on the command line
  std::string_view version;  ///< changes whenever a number does
  std::string_view source;
  std::string_view radii;          ///< which set; empty: as chosen
  std::string_view radii_version;  ///< empty: as chosen
  MinBonds min_bonds;              ///< bond distance at which a pair starts to count
  bool inside_residues;            ///< do pairs of one residue count?
  double hydrogen_bond_allowance;  ///< angstrom; 0: as chosen, or none
};

/// biocd, severe, molprobity, chimerax, posebusters.
const std::vector<ClashRules>& all_clash_rules();

/// ModelError, listing the names, when there are none of that name.
const ClashRules& clash_rules(std::string_view name);

}  // namespace hinge::molecular
