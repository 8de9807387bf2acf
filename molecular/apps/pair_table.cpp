// SPDX-License-Identifier: BSD-3-Clause
// Writes lists of pairs as tables.
#include "pair_table.hpp"

#include <fmt/format.h>

#include <cstdint>
#include <cstdio>

#include "hinge/core/id.hpp"
#include "hinge/molecular/severity.hpp"
#include "hinge_tools/counted.hpp"
#include "hinge_tools/max_pairs_option.hpp"

namespace biocd {

using hinge::molecular::Contact;
using hinge::molecular::Severity;

namespace {

std::string name_of(const Job& job, hinge::PrimitiveId i) {
  return label(job.molecule->structure(), static_cast<std::uint32_t>(hinge::index(i)));
}

std::string pair_heading(const Job& job) {
  const std::string_view rules = job.checker.thresholds().rules->name;
  return fmt::format("  {:<18} {:<18} distance (A)   threshold (A)  overlap (A){}{}\n", "atom 1", "atom 2",
                     has_relative_distance(rules) ? "  relative distance" : "", has_classes(rules) ? "  class" : "");
}

std::string pair_line(const Job& job, const Contact& pair) {
  const hinge::Hit& hit = pair.hit;
  const Severity of = severity_of(job.checker.thresholds(), hit, pair.collides);
  const bool collides = pair.collides;
  std::string line =
      fmt::format("  {:<18} {:<18} {:12.3f} {} {:<{}.3f} {:11.3f}", name_of(job, hit.first), name_of(job, hit.second),
                  hit.distance, collides ? "<" : ">=", hit.threshold, collides ? 14 : 13, of.overlap);
  if (has_relative_distance(job.checker.thresholds().rules->name))
    line += of.relative_distance ? fmt::format("  {:17.3f}", *of.relative_distance) : fmt::format("  {:>17}", "-");
  if (!of.kind.empty()) line += fmt::format("  {}", of.kind);
  return line;
}

}  // namespace

std::span<const Contact> pairs_to_print(const Options& options, const std::vector<Contact>& pairs) {
  const bool is_table = options.output == Output::table;
  return std::span(pairs).first(hinge::tool::pairs_to_print(options.max_pairs, is_table, pairs.size()));
}

void add_left_out(Json& row, const Options& options, const std::vector<Contact>& pairs,
                  const hinge::molecular::Mode& mode) {
  if (options.max_pairs && lists_pairs(mode))
    row["pairs_left_out"] = pairs.size() - pairs_to_print(options, pairs).size();
}

void note_left_out(const Options& options, std::uint64_t left_out) {
  if (left_out == 0 || options.output != Output::csv) return;
  fmt::print(stderr, "note: --max-pairs {}: {} without a row\n", options.max_pairs.value_or(0),
             hinge::tool::counted(left_out, "pair"));
}

std::vector<Contact> contacts(std::span<const hinge::Hit> hits) {
  std::vector<Contact> pairs;
  for (const hinge::Hit& hit : hits) pairs.push_back({hit, true});
  return pairs;
}

std::string pair_table(const Options& options, const Job& job, const std::vector<Contact>& pairs, bool headed,
                       const std::string& note) {
  if (pairs.empty()) return {};
  std::string text = headed ? pair_heading(job) : "";
  const auto printed = pairs_to_print(options, pairs);
  for (const Contact& pair : printed) text += pair_line(job, pair) + note + "\n";
  return text + hinge::tool::left_out_text(pairs.size() - printed.size());
}

std::string pair_sentence(const Job& job, const Contact& pair) {
  const hinge::Hit& hit = pair.hit;
  const Severity of = severity_of(job.checker.thresholds(), hit, pair.collides);
  return fmt::format("{} - {}: {:.3f} {} {:.3f} angstrom, overlap {:.3f}", name_of(job, hit.first),
                     name_of(job, hit.second), hit.distance, pair.collides ? "<" : ">=", hit.threshold, of.overlap);
}

}  // namespace biocd
