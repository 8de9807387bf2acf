// SPDX-License-Identifier: BSD-3-Clause
// HelpFormatter: the text of --help, in groups with titles and lines of limited width.
#pragma once

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstddef>
#include <string>
#include <utility>

#include "hinge_tools/help_texts.hpp"
#include "hinge_tools/option_text.hpp"
#include "hinge_tools/wrap_text.hpp"

namespace hinge::tool {

/// Returns two columns: the name, and its description wrapped next to it or below a long name.
inline std::string help_row(const std::string& name, const std::string& description, std::size_t column) {
  std::string row = "  " + name;
  if (description.empty()) return row + "\n";
  if (row.size() + 2 > column)
    row += '\n' + std::string(column, ' ');
  else
    row.resize(column, ' ');
  return row + wrap_text(description, column, column) + "\n";
}

/// Formats help for the commands of a tool.
class HelpFormatter : public CLI::Formatter {
 public:
  explicit HelpFormatter(HelpTexts texts) : texts_(std::move(texts)) {}

  /// Returns the help of a command, or of the tool. name: the words in front of the arguments. The mode is not used:
  /// help is the same in every place.
  std::string make_help(const CLI::App* command, std::string name, CLI::AppFormatMode /*mode*/) const override {
    std::string text = wrap_text(name + ": " + command->get_description(), 0, 0);
    text += "\n\nUsage: " + usage_of(*command, name) + "\n";
    constexpr std::size_t column = 30, narrow = 12;
    const auto commands = commands_of(*command);
    if (!commands.empty()) text += "\nCommands:\n";
    for (const CLI::App* inner : commands) text += help_row(inner->get_name(), inner->get_description(), narrow);
    for (const TitledOptions& group : titled_options(*command)) {
      text += "\n" + group.title + ":\n";
      for (const CLI::Option* option : group.options)
        text += help_row(option_names(*option), option_description(*option), column);
    }
    const CommandTexts own = texts_.of(command->get_parent() == nullptr ? "" : command->get_name());
    for (const Topic& topic : texts_.topics) {
      if (std::ranges::find(own.topics, topic.title) == own.topics.end()) continue;
      text += "\n" + topic.title + ":\n";
      for (const std::string& line : topic.lines)
        text += (line.starts_with(' ') ? line : "  " + wrap_text(line, 2, 2)) + "\n";
    }
    if (!own.examples.empty()) text += "\nExamples:\n";
    for (const std::string& example : own.examples) text += "  " + example + "\n";
    return text;
  }

 private:
  HelpTexts texts_;
};

}  // namespace hinge::tool
