// SPDX-License-Identifier: BSD-3-Clause
// Words, lines and numbers of files, independent of locale and machine.
#pragma once

#include <algorithm>
#include <charconv>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string_view>
#include <system_error>
#include <vector>

namespace hinge::robotics {

/// Largest joint value that files may state, rad or m. Programs write larger ones where a joint has no limit.
inline constexpr double largest_joint_value = 1e15;

/// Removes the next word from the text and returns it, or "" at the end. Words are separated by blanks and line ends.
inline std::string_view next_word(std::string_view& text) noexcept {
  const auto is_blank = [](char c) { return c == ' ' || c == '\t' || c == '\r' || c == '\n'; };
  const auto start = std::find_if_not(text.begin(), text.end(), is_blank);
  const auto end = std::find_if(start, text.end(), is_blank);
  const std::string_view word(start, end);
  text = std::string_view(end, text.end());
  return word;
}

/// Removes the next line from the text and returns it, without \n or \r\n at its end.
inline std::string_view next_line(std::string_view& text) noexcept {
  const std::size_t end = std::min(text.find('\n'), text.size());
  std::string_view line = text.substr(0, end);
  text.remove_prefix(std::min(end + 1, text.size()));
  if (line.ends_with('\r')) line.remove_suffix(1);
  return line;
}

/// Returns the number that the whole word is, rounded to the nearest value, or nothing if it is none or out of range.
/// Number: double or an integer. "nan" and "inf" are numbers.
template <class Number>
std::optional<Number> parse_number(std::string_view word) {
  if (word.size() > 1 && word[0] == '+' && word[1] != '-') word.remove_prefix(1);
  Number value{};
  const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
  if (error != std::errc{} || end != word.data() + word.size()) return {};
  return value;
}

/// Returns the number that at most 8 bytes of a binary file make: the lowest byte comes first, or last if big_endian.
inline std::uint64_t load_bits(std::string_view bytes, bool big_endian = false) noexcept {
  std::uint64_t bits = 0;
  for (std::size_t k = 0; k < bytes.size(); ++k)
    bits |= std::uint64_t{static_cast<unsigned char>(bytes[big_endian ? bytes.size() - 1 - k : k])} << 8 * k;
  return bits;
}

/// Returns finite numbers separated by blanks, or nothing if the text contains anything else.
std::optional<std::vector<double>> parse_numbers(std::string_view text);

}  // namespace hinge::robotics
