// SPDX-License-Identifier: BSD-3-Clause
// hybrid36: large numbers in few columns of a PDB file.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>

namespace hinge::molecular {

/// Returns the hybrid-36 text (Grosse-Kunstleve) of a number. With five columns: decimal up to 99999, then base 36:
/// A0000 ... ZZZZZ, a0000 ... zzzzz.
inline std::string hybrid36(std::size_t value, std::size_t width = 5) {
  std::size_t decimal = 1, block = 26, shift = 10;
  for (std::size_t k = 0; k < width; ++k) decimal *= 10;
  for (std::size_t k = 1; k < width; ++k) block *= 36, shift *= 36;
  if (value < decimal) return std::to_string(value);
  value -= decimal;
  const bool lower = value >= block;
  if (lower) value -= block;
  const char* digits = lower ? "0123456789abcdefghijklmnopqrstuvwxyz" : "0123456789ABCDEFGHIJKLMNOPQRSTUVWXYZ";
  value += shift;
  std::string text(width, '0');
  for (std::size_t k = width; k-- > 0; value /= 36) text[k] = digits[value % 36];
  return text;
}

/// Returns the number in such a field of five columns, with or without blanks around it; nullopt if it holds other
/// text.
inline std::optional<int> read_hybrid36(std::string_view field) {
  const std::size_t first = field.find_first_not_of(' ');
  if (first == std::string_view::npos) return std::nullopt;
  field = field.substr(first, field.find_last_not_of(" \r") - first + 1);
  const auto digit = [](char c) { return c >= '0' && c <= '9' ? c - '0' : -1; };
  const bool decimal = digit(field.front()) >= 0, lower = field.front() >= 'a' && field.front() <= 'z';
  if (!decimal && field.size() != 5) return std::nullopt;
  int value = 0;
  for (const char c : field) {
    int d = digit(c);
    if (!decimal && d < 0 && c >= (lower ? 'a' : 'A') && c <= (lower ? 'z' : 'Z')) d = c - (lower ? 'a' : 'A') + 10;
    if (d < 0) return std::nullopt;
    value = value * (decimal ? 10 : 36) + d;
  }
  if (decimal) return value;
  constexpr int to_fourth = 36 * 36 * 36 * 36;
  return value - 10 * to_fourth + 100'000 + (lower ? 26 * to_fourth : 0);
}

}  // namespace hinge::molecular
