// SPDX-License-Identifier: BSD-3-Clause
// Prints results to standard output, for a whole run or for one shard that `biocd merge` joins.
#pragma once

#include <cstdint>
#include <string>
#include <utility>

#include "options.hpp"
#include "report.hpp"

namespace biocd {

/// Reads a shard: "2/7" is the second of seven. Throws ModelError for another text, or for more than a million shards.
Shard parse_shard(const std::string& text);

/// Returns the conformations [first, second) of a shard. Lengths of shards differ by at most one.
std::pair<std::uint64_t, std::uint64_t> shard_range(const Shard& shard, std::uint64_t total);

/// Prints a run as JSON or CSV; commands print tables themselves. Every row starts with the conformation's index and is
/// a line of its own, so shards can be joined as text.
class Results {
 public:
  /// Prints the head. total: conformations of the whole run. columns: CSV columns after the columns of the rules.
  /// Throws ModelError for a shard of a table.
  Results(const Options& options, Json head, std::uint64_t total, const std::string& columns = "");

  /// Prints a JSON row. pairs: the JSON text of its member `pairs`; empty if it has none.
  void add(const Json& row, const std::string& pairs);
  /// Prints CSV rows, each with its line end.
  void add(const std::string& csv_rows);
  /// Prints the summary. error: why the run ended early, or empty.
  void finish(Json summary, const std::string& error = {});

 private:
  Output output_;
  bool sharded_;
  bool empty_ = true;
};

// Pieces of the output, for merging.
/// Prints the head and opens the list of rows.
void print_json_head(const Json& head);
/// Returns the text before a row.
const char* json_row_separator(bool is_first);
/// Closes the list of rows and prints the summary.
void print_json_end(const Json& summary);
/// Returns the first line of a CSV shard: its index, its range, and a digest of the question.
std::string csv_shard_line(const Shard& shard, std::uint64_t total, const Json& head);
/// Start of the last line of a complete CSV shard; the number of missing samples follows.
inline constexpr const char* csv_shard_end = "# complete, samples missing:";
/// Lines before and after the rows of JSON output.
inline constexpr const char* json_rows_begin = "\"conformations\": [";
inline constexpr const char* json_rows_end = "],";

}  // namespace biocd
