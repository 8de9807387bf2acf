// SPDX-License-Identifier: BSD-3-Clause
// Implements parse_numbers with std::from_chars.
#include "description/parse_numbers.hpp"

#include <charconv>
#include <system_error>

#include "hinge/core/finite.hpp"

namespace hinge::robotics {

std::optional<std::vector<double>> parse_numbers(std::string_view text) {
  constexpr std::string_view blanks = " \t\r\n";
  std::vector<double> numbers;
  while (true) {
    const std::size_t start = text.find_first_not_of(blanks);
    if (start == std::string_view::npos) return numbers;
    text.remove_prefix(start);
    std::string_view word = text.substr(0, text.find_first_of(blanks));
    text.remove_prefix(word.size());
    if (word.size() > 1 && word[0] == '+' && word[1] != '-') word.remove_prefix(1);
    double value = 0.0;
    const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
    if (error != std::errc{} || end != word.data() + word.size() || !is_finite(value)) return {};
    numbers.push_back(value);
  }
}

}  // namespace hinge::robotics
