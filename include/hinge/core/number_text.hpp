// SPDX-License-Identifier: BSD-3-Clause
// number_text and fixed_text: numbers as text, for messages and files.
#pragma once

#include <array>
#include <charconv>
#include <string>

namespace hinge {

/// Returns the shortest decimal text that reads back as the same number, independent of the locale. At most 24
/// characters for a double (std::to_string writes 309 digits for 1e308).
template <class Number>
std::string number_text(Number number) {
  std::array<char, 32> text{};
  return {text.data(), std::to_chars(text.data(), text.data() + text.size(), number).ptr};
}

/// Returns the number with `digits` (0 to 15) digits after the decimal point, independent of the locale.
inline std::string fixed_text(double number, int digits) {
  std::array<char, 328> text{};  // sign, at most 309 digits, point, 15 digits
  return {text.data(),
          std::to_chars(text.data(), text.data() + text.size(), number, std::chars_format::fixed, digits).ptr};
}

}  // namespace hinge
