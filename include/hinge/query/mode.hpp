// SPDX-License-Identifier: BSD-3-Clause
// Mode: a query mode chosen at run time, as the checkers of the modules take it and as users write it.
#pragma once

#include <cstdint>
#include <locale>
#include <sstream>
#include <string>
#include <string_view>

#include "hinge/core/error.hpp"
#include "hinge/core/finite.hpp"
#include "hinge/core/number_text.hpp"

namespace hinge {

/// A query mode with its margin.
struct Mode {
  /// any: is there a collision; all: all collisions; within: all pairs with d - M < margin; closest: the closest pair.
  enum class Kind : std::uint8_t { any, all, within, closest } kind = Kind::all;  ///< question
  double margin = 0.0;  ///< within: lists pairs with d - M below it, model length unit

  /// Parses "any", "all", "within:0.5" or "closest". Throws ModelError for other text; `unit` names the unit in the
  /// message.
  static Mode parse(std::string_view text, std::string_view unit = "model length unit");
  /// The text that parse() accepts for this mode.
  std::string text() const;
};

inline Mode Mode::parse(std::string_view text, std::string_view unit) {
  if (text == "any") return {Kind::any, 0.0};
  if (text == "all") return {Kind::all, 0.0};
  if (text == "closest") return {Kind::closest, 0.0};
  constexpr std::string_view within = "within:";
  if (text.starts_with(within)) {
    // libc++ 14 has no std::from_chars of doubles. Streams also read a sign, and some of them hexadecimal digits.
    const std::string number(text.substr(within.size()));
    const bool is_decimal =
        number.find_first_not_of("0123456789.eE+-") == std::string::npos && !number.starts_with('+');
    std::istringstream stream(number);
    stream.imbue(std::locale::classic());
    double margin = -1.0;
    if (is_decimal && stream >> margin && stream.peek() == std::char_traits<char>::eof() && is_finite(margin) &&
        margin >= 0.0)
      return {Kind::within, margin};
  }
  std::string what = "mode '";
  what.append(text).append("': expected any, all, within:D (").append(unit).append(", D >= 0) or closest");
  throw ModelError(what);
}

inline std::string Mode::text() const {
  switch (kind) {
    case Kind::any: return "any";
    case Kind::all: return "all";
    case Kind::closest: return "closest";
    case Kind::within: break;
  }
  return "within:" + number_text(margin);
}

}  // namespace hinge
