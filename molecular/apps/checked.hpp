// SPDX-License-Identifier: BSD-3-Clause
// Checked: what check finds about one conformation, and how its table shows it.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "hinge/core/vec3.hpp"
#include "hinge/molecular/bond_gauge.hpp"
#include "hinge/molecular/checker.hpp"
#include "options.hpp"
#include "report.hpp"

namespace biocd {

struct Checked {
  hinge::molecular::Verdict verdict;
  hinge::molecular::BondDeviation bond;
  std::string pairs{};                 // JSON; empty for other outputs, and for modes without a list
  std::vector<hinge::Vec3> positions;  // empty unless --out takes them
  std::string error;                   // not empty if there is no verdict
  std::shared_ptr<const Job> own{};    // for a model with other atoms than the first
  std::string difference{};            // how its atoms differ
};

/// Returns MolProbity's clashscore if its rules are in use and all pairs are listed, otherwise nothing.
std::optional<double> clashscore_of(const Options& options, const Job& job, const hinge::molecular::Verdict& verdict,
                                    const hinge::Mode& mode);
Json bond_json(const hinge::molecular::Structure& s, const hinge::molecular::BondDeviation& bond);
/// headed: whether the next list of pairs starts with the names of its columns.
void print_table_row(const Options& options, const Job& job, const std::string& name, const Checked& checked,
                     const hinge::Mode& mode, const std::optional<double>& clashscore, bool& headed);
/// Checks a model with other atoms than the first, with a topology of its own.
Checked check_alone(const Options& options, int model, const hinge::Mode& mode, const std::string& difference);

}  // namespace biocd
