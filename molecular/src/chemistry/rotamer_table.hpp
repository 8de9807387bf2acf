// SPDX-License-Identifier: BSD-3-Clause
// rotamers: how often side chains of amino acids occur in each of their conformations.
#pragma once

#include <cstddef>

namespace hinge::molecular {

/// One conformation of a side chain.
struct Rotamer {
  char residue[4];   ///< residue name
  double share;      ///< per cent of this residue's side chains
  int chis;          ///< number of torsions
  double mean[4];    ///< chi1 ... chi4, degrees
  double spread[4];  ///< their standard deviations, degrees
};

/// Sorted by residue. Source: Top8000, see rotamer_table.cpp.
extern const Rotamer rotamers[];
extern const std::size_t rotamer_count;  ///< number of rotamers

}  // namespace hinge::molecular
