// SPDX-License-Identifier: BSD-3-Clause
// judge: an answer held against the truth, and what rounding may change.
#pragma once

#include <string>
#include <vector>

#include "robustness/case.hpp"

namespace hinge::robustness {

/// Everything wrong with the answers an engine gave to a case whose truth is known, one sentence each.
std::vector<std::string> faults(const Case& one, const std::vector<Answer>& answers);

/// Bound of how far rounding may put a vertex of a placed mesh (translation * rotation) from where it belongs.
double placed_rounding(const Mesh& mesh, const std::vector<double>& place);

/// The same of a link of a chain, its frame and its vertices.
double link_rounding(const Chain& chain, std::size_t link);

}  // namespace hinge::robustness
