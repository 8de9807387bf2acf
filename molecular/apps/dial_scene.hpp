// SPDX-License-Identifier: BSD-3-Clause
// What a molecule's scene requires: which atoms move, and which ones nothing can reach.
#pragma once

#include <cstdint>
#include <vector>

#include "hinge_tools/dial_report.hpp"
#include "options.hpp"

namespace biocd {

/// Returns the atoms of the fixed rigid group that no moving atom can bring within a threshold, for any values of the
/// free torsions: proved by the lengths of the chains between torsions. Empty if parts are placed.
std::vector<std::uint32_t> unreachable_atoms(const Job& job);

/// Studies the model itself; no result depends on samples.
std::vector<hinge::tool::DialRequirement> study_scene(const Job& job);

}  // namespace biocd
