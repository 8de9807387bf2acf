// SPDX-License-Identifier: BSD-3-Clause
// Implements what check shows of one conformation.
#include "checked.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "hinge/molecular/severity.hpp"
#include "hinge_tools/counted.hpp"
#include "pair_table.hpp"

namespace biocd {

using namespace hinge::molecular;
using hinge::tool::counted;

namespace {

/// Returns text such as ", bonds within 0.012 angstrom, closures within 0.34 angstrom". Residuals below 0.0005 are left
/// out.
std::string deviations_text(const Checked& checked) {
  std::string text;
  const auto add = [&](const char* what, double residual) {
    if (residual >= 0.0005) text += fmt::format(", {} within {:.3f} angstrom", what, residual);
  };
  add("bonds", checked.bond.residual);
  add("closures", checked.verdict.closure_residual);
  return text;
}

}  // namespace

std::optional<double> clashscore_of(const Options& options, const Job& job, const Verdict& verdict, const Mode& mode) {
  const bool lists_all = mode.kind == Mode::Kind::all || mode.kind == Mode::Kind::within;
  if (options.check.thresholds.rules != "molprobity" || !lists_all || !options.between.empty() ||
      !options.inside.empty() || options.check.exempt_reference)
    return std::nullopt;
  const auto clashes =
      std::count_if(verdict.pairs.begin(), verdict.pairs.end(), [](const Contact& pair) { return pair.collides; });
  return clashscore(static_cast<std::size_t>(clashes), job.molecule->structure().atoms.size());
}

Json bond_json(const Structure& s, const BondDeviation& bond) {
  if (bond.first == bond.second) return {};
  return {{"i", bond.first},
          {"j", bond.second},
          {"label_i", label(s, bond.first)},
          {"label_j", label(s, bond.second)},
          {"length", bond.length},
          {"reference", bond.reference},
          {"residual", bond.residual}};
}

void print_table_row(const Options& options, const Job& job, const std::string& name, const Checked& checked,
                     const Mode& mode, const std::optional<double>& clashscore, bool& headed) {
  const Verdict& verdict = checked.verdict;
  fmt::print("{}: {}", name, verdict.collides ? "collides" : "free");
  const std::string pairs = counted(verdict.pairs.size(), "pair");
  if (mode.kind == Mode::Kind::all) fmt::print(", {}", pairs);
  if (mode.kind == Mode::Kind::within) fmt::print(", {} closer than the threshold + {} angstrom", pairs, mode.margin);
  if (clashscore) fmt::print(", clashscore {:.2f}", *clashscore);
  fmt::print("{}\n", deviations_text(checked));
  if (!options.by) fmt::print("{}", pair_table(options, job, verdict.pairs, headed));
  if (verdict.closest) fmt::print("{}", pair_table(options, job, {*verdict.closest}, headed, "  (closest)"));
  headed = headed && verdict.pairs.empty() && !verdict.closest;
}

Checked check_alone(const Options& options, int model, const Mode& mode, const std::string& difference) {
  Options alone = options;
  alone.read.model = model;
  alone.rigid_from.clear();  // refers to atoms of the first model; no effect here
  Checked checked;
  checked.difference = difference;
  checked.own = std::make_shared<const Job>(load(alone));
  Checker checker = checked.own->checker;
  checked.verdict = checker.check_coordinates(checked.own->molecule->structure().models.front(), mode);
  return checked;
}

}  // namespace biocd
