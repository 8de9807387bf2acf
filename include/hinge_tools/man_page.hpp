// SPDX-License-Identifier: BSD-3-Clause
// man_page: the manual page of a tool, made from its command line.
#pragma once

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cctype>
#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "hinge_tools/help_texts.hpp"
#include "hinge_tools/option_text.hpp"

namespace hinge::tool {

/// Returns text for roff: without requests, and with the characters that roff would replace.
inline std::string roff_text(std::string_view text) {
  std::string out;
  if (text.starts_with('.') || text.starts_with('\'')) out += "\\&";
  for (const char c : text) {
    switch (c) {
      case '\\': out += "\\e"; break;
      case '-': out += "\\-"; break;
      case '\'': out += "\\(aq"; break;
      case '`': out += "\\(ga"; break;
      case '^': out += "\\(ha"; break;
      case '~': out += "\\(ti"; break;
      default: out += c;
    }
  }
  return out;
}

namespace man {

/// An option as the page shows it. Entries are the same option if they differ only in the options that are excluded.
struct Entry {
  std::string title, name, names, text;  ///< names: all of them with the placeholder; text: without additions
  std::string description;
  bool operator==(const Entry& other) const {
    return title == other.title && names == other.names && text == other.text;
  }
};

inline std::vector<Entry> entries_of(const CLI::App& command) {
  std::vector<Entry> entries;
  for (const TitledOptions& group : titled_options(command))
    for (const CLI::Option* option : group.options)
      entries.push_back({group.title, option->get_name(option->get_positional(), false), option_names(*option),
                         option->get_description(), option_description(*option)});
  return entries;
}

/// Writes the entries below their titles.
inline std::string entries_text(const std::vector<Entry>& entries) {
  std::string text, title;
  for (const Entry& entry : entries) {
    if (entry.title != title) text += ".PP\n\\fI" + roff_text(entry.title) + "\\fR\n";
    title = entry.title;
    text += ".TP\n\\fB" + roff_text(entry.names) + "\\fR\n" + roff_text(entry.description) + "\n";
  }
  return text;
}

inline std::string upper(std::string text) {
  std::ranges::transform(text, text.begin(), [](unsigned char c) { return static_cast<char>(std::toupper(c)); });
  return text;
}

/// Returns the text with a capital at its start and a full stop at its end.
inline std::string sentence(std::string text) {
  if (!text.empty()) text[0] = static_cast<char>(std::toupper(static_cast<unsigned char>(text[0])));
  return text + ".";
}

/// Writes lines: those that start with a blank as they are, others as paragraphs.
inline std::string lines_text(const std::vector<std::string>& lines) {
  std::string text;
  bool is_table = false;
  for (const std::string& line : lines) {
    const bool in_table = line.starts_with(' ');
    if (in_table != is_table) text += in_table ? ".PP\n.EX\n" : ".EE\n.PP\n";
    is_table = in_table;
    text += roff_text(line) + "\n";
  }
  return is_table ? text + ".EE\n" : text;
}

}  // namespace man

/// Returns the manual page (section 1) of a tool as roff text for man(7). An option that several commands have in
/// common is described once.
inline std::string man_page(const CLI::App& tool, const HelpTexts& texts) {
  const std::string name = tool.get_name();
  const auto commands = commands_of(tool);
  std::vector<std::vector<man::Entry>> all{man::entries_of(tool)};
  for (const CLI::App* command : commands) all.push_back(man::entries_of(*command));
  std::vector<man::Entry> shared;
  for (const auto& entries : all)
    for (const man::Entry& entry : entries) {
      const auto users = std::ranges::count_if(all, [&](const auto& of) { return std::ranges::count(of, entry) > 0; });
      if (users > 1 && std::ranges::count(shared, entry) == 0) shared.push_back(entry);
    }
  std::ranges::stable_sort(shared, {}, [](const man::Entry& entry) {
    return std::ranges::find(titles, entry.title) - std::ranges::begin(titles);
  });

  std::string page = ".TH " + man::upper(name) + " 1 \"\" \"Hinge " + texts.version + "\" \"Hinge\"\n.nh\n.ad l\n";
  page += ".SH NAME\n" + roff_text(name) + " \\- " + roff_text(tool.get_description()) + "\n.SH SYNOPSIS\n";
  for (std::size_t k = 0; k < commands.size(); ++k)
    page += (k > 0 ? ".br\n\\fB" : "\\fB") + roff_text(usage_of(*commands[k], name + " " + commands[k]->get_name())) +
            "\\fR\n";
  page += ".SH DESCRIPTION\n" + roff_text(texts.description) + "\n.SH COMMANDS\n";
  for (std::size_t k = 0; k < commands.size(); ++k) {
    page += ".SS " + roff_text(commands[k]->get_name()) + "\n" +
            roff_text(man::sentence(commands[k]->get_description())) + "\n";
    std::vector<man::Entry> own = all[k + 1];
    std::string names;
    for (const man::Entry& entry : own) {
      if (std::ranges::count(shared, entry) == 0) continue;
      names += (names.empty() ? "" : ", ") + entry.name;
    }
    std::erase_if(own, [&](const man::Entry& entry) { return std::ranges::count(shared, entry) > 0; });
    page += man::entries_text(own);
    if (!names.empty()) page += ".PP\nShared options: " + roff_text(names) + ".\n";
  }
  page += ".SH SHARED OPTIONS\n" + man::entries_text(shared);
  page += ".SH GENERAL OPTIONS\n";
  std::erase_if(all[0], [&](const man::Entry& entry) { return std::ranges::count(shared, entry) > 0; });
  for (man::Entry& entry : all[0]) entry.title.clear();  // the section has it
  page += man::entries_text(all[0]);
  for (const Topic& topic : texts.topics)
    page += ".SH " + man::upper(topic.title) + "\n" + man::lines_text(topic.lines);
  page += ".SH EXAMPLES\nThese commands work in the folder of the source repository.\n";
  for (const CLI::App* command : commands) {
    page += ".PP\n.EX\n";
    for (const std::string& example : texts.of(command->get_name()).examples) page += roff_text(example) + "\n";
    page += ".EE\n";
  }
  return page;
}

}  // namespace hinge::tool
