// SPDX-License-Identifier: BSD-3-Clause
// Reads an end of a path: a state of the SRDF, a row of a CSV file, or a list.
#include "path_end.hpp"

#include <algorithm>
#include <charconv>
#include <cstddef>
#include <optional>
#include <system_error>
#include <utility>

#include "configurations.hpp"
#include "hinge/core/error.hpp"
#include "read_configurations.hpp"

namespace robocd {

namespace {

std::vector<double> read_row(const std::string& what, const std::string& text, Job& job) {
  const auto [file, row] = file_of_end(text);
  const auto rows = read_configurations(file, *job.robot, job.notes);
  if (row ? *row >= rows.size() : rows.size() > 1)
    throw hinge::ModelError(what + ": " + file + " has " + std::to_string(rows.size()) +
                            " rows, expected a row from @" + file + ":0 to @" + file + ":" +
                            std::to_string(rows.size() - 1));
  return rows[row.value_or(0)];
}

std::vector<std::string> split(std::string text) {
  std::vector<std::string> words;
  for (std::size_t comma = text.find(','); comma != std::string::npos; comma = text.find(',')) {
    words.push_back(text.substr(0, comma));
    text.erase(0, comma + 1);
  }
  words.push_back(text);
  return words;
}

}  // namespace

std::pair<std::string, std::optional<std::size_t>> file_of_end(const std::string& text) {
  std::string file = text.substr(1);  // without "@"
  const std::size_t colon = file.rfind(':');
  if (colon != std::string::npos) {
    std::size_t row = 0;
    const char *first = file.data() + colon + 1, *last = file.data() + file.size();
    const auto [end, error] = std::from_chars(first, last, row);
    if (error == std::errc{} && end == last) return {file.substr(0, colon), row};
  }
  return {std::move(file), std::nullopt};
}

std::vector<double> read_path_end(const char* option, const std::string& text, const Options& options, Job& job) {
  constexpr std::size_t prefix = 6;  // length of "state:"
  const std::string what = std::string(option) + " '" + text + "'";
  if (text == "zero") return std::vector<double>(job.robot->independent_joints().size(), 0.0);
  if (text.starts_with("state:")) return join_states(option, split(text.substr(prefix)), options, job);
  if (text.starts_with('@')) return read_row(what, text, job);
  return read_configuration(what, text, *job.robot);
}

}  // namespace robocd
