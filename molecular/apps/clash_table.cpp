// SPDX-License-Identifier: BSD-3-Clause
// Counts clashes by residue or chain.
#include "clash_table.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <vector>

#include "hinge/core/id.hpp"
#include "hinge/molecular/severity.hpp"
#include "hinge_tools/max_pairs_option.hpp"

namespace biocd {

using namespace hinge::molecular;

namespace {

/// Returns "A:LYS77" or "A"; a chain without a name is "_".
std::string name_of(const Structure& s, By by, std::uint32_t atom) {
  const std::string text = residue_label(s, s.atoms[atom].residue);
  return by == By::residue ? text : text.substr(0, text.find(':'));
}

const char* word_of(By by) { return by == By::residue ? "residue" : "chain"; }

}  // namespace

void ClashTable::add_to(Json& summary) const {
  summary["by"] = word_of(by_);
  summary["clashes"] = json();
}

void ClashTable::add(const Job& job, const Verdict& verdict) {
  const Structure& s = job.molecule->structure();
  std::map<std::pair<std::string, std::string>, Counts> own;
  for (const Contact& pair : verdict.pairs) {
    if (!pair.collides) continue;
    const auto i = static_cast<std::uint32_t>(hinge::index(pair.hit.first)),
               j = static_cast<std::uint32_t>(hinge::index(pair.hit.second));
    const double overlap = severity_of(job.checker.thresholds(), pair.hit, true).overlap;
    const auto [row, is_new] = own.try_emplace({name_of(s, by_, i), name_of(s, by_, j)});
    row->second.overlap = is_new ? overlap : std::max(row->second.overlap, overlap);
    ++row->second.pairs;
  }
  for (const auto& [names, counts] : own) {
    const auto [row, is_new] = rows_.try_emplace(names);
    ++row->second.conformations;
    row->second.pairs += counts.pairs;
    row->second.overlap = is_new ? counts.overlap : std::max(row->second.overlap, counts.overlap);
  }
}

void ClashTable::add(const Json& rows) {
  for (const Json& given : rows) {
    const auto [row, is_new] =
        rows_.try_emplace({given.at("first").get<std::string>(), given.at("second").get<std::string>()});
    const double overlap = given.at("overlap").get<double>();
    row->second.conformations += given.at("conformations").get<std::uint64_t>();
    row->second.pairs += given.at("pairs").get<std::uint64_t>();
    row->second.overlap = is_new ? overlap : std::max(row->second.overlap, overlap);
  }
}

Json ClashTable::json() const {
  std::vector<Json> rows;
  for (const auto& [names, counts] : rows_)
    rows.push_back({{"first", names.first},
                    {"second", names.second},
                    {"conformations", counts.conformations},
                    {"pairs", counts.pairs},
                    {"overlap", counts.overlap}});
  std::stable_sort(rows.begin(), rows.end(), [](const Json& a, const Json& b) {
    const auto key = [](const Json& row) {
      return std::pair(row.at("conformations").get<std::uint64_t>(), row.at("pairs").get<std::uint64_t>());
    };
    return key(a) > key(b);
  });
  return rows;
}

std::string ClashTable::text(std::uint64_t most) const {
  if (rows_.empty()) return {};
  const char* const what = word_of(by_);
  std::string text = fmt::format("  {:<12} {:<12} conformations      pairs  largest overlap (A)\n",
                                 fmt::format("{} 1", what), fmt::format("{} 2", what));
  const Json rows = json();
  const std::uint64_t printed = most == 0 ? rows.size() : std::min<std::uint64_t>(most, rows.size());
  for (std::uint64_t k = 0; k < printed; ++k)
    text += fmt::format("  {:<12} {:<12} {:13} {:10} {:20.3f}\n", rows[k].at("first").get<std::string>(),
                        rows[k].at("second").get<std::string>(), rows[k].at("conformations").get<std::uint64_t>(),
                        rows[k].at("pairs").get<std::uint64_t>(), rows[k].at("overlap").get<double>());
  return text + hinge::tool::left_out_text(rows.size() - printed);
}

}  // namespace biocd
