// SPDX-License-Identifier: BSD-3-Clause
// Numbers from text, whatever the locale.
#pragma once

#include <optional>
#include <string_view>
#include <vector>

namespace hinge::robotics {

/// Finite numbers separated by blanks; none when anything else stands in the text.
std::optional<std::vector<double>> parse_numbers(std::string_view text);

}  // namespace hinge::robotics
