// SPDX-License-Identifier: BSD-3-Clause
// Severity: how much two atoms overlap, and what the rules in use call that.
#pragma once

#include <cstddef>
#include <optional>
#include <string_view>

#include "hinge/molecular/radii.hpp"
#include "hinge/policy/collector.hpp"

namespace hinge::molecular {

struct Severity {
  /// Angstrom, below 0 for atoms apart: the sum of their radii, less what the rules allow a hydrogen bond (nothing by
  /// biocd's), less their distance.
  double overlap = 0.0;
  std::optional<double> relative_distance{};  ///< posebusters: distance over the sum of radii; of heavy atoms only
  /// molprobity: clash, hydrogen_bond, small_overlap, close_contact, wide_contact; chimerax: clash, contact;
  /// posebusters: clash, ignored (hydrogens); beyond these apart. biocd has no classes: empty.
  std::string_view kind{};
};

/// Of a pair that collides or not by these thresholds, which its rounded distance cannot say. The other classes begin
/// at their bounds, ties of coordinates with three decimals included.
Severity severity_of(const Thresholds& thresholds, const Hit& hit, bool collides);

/// MolProbity's clashscore: clashes per 1000 atoms.
double clashscore(std::size_t clashes, std::size_t atoms);

}  // namespace hinge::molecular
