// SPDX-License-Identifier: BSD-3-Clause
// biocd merge: joins the shards of one run to the exact output of the whole run.
#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <optional>
#include <string>
#include <string_view>
#include <system_error>
#include <utility>
#include <vector>

#include "clash_table.hpp"
#include "hinge/core/error.hpp"
#include "options.hpp"
#include "results.hpp"
#include "summary.hpp"

namespace biocd {

namespace {

using hinge::LoadError;

/// The output file of one shard, read line by line.
class ShardFile {
 public:
  explicit ShardFile(std::string path) : path_(std::move(path)) {}

  /// Opens the file and reads its head, up to the first row. Throws LoadError if it is no shard.
  void open() {
    std::error_code error;
    const auto status = std::filesystem::status(path_, error);
    if (std::filesystem::exists(status) && !std::filesystem::is_regular_file(status))
      refuse("is not a regular file, expected a file that can be read twice");
    stream_ = std::ifstream(path_);  // closed early: more shards than file descriptors are possible
    if (!stream_) throw LoadError(path_ + ": cannot be opened");
    if (!next()) refuse("is empty, expected the output of biocd --shard");
    if (line_.starts_with("# biocd shard "))
      open_csv();
    else
      open_json();
  }

  /// Opens the file and calls use(row, is_new) for each row; is_new: the first row of its conformation. Throws
  /// LoadError unless the rows are the conformations of the shard, in order and complete except for missing samples.
  template <class Use>
  void for_rows(const Use& use) {
    open();
    std::uint64_t expected = first, absent = 0;
    while (next() && !is_end()) {
      if (is_json && line_.ends_with(',')) line_.pop_back();
      const std::uint64_t index = row_index();
      const bool is_new = index >= expected;
      // CSV has one row per pair, so an index may repeat.
      if (is_new ? index >= first + count : is_json || expected == first || index + 1 != expected)
        refuse(fmt::format("has conformation {}, expected conformation {}", index, expected));
      if (is_new) {
        absent += index - expected;
        expected = index + 1;
      }
      use(line_, is_new);
    }
    const bool ended = is_end();
    missing = ended ? read_missing() : 0;
    if (!ended || absent + (first + count - expected) != missing)
      refuse(fmt::format("ends before conformation {}, expected {} conformations from {} on, of which {} are missing",
                         expected, count, first, missing));
    stream_.close();
  }
  void close() { stream_.close(); }

  const std::string& path() const { return path_; }
  std::string question;       ///< equal in all shards of a run
  std::uint64_t missing = 0;  ///< samples that the run could not find, after for_rows()
  std::string header;         ///< CSV only
  Json head;                  ///< JSON only, without the shard
  Json summary;               ///< JSON only
  bool is_json = false;
  Shard shard;
  std::uint64_t first = 0, count = 0, total = 0;

 private:
  [[noreturn]] void refuse(const std::string& what) const { throw LoadError(path_ + ": " + what); }
  bool next() {
    const bool got = static_cast<bool>(std::getline(stream_, line_));
    // A line without a line end is truncated: a complete file ends with a line end.
    return got && !stream_.eof();
  }

  void check_range() const {
    if (shard.index < 1 || shard.index > shard.of) refuse("its shard number is not one of 1 to n");
    const auto [begin, end] = shard_range(shard, total);
    if (first != begin || count != end - begin) refuse("its range of conformations does not fit its shard number");
  }

  bool is_end() const { return is_json ? line_ == json_rows_end : line_.starts_with(csv_shard_end); }
  /// Returns the number of samples that the run could not find.
  std::uint64_t read_missing() {
    if (is_json) {
      read_summary();
      return summary.value("missing", std::uint64_t{0});
    }
    const std::string_view text = std::string_view(line_).substr(std::string_view(csv_shard_end).size() + 1);
    std::uint64_t number = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
    if (error != std::errc{} || end != text.data() + text.size())
      refuse("its last line is damaged, expected the number of missing samples");
    return number;
  }

  void open_csv() {
    is_json = false;
    unsigned long long i = 0, n = 0, c = 0, f = 0, t = 0;
    char digest[17] = {};
    if (std::sscanf(line_.c_str(),
                    "# biocd shard %llu/%llu: %llu conformations from %llu of %llu, question %16[0-9a-f]", &i, &n, &c,
                    &f, &t, digest) != 6)
      refuse("its first line is damaged, expected the header of a shard");
    shard = {i, n};
    count = c;
    first = f;
    total = t;
    check_range();
    if (!next() || !line_.starts_with(csv_columns)) refuse("its second line is damaged, expected the column names");
    header = line_ + "\n";
    question = fmt::format("csv {} {} {}", digest, n, t);
  }

