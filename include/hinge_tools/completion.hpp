// SPDX-License-Identifier: BSD-3-Clause
// completion_script: completion for bash, zsh and fish, made from the command line of a tool.
#pragma once

#include <CLI/CLI.hpp>
#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "hinge_tools/option_text.hpp"

namespace hinge::tool {

namespace completion {

/// Returns the options of a command without its arguments.
inline std::vector<const CLI::Option*> options_of(const CLI::App& command) {
  std::vector<const CLI::Option*> options;
  for (const TitledOptions& group : titled_options(command))
    for (const CLI::Option* option : group.options)
      if (!option->get_positional()) options.push_back(option);
  return options;
}

/// Returns the names of an option with their dashes: -n and --count.
inline std::vector<std::string> names_of(const CLI::Option& option) {
  std::vector<std::string> names;
  for (const std::string& name : option.get_snames()) names.push_back("-" + name);
  for (const std::string& name : option.get_lnames()) names.push_back("--" + name);
  return names;
}

inline std::string joined(const std::vector<std::string>& words, const std::string& separator) {
  std::string text;
  for (const std::string& word : words) text += (text.empty() ? "" : separator) + word;
  return text;
}

/// Returns the start of a description, without the characters that need quotes in one of the shells.
inline std::string summary(const std::string& description) {
  constexpr std::size_t most = 70;
  std::string text;
  for (const char c : description)
    if (std::string_view("'\"`$\\[]").find(c) == std::string_view::npos) text += c;
  if (text.size() <= most) return text;
  return text.substr(0, text.rfind(' ', most)) + " ...";
}

inline std::string command_names(const CLI::App& tool, const std::string& separator) {
  std::vector<std::string> names;
  for (const CLI::App* command : commands_of(tool)) names.push_back(command->get_name());
  return joined(names, separator);
}

inline std::string bash_case(const CLI::App& command) {
  std::string name = command.get_parent() == nullptr ? "" : command.get_name();
  std::string text, all, values, files;
  for (const CLI::Option* option : options_of(command)) {
    const std::vector<std::string> names = names_of(*option);
    all += (all.empty() ? "" : " ") + joined(names, " ");
    if (is_flag(*option)) continue;
    if (const auto words = choices(*option); !words.empty())
      text += "        " + joined(names, "|") + ") kind=words words='" + joined(words, " ") + "' ;;\n";
    else
      (names_file(*option) ? files : values) +=
          ((names_file(*option) ? files : values).empty() ? "" : "|") + joined(names, "|");
  }
  if (!files.empty()) text += "        " + files + ") kind=files ;;\n";
  if (!values.empty()) text += "        " + values + ") kind=value ;;\n";
  return "    '" + name + "')\n      options='" + all + "'\n      case $previous in\n" + text + "      esac ;;\n";
}

inline std::string bash(const CLI::App& tool) {
  const std::string name = tool.get_name();
  std::string text = "# Completion of " + name + " for bash: source this file.\n_" + name + "() {\n";
  text +=
      "  local current=${COMP_WORDS[COMP_CWORD]} previous=${COMP_WORDS[COMP_CWORD-1]}\n"
      "  local command= options= kind= words= word\n"
      "  if [[ $current == '=' ]]; then current=; elif [[ $previous == '=' ]]; then "
      "previous=${COMP_WORDS[COMP_CWORD-2]}; fi\n"
      "  for word in \"${COMP_WORDS[@]:1:COMP_CWORD-1}\"; do\n"
      "    case $word in " +
      command_names(tool, "|") +
      ") command=$word; break ;; esac\n"
      "  done\n"
      "  case $command in\n";
  text += bash_case(tool);
  for (const CLI::App* command : commands_of(tool)) text += bash_case(*command);
  text +=
      "  esac\n"
      "  if [[ -z $kind && $current == -* ]]; then kind=words words=$options; fi\n"
      "  if [[ -z $kind && -z $command ]]; then kind=words words='" +
      command_names(tool, " ") +
      "'; fi\n"
      "  COMPREPLY=()\n"
      "  case $kind in\n"
      "    words) mapfile -t COMPREPLY < <(compgen -W \"$words\" -- \"$current\") ;;\n"
      "    value) ;;\n"
      "    *) compopt -o filenames 2>/dev/null; mapfile -t COMPREPLY < <(compgen -f -- \"$current\") ;;\n"
      "  esac\n"
      "  if [[ ${#COMPREPLY[@]} -eq 1 && ${COMPREPLY[0]} == *: ]]; then compopt -o nospace 2>/dev/null; fi\n"
      "}\n";
  return text + "complete -F _" + name + " " + name + "\n";
}

inline std::string zsh_arguments(const CLI::App& command, const std::string& indent) {
  std::string text = "_arguments -s";
  for (const CLI::Option* option : options_of(command)) {
    std::string value;
    if (!is_flag(*option)) {
      const auto words = choices(*option);
      value = ":value:";
      if (!words.empty())
        value += "(" + joined(words, " ") + ")";
      else if (names_file(*option))
        value += "_files";
    }
    for (const std::string& name : names_of(*option))
      text += " \\\n" + indent + "'*" + name + "[" + summary(option->get_description()) + "]" + value + "'";
  }
  return text;
}

inline std::string zsh(const CLI::App& tool) {
  const std::string name = tool.get_name();
  std::string text = "#compdef " + name + "\n# Completion of " + name +
                     " for zsh: put this file into a folder of $fpath.\n_" + name +
                     "() {\n  local context state line\n  typeset -A opt_args\n  " + zsh_arguments(tool, "    ") +
                     " \\\n    '1:command:((";
  for (const CLI::App* command : commands_of(tool)) {
    text += command == commands_of(tool).front() ? "" : " ";
    std::string description = summary(command->get_description());
    std::erase(description, ':');
    text += command->get_name() + "\\:\"" + description + "\"";
  }
  text += "))' '*::argument:->arguments'\n  [[ $state == arguments ]] || return\n  case $line[1] in\n";
  for (const CLI::App* command : commands_of(tool))
    text += "    " + command->get_name() + ")\n      " + zsh_arguments(*command, "        ") +
            " \\\n        '*:file:_files' ;;\n";
  return text + "  esac\n}\n_" + name + " \"$@\"\n";
}

inline std::string fish(const CLI::App& tool) {
  const std::string name = tool.get_name(), start = "complete -c " + name;
  std::string text = "# Completion of " + name + " for fish: save it in ~/.config/fish/completions.\n";
  const auto add = [&](const CLI::App& command, const std::string& condition) {
    for (const CLI::Option* option : options_of(command)) {
      text += start + " -n '" + condition + "'";
      for (const std::string& letter : option->get_snames()) text += " -s " + letter;
      for (const std::string& word : option->get_lnames()) text += " -l " + word;
      if (const auto words = choices(*option); !words.empty())
        text += " -x -a '" + joined(words, " ") + "'";
      else if (!is_flag(*option))
        text += names_file(*option) ? " -r -F" : " -x";
      text += " -d '" + summary(option->get_description()) + "'\n";
    }
  };
  add(tool, "__fish_use_subcommand");
  for (const CLI::App* command : commands_of(tool)) {
    text += start + " -f -n __fish_use_subcommand -a " + command->get_name() + " -d '" +
            summary(command->get_description()) + "'\n";
    add(*command, "__fish_seen_subcommand_from " + command->get_name());
  }
  return text;
}

}  // namespace completion

/// The shells that completion_script() knows.
inline constexpr const char* shells[] = {"bash", "zsh", "fish"};

/// Returns a completion script of the tool: commands, options, fixed values and files. Empty for an unknown shell.
inline std::string completion_script(const CLI::App& tool, std::string_view shell) {
  if (shell == "bash") return completion::bash(tool);
  if (shell == "zsh") return completion::zsh(tool);
  if (shell == "fish") return completion::fish(tool);
  return {};
}

}  // namespace hinge::tool
