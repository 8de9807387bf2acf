// SPDX-License-Identifier: BSD-3-Clause
// Selection expressions: words joined by ',', '+', or, and, not and parentheses, for all selections on a command line.
#pragma once

#include <functional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace hinge::molecular {

/// A word and its expression; `text` points into `expression`, which must outlive it.
struct SelectionWord {
  std::string_view text;
  std::string_view expression;
  bool alternative = false;  ///< follows ',', '+' or `or` directly
};

/// Throws ModelError with the expression, the word, its position, and what was expected.
[[noreturn]] void refuse(const SelectionWord& word, const std::string& expected);

/// The meaning of words: each selects some of the same elements.
struct SelectionWords {
  /// True if `next`, after `word` and a comma, belongs to `word`, as psi does in A:1-5:phi,psi.
  std::function<bool(std::string_view word, std::string_view next)> binds;
  /// Returns one value per element: true if `word` with the words that belong to it selects it. Throws ModelError if it
  /// is not a word.
  std::function<std::vector<bool>(const SelectionWord& word, std::span<const SelectionWord> bound)> select;
};

/// Wraps an object's members binds() and select(); the object must outlive the result.
template <class Words>
SelectionWords words_of(Words& words) {
  return {
      [&words](std::string_view word, std::string_view next) { return words.binds(word, next); },
      [&words](const SelectionWord& word, std::span<const SelectionWord> bound) { return words.select(word, bound); }};
}

/// One of the alternatives that ',', '+' or `or` join outside parentheses.
struct SelectionTerm {
  std::string_view text;
  std::vector<bool> selected;  ///< one value per element
};

/// Returns the alternatives of an expression. Operators from the loosest: ',' '+' or; and; not; parentheses. Blanks
/// separate words. Throws ModelError for another form, more than 100 nested parentheses, or an unknown word.
std::vector<SelectionTerm> read_terms(std::string_view expression, const SelectionWords& words);

}  // namespace hinge::molecular
