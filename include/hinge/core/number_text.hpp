// SPDX-License-Identifier: BSD-3-Clause
// Numbers as text, for messages and files.
#pragma once

#include <array>
#include <charconv>
#include <string>

namespace hinge {

/// In the shortest form that reads back the same, whatever the locale: at most 24 characters, where std::to_string
/// takes 309 digits for 1e308.
template <class Number>
std::string number_text(Number number) {
  std::array<char, 32> text{};
  return {text.data(), std::to_chars(text.data(), text.data() + text.size(), number).ptr};
}

}  // namespace hinge
