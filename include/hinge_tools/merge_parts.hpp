// SPDX-License-Identifier: BSD-3-Clause
// merge_parts: prints the output of the whole run from the files of its units.
#pragma once

#include <algorithm>
#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <string>
#include <string_view>
#include <system_error>
#include <utility>
#include <vector>

#include "hinge/core/error.hpp"
#include "hinge_tools/check_output.hpp"
#include "hinge_tools/complete_file.hpp"
#include "hinge_tools/counted.hpp"
#include "hinge_tools/digest.hpp"
#include "hinge_tools/json_text.hpp"
#include "hinge_tools/parts_folder.hpp"
#include "hinge_tools/rows.hpp"
#include "hinge_tools/unit_file.hpp"

namespace hinge::tool {

namespace merge {

/// Returns numbers as text such as "3, 7-9".
inline std::string ranges_text(const std::vector<std::uint64_t>& numbers) {
  std::string text;
  constexpr std::size_t most = 20;  // ranges; a longer list is not read
  std::size_t ranges = 0;
  for (std::size_t k = 0; k < numbers.size(); ++ranges) {
    if (ranges == most) return text + ", ...";
    std::size_t last = k;
    while (last + 1 < numbers.size() && numbers[last + 1] == numbers[last] + 1) ++last;
    text += (text.empty() ? "" : ", ") + std::to_string(numbers[k]);
    if (last > k) text += '-' + std::to_string(numbers[last]);
    k = last + 1;
  }
  return text;
}

}  // namespace merge

/// Reads the question of a folder. head: receives what stands in front of the rows. Throws LoadError if the file is
/// damaged, or of another tool.
template <class Json>
Question read_question(const PartsFolder& folder, const std::string& tool, RowsHead& head) {
  std::string text = folder.read_question();
  const std::string file = folder.question_file().string();
  const Json json = Json::parse(text, nullptr, false);
  try {
    if (json.at("tool") != tool)
      throw LoadError(file + ": is a question to " + json.at("tool").template get<std::string>() +
                      ", expected one to " + tool);
    const auto format = std::ranges::find(output_words, json.at("format").template get<std::string>());
    head.output = static_cast<Output>(format - output_words.begin());
    head.text = json.at("head");
    head.json_key = json.at("head_key");
    head.total = json.at("total");
    std::string digest = sha256_of_text(text);
    Question question{std::move(text), head.total, json.at("unit"), std::move(digest), {}};
    if (question.unit > 0 && format != output_words.end()) return question;
  } catch (const typename Json::exception&) {
  }
  throw LoadError(file + ": is damaged");
}

/// Writes the whole run to `out`, or prints it if the path is empty. add(row) takes the rows of JSON output;
/// add_unit(counts, summary) takes every unit; summary() -> Json returns the summary of the whole. Nothing is printed
/// unless all units are there and whole; throws LoadError otherwise.
template <class Json, class Add, class AddUnit, class Summary>
void merge_parts(const std::string& path, const std::string& out, const std::string& tool, const Add& add,
                 const AddUnit& add_unit, const Summary& summary) {
  const PartsFolder folder(path);
  RowsHead head;
  const Question question = read_question<Json>(folder, tool, head);
  const std::string extension = std::string(".") + word_of(head.output);
  if (!out.empty() && std::filesystem::path(out).extension() != extension)
    throw ModelError("--out " + out + ": expected a file name with " + extension + ", the format of the run");
  check_output("--out", out, {folder.question_file()});
  std::vector<std::uint64_t> missing;
  std::error_code error;
  for (std::uint64_t k = 0; k < question.units(); ++k)
    if (!std::filesystem::exists(folder.unit_file(k), error)) missing.push_back(k);
  if (!missing.empty())
    throw LoadError(path + ": " + counted(missing.size(), "unit") + " of " + std::to_string(question.units()) +
                    (missing.size() == 1 ? " is" : " are") + " missing: " + merge::ranges_text(missing));
  std::vector<UnitReader> units;
  for (std::uint64_t k = 0; k < question.units(); ++k) {
    const UnitReader& unit = units.emplace_back(folder.unit_file(k), question.at(k));
    try {
      if (head.output == Output::json) unit.for_lines([&](const std::string& row) { add(Json::parse(row)); });
      add_unit(unit.counts(), Json::parse(unit.counts().summary));
    } catch (const typename Json::exception&) {
      throw LoadError(folder.unit_file(k).string() + ": is damaged: its rows cannot be read");
    }
  }
  CompleteFile file(out);
  const auto write = [&](std::string_view text) {
    if (!file.wanted()) return print(text);
    file.stream().write(text.data(), static_cast<std::streamsize>(text.size()));
    file.check();
  };
  write(opening(head));
  Rows rows(write, true);
  for (const UnitReader& unit : units) {
    if (head.output == Output::json)
      unit.for_lines([&](const std::string& row) { rows.add_json(row); });
    else
      unit.for_rows(write);
  }
  write(closing(head.output, head.output == Output::json ? json_text(summary()) : ""));
  file.finish();
  if (const std::size_t count = folder.left_over(); count > 0)
    std::fprintf(stderr, "note: %s: %s of killed processes may be deleted\n", path.c_str(),
                 counted(count, "file *.partial", "files *.partial").c_str());
}

}  // namespace hinge::tool
