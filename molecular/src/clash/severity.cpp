// SPDX-License-Identifier: BSD-3-Clause
// Computes overlaps, and classifies pairs by the categories of the named rules.
#include "hinge/molecular/severity.hpp"

namespace hinge::molecular {

namespace {

/// Angstrom. With coordinates on thousandths, an overlap not equal to a bound differs from it by more than 1e-7;
/// overlaps computed in doubles are accurate to 1e-14.
constexpr double tie = 1e-9;

/// Returns Probe's category. plain: overlap without the hydrogen-bond allowance. The bounds are Probe's -DIVHigh and
/// twice its probe radius.
std::string_view molprobity(double overlap, double plain, bool may_bond) {
  constexpr double close = -0.25, reach = -0.5;  // angstrom
  if (may_bond && plain >= -tie && overlap <= tie) return "hydrogen_bond";
  if (plain >= -tie) return "small_overlap";
  if (plain >= close - tie) return "close_contact";
  return plain >= reach - tie ? "wide_contact" : "apart";
}

/// Returns the category of the command `contacts`, which has no hydrogen-bond allowance.
std::string_view chimerax(double plain) {
  constexpr double contact = -0.4;  // angstrom
  return plain >= contact - tie ? "contact" : "apart";
}

}  // namespace

Severity severity_of(const Thresholds& thresholds, const Hit& hit, bool collides) {
  const std::size_t pair =
      thresholds.matrix.type(hit.first) * thresholds.type_names.size() + thresholds.matrix.type(hit.second);
  const double contact = thresholds.contact[pair], allowance = thresholds.allowance[pair];
  Severity severity{contact - hit.distance};
  const std::string_view rules = thresholds.rules->name;
  if (rules == "biocd" || rules == "severe") return severity;
  if (rules == "posebusters" && contact > 0.0) severity.relative_distance = hit.distance / contact;
  const double plain = severity.overlap + allowance;
  if (collides)
    severity.kind = "clash";
  else if (rules == "molprobity")
    severity.kind = molprobity(severity.overlap, plain, allowance > 0.0);
  else if (rules == "chimerax")
    severity.kind = chimerax(plain);
  else
    severity.kind = contact > 0.0 ? "apart" : "ignored";
  return severity;
}

double clashscore(std::size_t clashes, std::size_t atoms) {
  return atoms == 0 ? 0.0 : 1000.0 * static_cast<double>(clashes) / static_cast<double>(atoms);
}

}  // namespace hinge::molecular
