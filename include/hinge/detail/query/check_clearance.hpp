// SPDX-License-Identifier: BSD-3-Clause
// check_clearance: refuses extra clearances of a query that no engine can take.
#pragma once

#include <cstddef>
#include <span>
#include <string>

#include "hinge/core/error.hpp"
#include "hinge/core/finite.hpp"
#include "hinge/core/number_text.hpp"

namespace hinge::detail {

/// ConfigurationError: neither empty nor one per rigid group, or a clearance that is not a finite length >= 0.
inline void check_clearance(std::span<const double> clearance, std::size_t groups) {
  if (!clearance.empty() && clearance.size() != groups)
    throw ConfigurationError(std::to_string(clearance.size()) + " extra clearances, expected one for each of " +
                             std::to_string(groups) + " rigid groups");
  for (std::size_t g = 0; g < clearance.size(); ++g)
    if (!is_length(clearance[g]) || clearance[g] < 0.0)
      throw ConfigurationError("extra clearance of rigid group " + std::to_string(g) + " is " +
                               number_text(clearance[g]) + ": expected a finite length >= 0");
}

}  // namespace hinge::detail
