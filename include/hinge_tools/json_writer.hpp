// SPDX-License-Identifier: BSD-3-Clause
// JsonWriter: JSON with the bytes that nlohmann's dump() writes, for rows that are too many for a tree in memory.
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <charconv>
#include <cmath>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <nlohmann/json.hpp>
#include <string>
#include <string_view>

#include "hinge_tools/json_text.hpp"

namespace hinge::tool {

/// Returns a string in quotes, see json_text().
inline std::string json_string(std::string_view string) {
  const auto is_plain = [](char c) { return c >= ' ' && c < '\x7f' && c != '"' && c != '\\'; };
  if (std::all_of(string.begin(), string.end(), is_plain)) return '"' + std::string(string) + '"';
  return json_text(nlohmann::json(string));
}

/// Text that grows at its end.
class JsonWriter {
 public:
  /// expected: bytes that it can hold without growing.
  explicit JsonWriter(std::size_t expected = 0) { reserve(expected); }

  /// Appends text as it is.
  void put(std::string_view raw) {
    reserve(raw.size());
    std::memcpy(text_.data() + size_, raw.data(), raw.size());
    size_ += raw.size();
  }
  /// The same for a literal, whose length the compiler knows.
  template <std::size_t N>
  void put(const char (&literal)[N]) {
    reserve(N);
    std::memcpy(text_.data() + size_, literal, N);
    size_ += N - 1;
  }
  /// Appends a number; null if it is not finite.
  void number(double value) {
    if (!std::isfinite(value)) return put("null");
    reserve(longest_number);
    char* const first = text_.data() + size_;
    size_ += static_cast<std::size_t>(nlohmann::detail::to_chars(first, first + longest_number, value) - first);
  }
  /// The same for numbers of which few differ: their texts are kept.
  void repeated_number(double value) {
    const auto bits = std::bit_cast<std::uint64_t>(value);
    Known& known = known_[(bits * 0x9e3779b97f4a7c15U) >> 58U];
    if (known.length > 0 && known.bits == bits) return put({known.text.data(), known.length});
    const std::size_t start = size_;
    number(value);
    known.bits = bits;
    known.length = size_ - start;
    std::memcpy(known.text.data(), text_.data() + start, known.length);
  }
  /// Appends an integer.
  void number(std::integral auto value) {
    reserve(longest_number);
    char* const first = text_.data() + size_;
    size_ += static_cast<std::size_t>(std::to_chars(first, first + longest_number, value).ptr - first);
  }
  /// Returns the text and starts an empty one.
  std::string take() {
    std::string text = std::move(text_);
    text.resize(size_);
    text_.clear();
    size_ = 0;
    return text;
  }

 private:
  static constexpr std::size_t longest_number = 64;  // as in nlohmann's serializer
  struct Known {
    std::uint64_t bits = 0;
    std::size_t length = 0;
    std::array<char, longest_number> text;
  };

  void reserve(std::size_t more) {
    constexpr std::size_t least = 4096;
    if (text_.size() - size_ < more) text_.resize(std::max({2 * text_.size(), size_ + more, least}));
  }

  std::string text_;      // its end is not written yet
  std::size_t size_ = 0;  // of what is written
  std::array<Known, 64> known_;
};

}  // namespace hinge::tool
