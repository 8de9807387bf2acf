// SPDX-License-Identifier: BSD-3-Clause
// Says how many samples are missing, and what stood in the way.
#include "shortfall.hpp"

#include <fmt/format.h>

#include <cstdio>
#include <string>
#include <utility>

#include "hinge/core/id.hpp"
#include "hinge_tools/counted.hpp"

namespace biocd {

void Shortfall::add(const hinge::molecular::Structure& structure, std::span<const hinge::Hit> blockers, bool stopped) {
  ++missing_;
  stopped_ += stopped ? 1 : 0;
  const auto residue = [&](hinge::PrimitiveId atom) {
    const std::uint32_t found = structure.atoms[hinge::index(atom)].residue;
    if (!labels_.contains(found)) labels_.emplace(found, residue_label(structure, found));
    return found;
  };
  for (const hinge::Hit& hit : blockers)
    blockers_.add((std::uint64_t{residue(hit.first)} << 32U) + residue(hit.second));
}

void Shortfall::add(std::uint64_t missing, const Json& summary) {
  missing_ += missing;
  if (!summary.contains("in_the_way")) return;
  stopped_ += summary.at("out_of_time").get<std::uint64_t>();
  for (const Json& pair : summary.at("in_the_way")) {
    const auto residue = [&](const char* index, const char* label) {
      const auto found = pair.at(index).get<std::uint32_t>();
      labels_.emplace(found, pair.at(label).get<std::string>());
      return found;
    };
    const std::uint64_t first = residue("i", "label_i");
    blockers_.add((first << 32U) + residue("j", "label_j"), pair.at("count").get<std::uint64_t>());
  }
}

std::vector<Shortfall::Pair> Shortfall::top(std::size_t most) const {
  std::vector<Pair> pairs;
  for (const auto& [key, count] : blockers_.top(most))
    pairs.push_back({static_cast<std::uint32_t>(key >> 32U), static_cast<std::uint32_t>(key), count});
  return pairs;
}

void Shortfall::add_to(Json& summary, std::size_t most_pairs) const {
  if (missing_ == 0) return;
  summary["out_of_time"] = stopped_;
  Json pairs = Json::array();
  for (const Pair& pair : top(most_pairs))
    pairs.push_back({{"i", pair.first},
                     {"j", pair.second},
                     {"label_i", labels_.at(pair.first)},
                     {"label_j", labels_.at(pair.second)},
                     {"count", pair.count}});
  summary["in_the_way"] = std::move(pairs);
}

void Shortfall::print(bool collision_free, std::uint64_t asked, std::uint64_t most_starts) const {
  if (missing_ == 0) return;
  std::string text =
      fmt::format("{} of {} {} missing", missing_, hinge::tool::counted(asked, "sample"), asked == 1 ? "is" : "are");
  const char* begin = ": ";
  if (missing_ > stopped_)
    text += std::exchange(begin, "; ") +
            fmt::format("for {} of them, none of {} starts {}", missing_ - stopped_, most_starts,
                        collision_free ? "gave a conformation without a collision" : "closed");
  if (stopped_ > 0) text += begin + fmt::format("for {} of them, the time of --time was over", stopped_);
  begin = "; most often in the way: ";
  for (const Pair& pair : top(3))
    text += std::exchange(begin, ", ") + labels_.at(pair.first) + " and " + labels_.at(pair.second);
  std::fputs((text + '\n').c_str(), stderr);
}

}  // namespace biocd
