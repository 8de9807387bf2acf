// SPDX-License-Identifier: BSD-3-Clause
// wrap_text: breaks text into lines of limited width.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace hinge::tool {

/// Columns of help texts.
inline constexpr std::size_t help_width = 100;

/// Returns the words of `text`, separated by single blanks or by line ends, so that no line is wider than `width`
/// columns unless one word is. Lines after the first start with `indent` blanks; `column` is where the first one
/// starts. The text has no line end at its end.
inline std::string wrap_text(std::string_view text, std::size_t column, std::size_t indent,
                             std::size_t width = help_width) {
  std::string lines;
  bool first = true;
  while (!text.empty()) {
    const std::size_t end = text.find(' ');
    const std::string_view word = text.substr(0, end);
    text = end == std::string_view::npos ? std::string_view() : text.substr(end + 1);
    if (word.empty()) continue;
    if (!first && column + 1 + word.size() > width) {
      lines += '\n' + std::string(indent, ' ');
      column = indent;
    } else if (!first) {
      lines += ' ';
      ++column;
    }
    lines += word;
    column += word.size();
    first = false;
  }
  return lines;
}

}  // namespace hinge::tool
