// SPDX-License-Identifier: BSD-3-Clause
// Settings files: options of a command line, one per line, that --settings FILE adds to the command line.
#pragma once

#include <cstddef>
#include <fstream>
#include <string>
#include <string_view>
#include <vector>

#include "hinge/core/error.hpp"
#include "hinge_tools/complete_file.hpp"
#include "hinge_tools/run_tool.hpp"

namespace hinge::tool {

/// An option of a settings file.
struct SettingsLine {
  std::size_t line = 0;            ///< from 1
  std::vector<std::string> words;  ///< the option and its values
};

/// Returns the words of a line, as a shell splits them: at blanks outside single quotes. Throws LoadError, naming
/// `where`, for a quote that is not closed.
inline std::vector<std::string> shell_words(std::string_view text, const std::string& where) {
  std::vector<std::string> words;
  bool open = false, in_word = false;
  for (std::size_t k = 0; k < text.size(); ++k) {
    const char c = text[k];
    const bool escaped = !open && c == '\\' && k + 1 < text.size();
    if (!open && (c == ' ' || c == '\t' || c == '\r')) {
      in_word = false;
      continue;
    }
    if (!in_word) words.emplace_back();
    in_word = true;
    if (c == '\'')
      open = !open;
    else
      words.back() += escaped ? text[++k] : c;
  }
  if (open) throw LoadError(where + ": a quote is not closed");
  return words;
}

/// Returns the word as one would type it in a shell.
inline std::string shell_quoted(std::string_view word) {
  constexpr std::string_view plain = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789_-+=./,:@%^";
  if (!word.empty() && word.find_first_not_of(plain) == std::string_view::npos) return std::string(word);
  std::string text = "'";
  for (const char c : word) text += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return text + '\'';
}

/// Reads a settings file. Empty lines and lines that start with # are left out. Throws LoadError, with file and line,
/// if the file cannot be read or a line does not start with an option of the form --name.
inline std::vector<SettingsLine> read_settings(const std::string& file) {
  std::ifstream in(file, std::ios::binary);
  if (!in) throw LoadError(file + ": cannot be read, expected a settings file");
  std::vector<SettingsLine> lines;
  std::string text;
  for (std::size_t line = 1; std::getline(in, text); ++line) {
    const std::string where = file + ":" + std::to_string(line);
    if (text.find('\0') != std::string::npos) throw LoadError(where + ": is not text, expected a settings file");
    if (text.starts_with('#')) continue;
    std::vector<std::string> words = shell_words(text, where);
    if (words.empty()) continue;
    if (!words[0].starts_with("--") || words[0].size() == 2)
      throw LoadError(where + ": '" + words[0] + "', expected an option such as --threads 2");
    if (words[0].find('=') != std::string::npos)
      throw LoadError(where + ": '" + words[0] + "', expected a blank between the option and its value");
    if (words[0] == "--settings") throw LoadError(where + ": --settings inside a settings file");
    lines.push_back({line, std::move(words)});
  }
  if (in.bad()) throw LoadError(file + ": cannot be read");
  return lines;
}

/// Writes a settings file and finishes it. commands: those that read it. command_line: the one that made it. lines: one
/// option with its values each. Throws LoadError if it cannot be written.
inline void write_settings(CompleteFile& file, const std::string& commands, const std::string& command_line,
                           const std::string& reason, const std::vector<std::string>& lines) {
  if (!file.wanted()) return;
  file.stream() << "# For --settings of " << commands << ".\n# Made by: " << one_line(command_line) << "\n# "
                << one_line(reason) << '\n';
  for (const std::string& line : lines) file.stream() << line << '\n';
  file.finish();
}

}  // namespace hinge::tool
