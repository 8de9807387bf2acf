// SPDX-License-Identifier: BSD-3-Clause
// A recursive-descent parser that evaluates the expression while it reads.
#include "chemistry/selection_expression.hpp"

#include <algorithm>
#include <cstddef>
#include <utility>

#include "hinge/core/error.hpp"

namespace hinge::molecular {

namespace {

constexpr std::string_view blanks = " \t\r\n";
constexpr std::string_view signs = "(),+";

class Reader {
 public:
  Reader(std::string_view expression, const SelectionWords& words) : all_(expression), words_(words) { advance(); }

  std::vector<SelectionTerm> read() {
    std::vector<SelectionTerm> terms = alternatives();
    if (!token_.empty()) refuse(here(), "',', '+', 'and', 'or' or the end of the selection");
    return terms;
  }

 private:
  SelectionWord here() const { return {token_, all_, alternative_}; }
  bool is_sign() const { return !token_.empty() && signs.find(token_.front()) != std::string_view::npos; }
  bool is_comma() const { return token_ == "," || token_ == "+"; }
  bool joins() const { return is_comma() || token_ == "or"; }
  bool is_word() const { return !token_.empty() && !is_sign() && token_ != "and" && token_ != "or" && token_ != "not"; }

  /// Reads the next word or sign to token_; empty at the end.
  void advance() {
    const std::size_t begin = std::min(all_.find_first_not_of(blanks, next_), all_.size());
    std::size_t end = begin;
    if (begin < all_.size()) {
      end = signs.find(all_[begin]) != std::string_view::npos
                ? begin + 1
                : std::min(all_.find_first_of(std::string(signs).append(blanks), begin), all_.size());
    }
    alternative_ = joins();
    last_end_ = next_;
    next_ = end;
    token_ = all_.substr(begin, end - begin);
  }

  std::vector<SelectionTerm> alternatives() {
    std::vector<SelectionTerm> terms;
    while (true) {
      const std::size_t begin = next_ - token_.size();
      std::vector<bool> selected = conjunction();
      terms.push_back({all_.substr(begin, last_end_ - begin), std::move(selected)});
      if (!joins()) return terms;
      advance();
    }
  }

  std::vector<bool> conjunction() {
    std::vector<bool> selected = factor();
    while (token_ == "and") {
      advance();
      const std::vector<bool> other = factor();
      for (std::size_t k = 0; k < selected.size(); ++k) selected[k] = selected[k] && other[k];
    }
    return selected;
  }

  std::vector<bool> factor() {
    bool inverted = false;
    for (; token_ == "not"; advance()) inverted = !inverted;
    std::vector<bool> selected = token_ == "(" ? group() : word();
    if (inverted) selected.flip();
    return selected;
  }

  std::vector<bool> group() {
    if (++depth_ > 100) refuse(here(), "at most 100 nested parentheses");
    const SelectionWord opening = here();
    advance();
    std::vector<bool> selected;
    for (const SelectionTerm& term : alternatives()) {
      selected.resize(term.selected.size());
      for (std::size_t k = 0; k < selected.size(); ++k) selected[k] = selected[k] || term.selected[k];
    }
    if (token_ != ")") refuse(token_.empty() ? opening : here(), "')' for each '('");
    --depth_;
    advance();
    return selected;
  }

  std::vector<bool> word() {
    if (!is_word()) refuse(here(), "a selection word or '('");
    const SelectionWord word = here();
    advance();
    std::vector<SelectionWord> bound;
    while (is_comma()) {
      const std::string_view sign = token_;
      const std::size_t next = next_, last_end = last_end_;
      advance();
      if (!is_word() || !words_.binds(word.text, token_)) {
        token_ = sign;
        next_ = next;
        last_end_ = last_end;
        break;
      }
      bound.push_back(here());
      advance();
    }
    return words_.select(word, bound);
  }

  std::string_view all_;
  const SelectionWords& words_;
  std::string_view token_;
  std::size_t next_ = 0, last_end_ = 0;  // offsets after token_ and after the token before it
  bool alternative_ = false;             // token_ directly follows a sign that joins alternatives
  int depth_ = 0;
};

}  // namespace

void refuse(const SelectionWord& word, const std::string& expected) {
  std::string text = "selection '" + std::string(word.expression) + "'";
  if (word.text.empty() && !word.expression.empty())
    text += ", at its end";
  else if (word.text != word.expression)
    text += ", at character " + std::to_string(word.text.data() - word.expression.data() + 1) + " ('" +
            std::string(word.text) + "')";
  throw ModelError(text + ": expected " + expected);
}

std::vector<SelectionTerm> read_terms(std::string_view expression, const SelectionWords& words) {
  return Reader(expression, words).read();
}

}  // namespace hinge::molecular
