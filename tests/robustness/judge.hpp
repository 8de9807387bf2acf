// SPDX-License-Identifier: BSD-3-Clause
// Compares answers with the truth, and bounds the effects of rounding.
#pragma once

#include <string>
#include <vector>

#include "robustness/case.hpp"

namespace hinge::robustness {

/// Returns a sentence for every error in the answers of an engine to a case with known truth.
std::vector<std::string> faults(const Case& one, const std::vector<Answer>& answers);

/// Returns a bound of the rounding error of a vertex of a placed mesh.
double placed_rounding(const Mesh& mesh, const std::vector<double>& place);

/// The same for a link of a chain, including its frame and its vertices.
double link_rounding(const Chain& chain, std::size_t link);

}  // namespace hinge::robustness
