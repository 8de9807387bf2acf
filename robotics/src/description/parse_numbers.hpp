// SPDX-License-Identifier: BSD-3-Clause
// parse_numbers: reads numbers from text, independent of the locale.
#pragma once

#include <optional>
#include <string_view>
#include <vector>

namespace hinge::robotics {

/// Largest joint value that files may state, rad or m. Programs write larger ones where a joint has no limit.
inline constexpr double largest_joint_value = 1e15;

/// Returns finite numbers separated by blanks, or nothing if the text contains anything else.
std::optional<std::vector<double>> parse_numbers(std::string_view text);

}  // namespace hinge::robotics
