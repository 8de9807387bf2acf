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

void Shortfall::add(std::span<const hinge::Hit> blockers, bool stopped) {
  ++missing_;
  stopped_ += stopped ? 1 : 0;
  const auto residue = [&](hinge::PrimitiveId atom) { return structure_.atoms[hinge::index(atom)].residue; };
  for (const hinge::Hit& hit : blockers)
    blockers_.add((std::uint64_t{residue(hit.first)} << 32U) + residue(hit.second));
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
  for (const auto& [key, count] : blockers_.top(3))
    text += std::exchange(begin, ", ") + residue_label(structure_, static_cast<std::uint32_t>(key >> 32U)) + " and " +
            residue_label(structure_, static_cast<std::uint32_t>(key));
  std::fputs((text + '\n').c_str(), stderr);
}

}  // namespace biocd
