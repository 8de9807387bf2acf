// SPDX-License-Identifier: BSD-3-Clause
// Implements parse_numbers.
#include "description/parse_numbers.hpp"

#include "hinge/core/finite.hpp"

namespace hinge::robotics {

std::optional<std::vector<double>> parse_numbers(std::string_view text) {
  std::vector<double> numbers;
  for (std::string_view word = next_word(text); !word.empty(); word = next_word(text)) {
    const std::optional<double> value = parse_number<double>(word);
    if (!value || !is_finite(*value)) return {};
    numbers.push_back(*value);
  }
  return numbers;
}

}  // namespace hinge::robotics
