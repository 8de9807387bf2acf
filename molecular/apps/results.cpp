// SPDX-License-Identifier: BSD-3-Clause
// Prints results: a head, one row per conformation (or pair), and a summary.
#include "results.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cstdio>
#include <string_view>

#include "hinge/core/error.hpp"
#include "hinge_tools/json_text.hpp"

namespace biocd {

namespace {

/// 64-bit FNV-1a hash: distinguishes questions.
std::uint64_t digest(std::string_view text) {
  std::uint64_t hash = 0xcbf29ce484222325ULL;
  for (const char c : text) hash = (hash ^ static_cast<unsigned char>(c)) * 0x100000001b3ULL;
  return hash;
}

bool read_number(std::string_view text, std::uint64_t& number) {
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  return error == std::errc{} && end == text.data() + text.size();
}

}  // namespace

Shard parse_shard(const std::string& text) {
  constexpr std::uint64_t most = 1000000;
  const std::string_view view = text;
  const std::size_t slash = std::min(view.find('/'), view.size());
  Shard shard;
  if (!read_number(view.substr(0, slash), shard.index) || slash == view.size() ||
      !read_number(view.substr(slash + 1), shard.of) || shard.index < 1 || shard.index > shard.of || shard.of > most)
    throw hinge::ModelError(fmt::format("--shard {}: expected i/n, i from 1 to n, n at most {}", text, most));
  return shard;
}

std::pair<std::uint64_t, std::uint64_t> shard_range(const Shard& shard, std::uint64_t total) {
  // The first total % of shards have one more; this form cannot overflow.
  const std::uint64_t length = total / shard.of, longer = total % shard.of;
  const auto start = [&](std::uint64_t k) { return k * length + std::min(k, longer); };
  return {start(shard.index - 1), start(shard.index)};
}

void print_json_head(const Json& head) {
  std::string text = hinge::tool::json_text(head, 1);
  text.resize(text.rfind('\n'));  // print_json_end prints the closing brace
  fmt::print("{},\n{}", text, json_rows_begin);
}

const char* json_row_separator(bool is_first) { return is_first ? "\n" : ",\n"; }

void print_json_end(const Json& summary) {
  fmt::print("\n{}\n\"summary\": {}}}\n", json_rows_end, hinge::tool::json_text(summary));
}

std::string csv_shard_line(const Shard& shard, std::uint64_t total, const Json& head) {
  const auto [first, end] = shard_range(shard, total);
  return fmt::format("# biocd shard {}/{}: {} conformations from {} of {}, question {:016x}\n", shard.index, shard.of,
                     end - first, first, total, digest(hinge::tool::json_text(head)));
}

Results::Results(const Options& options, Json head, std::uint64_t total, const std::string& columns)
    : output_(options.output), sharded_(options.shard.has_value()) {
  if (sharded_ && output_ == Output::table) throw hinge::ModelError("--shard: expected --json or --csv in addition");
  if (sharded_ && options.max_pairs)
    throw hinge::ModelError("--max-pairs: a shard holds all pairs for biocd merge, expected no limit");
  if (output_ == Output::json) {
    if (sharded_) {
      const auto [first, end] = shard_range(*options.shard, total);
      head["shard"] = Json{{"index", options.shard->index},
                           {"of", options.shard->of},
                           {"first", first},
                           {"count", end - first},
                           {"total", total}};
    }
    print_json_head(head);
  }
  if (output_ == Output::csv) {
    if (sharded_) fmt::print("{}", csv_shard_line(*options.shard, total, head));
    fmt::print("{}", csv_header(options, columns));
  }
}

void Results::add(const Json& row, const std::string& pairs) {
  const std::string text = hinge::tool::json_text(row);
  // `pairs` follows a number and a Boolean, so its first occurrence is the member.
  constexpr std::string_view placeholder = "\"pairs\":null";
  const std::size_t at = pairs.empty() ? std::string::npos : text.find(placeholder);
  std::fputs(json_row_separator(empty_), stdout);
  empty_ = false;
  if (at == std::string::npos) {
    std::fwrite(text.data(), 1, text.size(), stdout);
    return;
  }
  const std::size_t end = at + placeholder.size(), start = end - 4;
  std::fwrite(text.data(), 1, start, stdout);
  std::fwrite(pairs.data(), 1, pairs.size(), stdout);
  std::fwrite(text.data() + end, 1, text.size() - end, stdout);
}

void Results::add(const std::string& csv_rows) { fmt::print("{}", csv_rows); }

void Results::finish(Json summary, const std::string& error) {
  if (output_ == Output::json) {
    if (!error.empty()) summary["error"] = error;
    print_json_end(summary);
  }
  if (output_ == Output::csv && sharded_ && error.empty())
    fmt::print("{} {}\n", csv_shard_end, summary.value("missing", std::uint64_t{0}));
}

}  // namespace biocd
