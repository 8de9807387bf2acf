// SPDX-License-Identifier: BSD-3-Clause
// side_chains: the values of a configuration that turn side chains. Tests and benchmarks use it.
#pragma once

#include <algorithm>
#include <cstddef>
#include <vector>

#include "hinge/molecular/checker.hpp"
#include "hinge/molecular/molecule.hpp"
#include "hinge/molecular/selection.hpp"

namespace hinge::test {

/// Returns indices in the checker's configurations, in increasing order.
inline std::vector<std::size_t> side_chains(const molecular::Checker& checker) {
  const molecular::Molecule& molecule = checker.molecule();
  const std::vector<std::size_t> chis = molecular::select_torsions(molecule, "chi", false);
  std::vector<std::size_t> values;
  for (std::size_t k = 0; k < checker.dof_count(); ++k)
    if (std::ranges::find(chis, molecule.torsion_of(checker.selection().dofs()[k])) != chis.end()) values.push_back(k);
  return values;
}

}  // namespace hinge::test