  void open_json() {
    is_json = true;
    std::string text = line_ + "\n";
    while (next() && line_ != json_rows_begin) text += line_ + "\n";
    if (line_ != json_rows_begin) refuse("has no conformations, expected the output of biocd --shard");
    text.resize(text.size() - std::min<std::size_t>(2, text.size()));  // removes the comma before the rows
    head = Json::parse(text + "}", nullptr, false);
    if (head.is_discarded() || !head.is_object()) refuse("its head is damaged");
    if (!head.contains("shard")) refuse("is the output of a whole run, expected a shard");
    const Json own = head["shard"];
    const auto number = [&](const char* key) {
      if (!own.is_object() || !own.contains(key) || !own[key].is_number_unsigned()) refuse("its shard is damaged");
      return own[key].get<std::uint64_t>();
    };
    shard = {number("index"), number("of")};
    first = number("first");
    count = number("count");
    total = number("total");
    check_range();
    head.erase("shard");
    question = fmt::format("json {} {} ", shard.of, total) + head.dump();
  }

  void read_summary() {
    const std::string key = "\"summary\": ";
    if (!next() || !line_.starts_with(key) || !line_.ends_with('}')) refuse("has no summary, it may be cut short");
    summary = Json::parse(line_.substr(key.size(), line_.size() - key.size() - 1), nullptr, false);
    if (summary.is_discarded() || !summary.is_object()) refuse("its summary is damaged");
    if (summary.contains("error")) refuse("its run ended early: " + summary["error"].dump());
  }

  std::uint64_t row_index() const {
    std::string_view text = line_;
    constexpr std::string_view key = "{\"index\":";
    if (is_json) text = text.starts_with(key) ? text.substr(key.size()) : std::string_view();
    std::uint64_t index = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), index);
    if (error != std::errc{} || end == text.data() + text.size() || *end != ',') refuse("a row is damaged: " + line_);
    return index;
  }

  std::string path_;
  std::ifstream stream_;
  std::string line_;
};

}  // namespace

Exit run_merge(const Options& options) {
  std::vector<ShardFile> files;
  for (const std::string& path : options.shards) {
    files.emplace_back(path);
    files.back().open();
    files.back().close();
    if (files.back().question != files.front().question)
      throw LoadError(path + ": is not a shard of the same run as " + files.front().path());
  }
  std::sort(files.begin(), files.end(),
            [](const ShardFile& a, const ShardFile& b) { return a.shard.index < b.shard.index; });
  for (std::size_t k = 0; k < files.size(); ++k) {
    const std::uint64_t index = files[k].shard.index;
    if (k > 0 && index == files[k - 1].shard.index)
      throw LoadError(fmt::format("{} and {} are both shard {}", files[k - 1].path(), files[k].path(), index));
    if (index != k + 1 || (k + 1 == files.size() && index != files[k].shard.of))
      throw LoadError(fmt::format("shard {} of {} is missing", index != k + 1 ? k + 1 : k + 2, files[k].shard.of));
  }

  // Validate everything before printing anything.
  Summary summary;
  std::optional<ClashTable> clashes;
  for (ShardFile& file : files) {
    file.for_rows([&](const std::string& row, bool is_new) {
      try {
        if (file.is_json)
          summary.add(Json::parse(row));
        else if (is_new)
          summary.add_csv(row);
      } catch (const Json::exception&) {
        throw LoadError(file.path() + ": a row is damaged: " + row);
      }
    });
    if (file.is_json) {
      try {
        summary.add_closures(file.summary);
        if (file.summary.contains("clashes")) {
          if (!clashes) clashes.emplace(file.summary.at("by") == "chain" ? By::chain : By::residue);
          clashes->add(file.summary.at("clashes"));
        }
      } catch (const Json::exception&) {
        throw LoadError(file.path() + ": its summary is damaged");
      }
    } else if (file.missing > 0) {
      summary.add(Starts{file.missing, 0, 0});
    }
  }
  const bool is_json = files.front().is_json;
  if (is_json)
    print_json_head(files.front().head);
  else
    fmt::print("{}", files.front().header);
  bool is_first = true;
  for (ShardFile& file : files) {
    file.for_rows([&](const std::string& row, bool) {
      if (is_json)
        fmt::print("{}{}", json_row_separator(std::exchange(is_first, false)), row);
      else
        fmt::print("{}\n", row);
    });
  }
  if (is_json) {
    Json all = summary.json_like(files.front().summary);
    if (clashes) {
      all["by"] = files.front().summary.at("by");
      all["clashes"] = clashes->json();
    }
    print_json_end(all);
  }
  return exit_of(summary);
}

}  // namespace biocd
