// SPDX-License-Identifier: BSD-3-Clause
// join_structures: the molecules of several files as one structure.
#pragma once

#include <vector>

#include "hinge/core/api.hpp"
#include "hinge/molecular/structure.hpp"

namespace hinge::molecular {

/// Returns the atoms, residues, chains and bonds of all structures in order, at their own coordinates, without bonds
/// between them. A chain name that an earlier structure uses is replaced by the first free one of A-Z, a-z, 0-9, and a
/// note says so. At most one structure may have several models; the others are repeated in each model. Throws
/// ModelError if two have several models, if no chain name is left, or if `structures` is empty.
HINGE_API Structure join_structures(std::vector<Structure> structures);

}  // namespace hinge::molecular
