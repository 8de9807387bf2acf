// SPDX-License-Identifier: BSD-3-Clause
// Conformation by conformation on standard output, whole or in shards that `biocd merge` joins again.
#pragma once

#include <cstdint>
#include <string>
#include <utility>

#include "options.hpp"
#include "report.hpp"

namespace biocd {

/// "2/7": the second of seven shards. ModelError: anything else, or more than a million.
Shard parse_shard(const std::string& text);

/// Conformations [first, second) of a shard: runs of equal length, or one more.
std::pair<std::uint64_t, std::uint64_t> shard_range(const Shard& shard, std::uint64_t total);

/// What is printed of a run, as JSON or CSV; tables print for themselves. Every row starts with the conformation's
/// number and ends with a line end, so that text alone is enough to join shards.
class Results {
 public:
  /// Prints what stands before the first row. columns: of CSV, beyond those of the rules. ModelError: a shard of a
  /// table.
  Results(const Options& options, Json head, std::uint64_t total, const std::string& columns = "");

  void add(const Json& row);
  void add(const std::string& csv_rows);
  /// Prints what stands behind the last row; an error, where one ended the run early.
  void finish(Json summary, const std::string& error = {});

 private:
  Output output_;
  bool sharded_;
  bool empty_ = true;
};

// The parts, for merging.
void print_json_head(const Json& head);
/// Of rows: before each one.
const char* json_row_separator(bool is_first);
void print_json_end(const Json& summary);
/// A comment line that says which shard of what question a CSV file is, and one that says that it is whole, followed by
/// how many samples it lacks where that is a number of them.
std::string csv_shard_line(const Shard& shard, std::uint64_t total, const Json& head);
inline constexpr const char* csv_shard_end = "# complete, samples missing:";
inline constexpr const char* json_rows_begin = "\"conformations\": [";
inline constexpr const char* json_rows_end = "],";

}  // namespace biocd
