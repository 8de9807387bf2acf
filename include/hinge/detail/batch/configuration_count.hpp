// SPDX-License-Identifier: BSD-3-Clause
// configuration_count: the number of configurations in a list of values.
#pragma once

#include <cstddef>
#include <span>
#include <string>

#include "hinge/core/error.hpp"

namespace hinge::detail {

/// values: configurations one after the other, dof_count values each. Throws ConfigurationError if the last one is not
/// complete, or if there are values for configurations without any.
inline std::size_t configuration_count(std::span<const double> values, std::size_t dof_count) {
  if (dof_count == 0 ? !values.empty() : values.size() % dof_count != 0)
    throw ConfigurationError(std::to_string(values.size()) + " values, expected a multiple of " +
                             std::to_string(dof_count) + ", the number of values of one configuration");
  return dof_count == 0 ? 0 : values.size() / dof_count;
}

}  // namespace hinge::detail
