// SPDX-License-Identifier: BSD-3-Clause
// What a molecule's scene requires: which atoms move, and which ones nothing can reach.
#pragma once

#include <vector>

#include "hinge_tools/dial_report.hpp"
#include "options.hpp"

namespace biocd {

/// Studies the model itself; no result depends on samples.
std::vector<hinge::tool::DialRequirement> study_scene(const Job& job);

}  // namespace biocd
