// SPDX-License-Identifier: BSD-3-Clause
// HelpTexts: the texts of a command line that CLI11 has no place for, and the titles of its groups of options.
#pragma once

#include <map>
#include <string>
#include <string_view>
#include <vector>

namespace hinge::tool {

/// Titles of groups of options. Help lists the groups in the order of `titles`.
namespace title {
inline constexpr const char* input = "Input";
inline constexpr const char* configurations = "Configurations (one of these)";
inline constexpr const char* ends = "The path";
inline constexpr const char* free = "What is free";
inline constexpr const char* molecules = "Several molecules";
inline constexpr const char* reading = "Reading";
inline constexpr const char* rules = "Rules";
inline constexpr const char* pairs = "Tested pairs";
inline constexpr const char* surroundings = "Bodies around the robot";
inline constexpr const char* question = "Question";
inline constexpr const char* sampling = "Sampling";
inline constexpr const char* moves = "Moves";
inline constexpr const char* proofs = "Samples and proofs";
inline constexpr const char* output = "Output";
inline constexpr const char* parts = "Parts of a long run";
inline constexpr const char* performance = "Performance";
inline constexpr const char* general = "General";
}  // namespace title

inline constexpr const char* titles[] = {
    title::input,    title::configurations, title::ends,   title::free,        title::molecules, title::question,
    title::sampling, title::moves,          title::proofs, title::rules,       title::pairs,     title::surroundings,
    title::reading,  title::output,         title::parts,  title::performance, title::general};

/// A text about several options or commands. Lines that start with a blank are printed as they are; other lines are
/// wrapped.
struct Topic {
  std::string title;
  std::vector<std::string> lines;
};

/// Texts of one command.
struct CommandTexts {
  std::vector<std::string> topics;    ///< titles, in the order of printing
  std::vector<std::string> examples;  ///< commands for a shell, in the folder of the repository
};

/// Texts of a tool.
struct HelpTexts {
  std::string description;                       ///< for the manual page; one paragraph
  std::vector<Topic> topics;                     ///< all of them, in the order of the manual page
  std::map<std::string, CommandTexts> commands;  ///< by name; "" for the tool without a command
  std::string version;                           ///< of the project

  /// Returns the texts of a command; empty ones for an unknown name.
  CommandTexts of(const std::string& command) const {
    const auto found = commands.find(command);
    return found == commands.end() ? CommandTexts{} : found->second;
  }
};

}  // namespace hinge::tool
