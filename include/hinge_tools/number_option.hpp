// SPDX-License-Identifier: BSD-3-Clause
// Numbers on the command line: whole as typed, in decimal, finite and within a range, or refused.
#pragma once

#include <charconv>
#include <concepts>
#include <string>
#include <string_view>
#include <system_error>

#include "hinge/core/error.hpp"
#include "hinge/core/finite.hpp"
#include "hinge/core/number_text.hpp"

namespace hinge::tool {

/// Larger lengths and angles have no digits left behind the point, and their squares soon overflow.
inline constexpr double largest_value = 1e15;  // m, rad, angstrom, degrees
/// Of margins, clearances and widths.
inline constexpr double largest_length = 1e9;

/// least <= x <= most, or least < x <= most.
template <class Number>
struct NumberRange {
  Number least, most;
  bool above_least = false;

  bool holds(Number x) const { return (above_least ? x > least : x >= least) && x <= most; }  // NaN: no
  std::string text() const {
    return (above_least ? "above " + number_text(least) + ", at most " : "from " + number_text(least) + " to ") +
           number_text(most);
  }
};

/// option: such as "--seed". ModelError naming it and the text: no decimal number, or out of range. Whole numbers have
/// neither a point nor an exponent.
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

/// An option of a CLI11 command that is such a number. CLI11's own conversion takes -1 for an unsigned number, nan and
/// infinity for a positive one, and 010 for 8. Returns the option. names: as CLI11 takes them; the last one is the long
/// one.
template <class Command, class Number, class Value>
auto* add_number(Command& command, const std::string& names, Value& value, const NumberRange<Number>& range,
                 const std::string& help) {
  const std::size_t comma = names.rfind(',');
  const std::string option = comma == std::string::npos ? names : names.substr(comma + 1);
  auto* const added = command.template add_option_function<std::string>(
      names, [option, range, &value](const std::string& text) { value = read_number<Number>(option, text, range); },
      help);
  added->type_name(std::integral<Number> ? "INT" : "FLOAT");
  if constexpr (std::same_as<Value, Number>) added->default_str(number_text(value));
  return added;
}

}  // namespace hinge::tool
