// SPDX-License-Identifier: BSD-3-Clause
// Joining structures: the molecules of several files as one structure.
#pragma once

#include <vector>

#include "hinge/molecular/structure.hpp"

namespace hinge::molecular {

/// Atoms, residues, chains and bonds of all, one file after the other, in the coordinates they have; no bonds between
/// them. A chain name that an earlier file uses becomes the first free one of A-Z, a-z, 0-9, and a note says so. At
/// most one may have several models: the others stand still beside them. ModelError: several that have; no name left;
/// nothing to join.
Structure join_structures(std::vector<Structure> structures);

}  // namespace hinge::molecular
