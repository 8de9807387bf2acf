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
  blockers_.set_labels([&structure](std::uint32_t residue) { return residue_label(structure, residue); });
  ++missing_;
  stopped_ += stopped ? 1 : 0;
  const auto residue = [&](hinge::PrimitiveId atom) { return structure.atoms[hinge::index(atom)].residue; };
  for (const hinge::Hit& hit : blockers) blockers_.add(residue(hit.first), residue(hit.second));
}

void Shortfall::add(std::uint64_t missing, const Json& summary) {
  missing_ += missing;
  if (!summary.contains("in_the_way")) return;
  stopped_ += summary.at("out_of_time").get<std::uint64_t>();
  for (const Json& pair : summary.at("in_the_way")) blockers_.add(pair, pair.at("count").get<std::uint64_t>());
}

void Shortfall::add_to(Json& summary, std::size_t most_pairs) const {
  if (missing_ == 0) return;
  summary["out_of_time"] = stopped_;
  summary["in_the_way"] = blockers_.json(most_pairs);
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
  for (const PairCount& pair : blockers_.top(3))
    text += std::exchange(begin, ", ") + pair.label_i + " and " + pair.label_j;
  std::fputs((text + '\n').c_str(), stderr);
}

}  // namespace biocd
