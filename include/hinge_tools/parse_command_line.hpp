// SPDX-License-Identifier: BSD-3-Clause
// parse_command_line: parses the arguments of a tool with commands, and explains what is wrong with them.
#pragma once

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstddef>
#include <cstdio>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "hinge/core/error.hpp"
#include "hinge_tools/completion.hpp"
#include "hinge_tools/help_formatter.hpp"
#include "hinge_tools/help_texts.hpp"
#include "hinge_tools/man_page.hpp"
#include "hinge_tools/nearest_word.hpp"
#include "hinge_tools/option_text.hpp"
#include "hinge_tools/run_tool.hpp"
#include "hinge_tools/settings_file.hpp"

namespace hinge::tool {

/// Gives the tool its help texts and the options --version, --man and --completion. Call this before commands are
/// added.
inline void add_general_options(CLI::App& tool, const HelpTexts& texts, const std::string& version) {
  tool.formatter(std::make_shared<HelpFormatter>(texts));
  tool.set_help_flag("-h,--help", "print this help");
  tool.set_version_flag("--version", version, "print the version and the instruction set");
  tool.add_flag_callback(
      "--man", [] {}, "print the manual page as roff text, for man");
  tool.add_option_function<std::string>(
          "--completion", [](const std::string&) {}, "print the completion script of a shell")
      ->type_name("bash|zsh|fish");
  tool.require_subcommand(1);
}

namespace command_line {

inline std::vector<std::string> names(const CLI::App& tool) {
  std::vector<std::string> all;
  for (const CLI::App* command : commands_of(tool)) all.push_back(command->get_name());
  return all;
}

inline std::vector<std::string> option_names_of(const CLI::App& command) {
  std::vector<std::string> all;
  for (const CLI::Option* option : completion::options_of(command))
    for (const std::string& name : completion::names_of(*option)) all.push_back(name);
  return all;
}

[[noreturn]] inline void refuse_command(const CLI::App& tool, const std::string& word) {
  const std::string near = nearest_word(word, names(tool));
  throw ModelError(
      "unknown command '" + word + "'; " +
      (near.empty() ? "expected " + completion::joined(names(tool), ", ") + "." : "did you mean '" + near + "'?") +
      " See '" + tool.get_name() + " --help'");
}

/// Returns the message of the parser: "--free: expected SELECTION after it" for "--free: 1 required SELECTION missing".
inline std::string reason(const CLI::ParseError& error) {
  std::string text = error.what();
  const std::size_t colon = text.find(": "), required = text.find(" required ");
  if (colon == std::string::npos || required == std::string::npos || !text.ends_with(" missing")) return text;
  const std::size_t from = required + std::string_view(" required ").size();
  const std::string what = text.substr(from, text.size() - std::string_view(" missing").size() - from);
  return text.substr(0, colon) + ": expected " + what + " after it";
}

/// Explains an argument that is no option or argument of the parsed command.
[[noreturn]] inline void refuse_argument(const CLI::App& tool, const CLI::App& command, std::string word) {
  const std::string full = &tool == &command ? tool.get_name() : tool.get_name() + " " + command.get_name();
  if (!word.starts_with('-') || word.size() == 1)
    throw ModelError("unexpected argument '" + word + "'; see '" + full + " --help'");
  if (word.starts_with("--")) word = word.substr(0, word.find('='));
  const std::vector<std::string> known = option_names_of(command);
  if (std::ranges::find(known, word) != known.end())
    throw ModelError("option '" + word + "' is in front of the command, expected it after '" + full + "'");
  const std::string near = word.starts_with("--") ? nearest_word(word, known) : "";  // one letter is near any other
  throw ModelError("unknown option '" + word + "' of '" + full + "'" +
                   (near.empty() ? "." : "; did you mean '" + near + "'?") + " See '" + full + " --help'");
}

inline bool knows(const CLI::App& command, const std::string& name) {
  const std::vector<std::string> known = option_names_of(command);
  return std::ranges::find(known, name) != known.end();
}

/// Returns the arguments with the options of the files of --settings behind them. An option that only other commands of
/// the tool have is left out with a note. Throws LoadError for an option that no command has, ModelError for one that
/// the arguments give, too.
inline std::vector<std::string> with_settings(const CLI::App& tool, const CLI::App& command,
                                              std::vector<std::string> arguments) {
  constexpr std::string_view option = "--settings";
  if (!knows(command, std::string(option))) return arguments;
  const auto name_of = [](const std::string& argument) { return argument.substr(0, argument.find('=')); };
  const std::vector<std::string> given = arguments;
  for (std::size_t k = 0; k < given.size(); ++k) {
    if (name_of(given[k]) != option || (given[k] == option && k + 1 == given.size())) continue;
    const std::string file = given[k] == option ? given[k + 1] : given[k].substr(option.size() + 1);
    for (const SettingsLine& line : read_settings(file)) {
      const std::string &name = line.words[0], where = file + ":" + std::to_string(line.line);
      if (!knows(command, name)) {
        const auto commands = commands_of(tool);
        if (std::ranges::none_of(commands, [&](const CLI::App* other) { return knows(*other, name); }))
          throw LoadError(where + ": unknown option '" + name + "' of '" + tool.get_name() + "'");
        std::fprintf(stderr, "note: %s: '%s %s' has no option %s, so it is left out\n", where.c_str(),
                     tool.get_name().c_str(), command.get_name().c_str(), name.c_str());
        continue;
      }
      if (std::ranges::any_of(given, [&](const std::string& argument) { return name_of(argument) == name; }))
        throw ModelError(name + " is given on the command line and in " + where + ", expected one of the two");
      arguments.insert(arguments.end(), line.words.begin(), line.words.end());
    }
  }
  return arguments;
}

}  // namespace command_line

/// Parses the arguments (without the name of the program) for a tool that add_general_options() prepared. Returns
/// nothing if a command is to run, otherwise the exit status: a text was asked for and printed, or there was no
/// argument, and the usage was printed on standard error. Throws ModelError for arguments that do not fit.
inline std::optional<Exit> parse_command_line(CLI::App& tool, std::vector<std::string> arguments,
                                              const HelpTexts& texts) {
  const std::string name = tool.get_name();
  if (arguments.empty()) {
    std::string usage = "Usage: " + usage_of(tool, name) + "\n\n";
    for (const CLI::App* command : commands_of(tool))
      usage += help_row(command->get_name(), command->get_description(), 12);
    usage += "\n'" + name + " COMMAND --help' lists the options of a command.\n";
    std::fputs(usage.c_str(), stderr);
    return Exit::usage;
  }
  const auto print = [](const std::string& text) {
    std::fwrite(text.data(), 1, text.size(), stdout);
    return Exit::free;
  };
  if (arguments[0] == "help") {
    arguments.erase(arguments.begin());
    arguments.push_back("--help");
  }
  if (arguments[0] == "--man") return print(man_page(tool, texts));
  if (arguments[0] == "--completion" || arguments[0].starts_with("--completion=")) {
    const std::string shell = arguments[0].size() > 12 ? arguments[0].substr(13)
                              : arguments.size() > 1   ? arguments[1]
                                                       : "";
    const std::string script = completion_script(tool, shell);
    if (script.empty()) throw ModelError("--completion '" + shell + "': expected bash, zsh or fish");
    return print(script);
  }
  const auto word = std::ranges::find_if(arguments, [](const std::string& a) { return !a.starts_with('-'); });
  const std::vector<std::string> known = command_line::names(tool);
  if (word != arguments.end() && std::ranges::find(known, *word) == known.end())
    command_line::refuse_command(tool, *word);
  if (word != arguments.end()) arguments = command_line::with_settings(tool, *tool.get_subcommand(*word), arguments);
  try {
    std::ranges::reverse(arguments);  // the parser takes them in reverse order
    tool.parse(std::move(arguments));
  } catch (const CLI::ParseError& error) {
    if (error.get_exit_code() == 0) return tool.exit(error) == 0 ? Exit::free : Exit::usage;  // --help, --version
    const auto parsed = tool.get_subcommands();
    const CLI::App& command = parsed.empty() ? tool : *parsed.front();
    // An unknown option is often the reason for another error: its value becomes an argument, a required one is
    // missing.
    const std::vector<std::string> rest = tool.remaining(true);
    const auto option = std::ranges::find_if(rest, [](const std::string& a) { return a.starts_with('-'); });
    if (option != rest.end()) command_line::refuse_argument(tool, command, *option);
    if (!rest.empty()) command_line::refuse_argument(tool, command, rest.front());
    throw ModelError(command_line::reason(error) + "; see '" + name + (parsed.empty() ? "" : " " + command.get_name()) +
                     " --help'");
  }
  return std::nullopt;
}

}  // namespace hinge::tool
