// SPDX-License-Identifier: BSD-3-Clause
// Implements the text around the rows.
#include "results.hpp"

#include <string_view>
#include <utility>

#include "hinge_tools/json_text.hpp"

namespace biocd {

using hinge::tool::json_text;

hinge::tool::RowsHead head_of_rows(const Options& options, const Json& head, const std::string& columns,
                                   std::uint64_t total) {
  std::string text;
  if (options.output == Output::json) text = json_text(head, 1);
  if (options.output == Output::csv) text = csv_header(options, columns);
  return {options.output, std::move(text), "conformations", total};
}

std::string row_text(const Json& row, const std::string& pairs) {
  std::string text = json_text(row);
  // `pairs` follows a number and a Boolean, so its first occurrence is the member.
  constexpr std::string_view placeholder = "\"pairs\":null";
  const std::size_t at = pairs.empty() ? std::string::npos : text.find(placeholder);
  if (at != std::string::npos) text.replace(at + placeholder.size() - 4, 4, pairs);
  return text;
}

void print_summary(const Options& options, Json summary, const std::string& error) {
  if (options.output != Output::json) return;
  if (!error.empty()) summary["error"] = error;
  hinge::tool::print(closing(options.output, json_text(summary)));
}

hinge::tool::Question question_of(const Options& options, const char* command, const hinge::tool::RowsHead& head,
                                  const Json& model) {
  return hinge::tool::make_question("biocd", command, options.parts, head, model,
                                    hinge::tool::input_digests(input_files(options)));
}

hinge::tool::UnitCounts counts_of(const Options& options, const Summary& summary, const Json& all) {
  return {summary.checked(), summary.colliding(), summary.starts() ? summary.starts()->missing : 0,
          options.output == Output::json ? json_text(all) : "{}"};
}

}  // namespace biocd
