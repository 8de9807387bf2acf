// SPDX-License-Identifier: BSD-3-Clause
// robocd merge: prints the output of a check that was computed in parts.
#include <cstdint>

#include "hinge_tools/merge_parts.hpp"
#include "options.hpp"
#include "report.hpp"
#include "summary.hpp"

namespace robocd {

Exit run_merge(const Options& options) {
  Summary summary;
  std::uint64_t colliding = 0;
  hinge::tool::merge_parts<Json>(
      options.merged, options.out, "robocd",
      [&](const Json& row) { summary.add(row.at("collides").get<bool>(), named_pairs(row)); },
      [&](const hinge::tool::UnitCounts& counts, const Json&) { colliding += counts.colliding; },
      [&] { return summary.json(); });
  return colliding > 0 ? Exit::collision : Exit::free;
}

}  // namespace robocd
