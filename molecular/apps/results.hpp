// SPDX-License-Identifier: BSD-3-Clause
// The text around the rows of check and sample, for a whole run or for a run in parts.
#pragma once

#include <cstdint>
#include <string>

#include "hinge_tools/parts_folder.hpp"
#include "hinge_tools/rows.hpp"
#include "options.hpp"
#include "report.hpp"
#include "summary.hpp"

namespace biocd {

/// Returns what stands in front of the rows. columns: CSV columns after the columns of the rules. total: conformations
/// of the whole run.
hinge::tool::RowsHead head_of_rows(const Options& options, const Json& head, const std::string& columns,
                                   std::uint64_t total);

/// Returns a JSON row. pairs: the JSON text of its member `pairs`; empty if it has none.
std::string row_text(const Json& row, const std::string& pairs);

/// Prints the summary of a whole run, if the output is JSON. error: why the run ended early, or empty.
void print_summary(const Options& options, Json summary, const std::string& error = {});

/// Returns the question that a folder of parts answers. command: its name. model: the head of JSON output.
hinge::tool::Question question_of(const Options& options, const char* command, const hinge::tool::RowsHead& head,
                                  const Json& model);

/// Returns the counts of a unit. all: its summary, which only JSON output needs.
hinge::tool::UnitCounts counts_of(const Options& options, const Summary& summary, const Json& all);

}  // namespace biocd
