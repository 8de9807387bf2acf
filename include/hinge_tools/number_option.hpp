// SPDX-License-Identifier: BSD-3-Clause
// number_option: numbers on the command line: decimal, complete, finite and within a range.
#pragma once

#include <charconv>
#include <concepts>
#include <cstdint>
#include <string>
#include <string_view>
#include <system_error>

#include "hinge/core/error.hpp"
#include "hinge/core/finite.hpp"
#include "hinge/core/number_text.hpp"

namespace hinge::tool {

/// Upper limit of values. Larger lengths and angles have few digits after the point, and their squares may overflow.
inline constexpr double largest_value = 1e15;  // unit of the option: m, rad, angstrom, degrees
/// Upper limit of margins, clearances and widths, in the unit of the option.
inline constexpr double largest_length = 1e9;

/// The range least <= x <= most, or least < x <= most if above_least.
template <class Number>
struct NumberRange {
  Number least, most;        ///< both in the unit of the option
  bool above_least = false;  ///< `least` itself is excluded

  /// True if x is in the range; false for NaN.
  bool holds(Number x) const { return (above_least ? x > least : x >= least) && x <= most; }
  /// The range in words, for messages.
  std::string text() const {
    return (above_least ? "above " + number_text(least) + ", at most " : "from " + number_text(least) + " to ") +
           number_text(most);
  }
};

/// The range of a number of things, and of a seed.
inline constexpr NumberRange<std::uint64_t> count_range{1, std::uint64_t{1} << 53}, seed_range{0, UINT64_MAX};

/// option: for messages, for example "--seed". Throws ModelError with option and text if the text is not a decimal
/// number or is out of range. An integral Number takes neither a point nor an exponent.
template <class Number>
Number read_number(const std::string& option, std::string_view text, const NumberRange<Number>& range) {
  std::string_view digits = text;
  if (digits.size() > 1 && digits[0] == '+' && digits[1] != '-') digits.remove_prefix(1);
  Number number{};
  const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), number);
  if (error == std::errc{} && end == digits.data() + digits.size() && range.holds(number)) return number;
  throw ModelError(option + " '" + std::string(text) + "': expected a " + (std::integral<Number> ? "whole " : "") +
                   "number " + range.text());
}

/// Adds an option with such a number to a CLI11 command, and returns the option. It replaces CLI11's conversion, which
/// takes -1 for an unsigned number, nan and infinity for a positive number, and 010 for 8. names: as for CLI11; the
/// last name is the long one. `value` must stay valid until the command is parsed.
template <class Command, class Number, class Value>
auto* add_number(Command& command, const std::string& names, Value& value, const NumberRange<Number>& range,
                 const std::string& help) {
  const std::size_t comma = names.rfind(',');
  const std::string option = comma == std::string::npos ? names : names.substr(comma + 1);
  auto* const added = command.template add_option_function<std::string>(
      names, [option, range, &value](const std::string& text) { value = read_number<Number>(option, text, range); },
      help);
  added->type_name(std::integral<Number> ? "N" : "NUMBER");
  if constexpr (std::same_as<Value, Number>) added->default_str(number_text(value));
  return added;
}

}  // namespace hinge::tool
