// SPDX-License-Identifier: BSD-3-Clause
// Severity: how much two atoms overlap, and the class of the contact by the rules in use.
#pragma once

#include <cstddef>
#include <optional>
#include <string_view>

#include "hinge/core/api.hpp"
#include "hinge/molecular/radii.hpp"
#include "hinge/policy/collector.hpp"

namespace hinge::molecular {

/// Overlap and class of one pair.
struct Severity {
  /// Angstrom; negative for atoms apart: the sum of their radii, minus the allowance for a hydrogen bond (biocd: none),
  /// minus their distance.
  double overlap = 0.0;
  std::optional<double> relative_distance{};  ///< posebusters: distance / sum of radii; nullopt for hydrogens
  /// molprobity: clash, hydrogen_bond, small_overlap, close_contact, wide_contact, apart. chimerax: clash, contact,
  /// apart. posebusters: clash, apart, ignored (hydrogens). biocd and severe have no classes: empty. A static string.
  std::string_view kind{};
};

/// Returns the severity of a pair. collides: the verdict of these thresholds, which the rounded hit.distance cannot
/// tell. Bounds of the other classes include ties of coordinates with three decimals.
HINGE_API Severity severity_of(const Thresholds& thresholds, const Hit& hit, bool collides);

/// MolProbity's clashscore: clashes per 1000 atoms; 0 if atoms is 0.
HINGE_API double clashscore(std::size_t clashes, std::size_t atoms);

}  // namespace hinge::molecular
