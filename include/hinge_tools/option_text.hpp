// SPDX-License-Identifier: BSD-3-Clause
// Texts about the options of a CLI11 command, for help, manual pages and completion.
#pragma once

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cctype>
#include <iterator>
#include <string>
#include <utility>
#include <vector>

#include "hinge_tools/help_texts.hpp"

namespace hinge::tool {

/// Options of one group of a command.
struct TitledOptions {
  std::string title;
  std::vector<const CLI::Option*> options;
};

/// Returns all options and arguments of a command, also those in CLI11's option groups, by title. Titles keep the order
/// of `titles`; further titles come first. CLI11's own options, such as --help, have the last title.
inline std::vector<TitledOptions> titled_options(const CLI::App& command) {
  std::vector<TitledOptions> groups;
  const auto add = [&](const CLI::App& from) {
    for (const CLI::Option* option : from.get_options()) {
      const std::string title = option->get_group() == "Options" ? title::general : option->get_group();
      const bool of_group = &from != &command && option == from.get_help_ptr();  // each group has its own --help
      if (title.empty() || of_group) continue;                                   // options without a title are hidden
      auto group = std::ranges::find(groups, title, &TitledOptions::title);
      if (group == groups.end()) group = groups.insert(groups.end(), {title, {}});
      group->options.push_back(option);
    }
  };
  add(command);
  for (const CLI::App* inner : command.get_subcommands({}))
    if (inner->get_name().empty()) add(*inner);
  std::ranges::stable_sort(groups, {}, [](const TitledOptions& group) {
    const auto found = std::ranges::find(titles, group.title);
    return found == std::end(titles) ? -1 : static_cast<int>(found - std::begin(titles));
  });
  return groups;
}

/// Returns the commands of a tool in the order of definition.
inline std::vector<const CLI::App*> commands_of(const CLI::App& tool) {
  std::vector<const CLI::App*> commands = tool.get_subcommands({});
  std::erase_if(commands, [](const CLI::App* command) { return command->get_name().empty(); });
  return commands;
}

/// Returns true if the option takes no value.
inline bool is_flag(const CLI::Option& option) { return option.get_items_expected_max() == 0; }

/// Returns the word that stands for the value, such as FILE or auto|on|off; empty for flags and arguments.
inline std::string placeholder(const CLI::Option& option) {
  return is_flag(option) || option.get_positional() ? "" : option.get_type_name();
}

/// Returns the fixed values of an option: "within:" of any|within:D, nothing of FILE.
inline std::vector<std::string> choices(const CLI::Option& option) {
  std::vector<std::string> words;
  std::string text = placeholder(option);
  if (text.find('|') == std::string::npos) return words;
  text += '|';
  std::string word;
  for (const char c : text) {
    if (c == '|') {
      if (!word.empty()) words.push_back(std::exchange(word, {}));
    } else if (std::isupper(static_cast<unsigned char>(c)) == 0) {
      word += c;
    }
  }
  return words;
}

/// Returns true if the value is the name of a file or folder.
inline bool names_file(const CLI::Option& option) {
  const std::string what = option.get_positional() ? option.get_name(true, false) : placeholder(option);
  return what.starts_with("FILE") || what == "FOLDER" || what == "TRAJECTORY" || what == "URDF";
}

/// Returns the names of an option with its placeholder, such as "-n, --count N", or the name of an argument.
inline std::string option_names(const CLI::Option& option) {
  if (option.get_positional()) return option.get_name(true, false) + (option.get_items_expected_max() > 1 ? "..." : "");
  std::string names;
  for (const char c : option.get_name(false, true)) names += c == ',' ? std::string(", ") : std::string(1, c);
  const std::string value = placeholder(option);
  return value.empty() ? names : names + ' ' + value;
}

/// Returns the description with the default and the options that are required or excluded.
inline std::string option_description(const CLI::Option& option) {
  std::string text = option.get_description(), more;
  const auto add = [&](const std::string& what) { more += (more.empty() ? "" : "; ") + what; };
  if (!option.get_default_str().empty() && !is_flag(option)) add("default: " + option.get_default_str());
  if (option.get_required() && option.nonpositional()) add("required");
  for (const CLI::Option* other : option.get_needs()) add("needs " + other->get_name());
  for (const CLI::Option* other : option.get_excludes()) add("not with " + other->get_name());
  if (more.empty()) return text;
  const bool has_additions = text.ends_with(')') && text.substr(text.rfind('(')).starts_with("(default");
  if (!has_additions) return text + " (" + more + ")";
  text.pop_back();
  return text + "; " + more + ")";
}

/// Returns the line of usage without its title, such as "biocd check FILE [TRAJECTORY...] [options]".
inline std::string usage_of(const CLI::App& command, const std::string& names) {
  std::string usage = names;
  if (!commands_of(command).empty()) usage += " COMMAND";
  for (const CLI::Option* option : command.get_options())
    if (option->get_positional())
      usage += option->get_required() ? " " + option_names(*option) : " [" + option_names(*option) + "]";
  return usage + (commands_of(command).empty() ? " [options]" : " ...");
}

}  // namespace hinge::tool
