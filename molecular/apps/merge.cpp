// SPDX-License-Identifier: BSD-3-Clause
// biocd merge: prints the output of a run that was computed in parts.
#include <optional>

#include "clash_table.hpp"
#include "hinge_tools/merge_parts.hpp"
#include "options.hpp"
#include "report.hpp"
#include "shortfall.hpp"
#include "summary.hpp"

namespace biocd {

Exit run_merge(const Options& options) {
  Summary summary;
  std::optional<ClashTable> clashes;
  Shortfall shortfall;
  std::uint64_t colliding = 0, missing = 0;
  bool with_closures = false;
  hinge::tool::merge_parts<Json>(
      options.merged, options.out, "biocd", [&](const Json& row) { summary.add(row); },
      [&](const hinge::tool::UnitCounts& counts, const Json& unit) {
        colliding += counts.colliding;
        missing += counts.missing;
        with_closures = with_closures || unit.contains("worst_closure_residual");
        summary.add_closures(unit);
        shortfall.add(counts.missing, unit);
        if (!unit.contains("clashes")) return;
        if (!clashes) clashes.emplace(unit.at("by") == "chain" ? By::chain : By::residue);
        clashes->add(unit.at("clashes"));
      },
      [&] {
        Json all = summary.json(with_closures);
        if (clashes) clashes->add_to(all);
        shortfall.add_to(all, most_in_the_way);
        return all;
      });
  if (colliding > 0) return Exit::collision;
  return missing > 0 ? Exit::shortfall : Exit::free;
}

}  // namespace biocd
