// SPDX-License-Identifier: BSD-3-Clause
// Expressions of words joined by ',', '+', or, and, not and parentheses, as every selection on a command line is.
#pragma once

#include <functional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace hinge::molecular {

/// A word and the expression it stands in; `text` points into `expression`.
struct SelectionWord {
  std::string_view text;
  std::string_view expression;
  bool alternative = false;  ///< it stands right behind ',', '+' or `or`
};

/// ModelError that names the expression, the word, where it stands, and what was expected.
[[noreturn]] void refuse(const SelectionWord& word, const std::string& expected);

/// What the words of an expression select, each from the same elements.
struct SelectionWords {
  /// Does `next`, which follows `word` behind a comma, belong to `word`, as psi does in A:1-5:phi,psi?
  std::function<bool(std::string_view word, std::string_view next)> binds;
  /// Per element: is it selected by `word` and the words that belong to it? ModelError: not a word.
  std::function<std::vector<bool>(const SelectionWord& word, std::span<const SelectionWord> bound)> select;
};

/// The words that an object's members binds() and select() know; the object must outlive the result.
template <class Words>
SelectionWords words_of(Words& words) {
  return {
      [&words](std::string_view word, std::string_view next) { return words.binds(word, next); },
      [&words](const SelectionWord& word, std::span<const SelectionWord> bound) { return words.select(word, bound); }};
}

/// One of the alternatives that ',', '+' or `or` join outside of parentheses.
struct SelectionTerm {
  std::string_view text;
  std::vector<bool> selected;  ///< per element
};

/// From the loosest: ',' '+' or; and; not; parentheses. Blanks separate words. ModelError: an expression of another
/// form, more than 100 levels deep, or with something that is no word.
std::vector<SelectionTerm> read_terms(std::string_view expression, const SelectionWords& words);

}  // namespace hinge::molecular
