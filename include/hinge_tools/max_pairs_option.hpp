// SPDX-License-Identifier: BSD-3-Clause
// add_max_pairs: the option --max-pairs, and what it means for a list.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>

#include "hinge/core/number_text.hpp"
#include "hinge_tools/number_option.hpp"

namespace hinge::tool {

/// Pairs that a table lists for each conformation if --max-pairs is not given.
inline constexpr std::uint64_t usual_max_pairs = 20;

/// Adds --max-pairs to a CLI11 command, and returns the option. `value` gets the number; 0 means all.
template <class Command>
auto* add_max_pairs(Command& command, std::optional<std::uint64_t>& value) {
  auto* const added = command.template add_option_function<std::string>(
      "--max-pairs",
      [&value](const std::string& text) {
        constexpr NumberRange<std::uint64_t> range{0, std::uint64_t{1} << 53};
        value = text == "all" ? 0 : read_number<std::uint64_t>("--max-pairs", text, range);
      },
      "largest number of pairs to print for each conformation; 0 or all: no limit (default: " +
          number_text(usual_max_pairs) + " in tables, all with --json and --csv)");
  added->type_name("N|all");
  return added;
}

/// Returns how many of `size` pairs to print. is_table: false for JSON and CSV.
inline std::size_t pairs_to_print(const std::optional<std::uint64_t>& max_pairs, bool is_table, std::size_t size) {
  const std::uint64_t most = max_pairs.value_or(is_table ? usual_max_pairs : 0);
  return most == 0 ? size : static_cast<std::size_t>(std::min<std::uint64_t>(most, size));
}

/// Returns the line after a list that was cut, with its line end; empty if nothing was left out.
inline std::string left_out_text(std::size_t left_out) {
  if (left_out == 0) return {};
  return "  ... and " + number_text(left_out) + " more; --max-pairs all lists them\n";
}

}  // namespace hinge::tool
