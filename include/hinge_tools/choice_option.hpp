// SPDX-License-Identifier: BSD-3-Clause
// add_choice: an option with fixed values.
#pragma once

#include <algorithm>
#include <cstddef>
#include <string>
#include <utility>
#include <vector>

#include "hinge/core/error.hpp"
#include "hinge_tools/nearest_word.hpp"

namespace hinge::tool {

/// Returns "a, b or c".
inline std::string alternatives(const std::vector<std::string>& words) {
  std::string text;
  for (std::size_t k = 0; k < words.size(); ++k)
    text += (k == 0 ? "" : k + 1 == words.size() ? " or " : ", ") + words[k];
  return text;
}

/// Adds an option whose value is one of `words` to a CLI11 command, and returns the option. set(word) is called with
/// the value. Parsing throws ModelError with the option, the text and the words for another value.
template <class Command, class Set>
auto* add_choice(Command& command, const std::string& name, const std::vector<std::string>& words, Set set,
                 const std::string& help) {
  auto* const added = command.template add_option_function<std::string>(
      name,
      [name, words, set = std::move(set)](const std::string& text) {
        if (std::ranges::find(words, text) == words.end()) {
          const std::string near = nearest_word(text, words);
          throw ModelError(name + " '" + text + "': expected " + alternatives(words) +
                           (near.empty() ? "" : "; did you mean '" + near + "'?"));
        }
        set(text);
      },
      help);
  std::string type;
  for (const std::string& word : words) type += (type.empty() ? "" : "|") + word;
  added->type_name(type);
  return added;
}

}  // namespace hinge::tool
