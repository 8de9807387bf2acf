// SPDX-License-Identifier: BSD-3-Clause
// configuration_count: the number of configurations in a list of values. naming_configuration: errors of one of them.
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

/// Calls work(). If it throws a ConfigurationError, the error names configuration k of a list.
template <class Work>
void naming_configuration(std::size_t k, const Work& work) {
  try {
    work();
  } catch (const ConfigurationError& error) {
    throw ConfigurationError("configuration " + std::to_string(k) + ": " + error.what());
  }
}

}  // namespace hinge::detail
