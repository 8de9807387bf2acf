// SPDX-License-Identifier: BSD-3-Clause
// ClashTable: which residues or chains clash, over all conformations of a run.
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <utility>

#include "hinge/molecular/checker.hpp"
#include "options.hpp"
#include "report.hpp"

namespace biocd {

/// Counts colliding pairs of atoms by the residues or chains that they belong to.
class ClashTable {
 public:
  explicit ClashTable(By by) : by_(by) {}

  /// Adds one conformation. job: the job of its structure.
  void add(const Job& job, const hinge::molecular::Verdict& verdict);
  /// Adds the rows of another table's json().
  void add(const Json& rows);

  /// Returns the rows, most conformations first, then most pairs: `first`, `second` (names), `conformations` (in which
  /// they clash), `pairs` (of atoms), `overlap` (largest, angstrom).
  Json json() const;
  /// Adds the members `by` and `clashes` to a summary.
  void add_to(Json& summary) const;
  /// Returns the same as a table with a heading; at most `most` rows, and a line about the others.
  std::string text(std::uint64_t most) const;

 private:
  struct Counts {
    std::uint64_t conformations = 0, pairs = 0;
    double overlap = 0.0;
  };
  By by_;
  std::map<std::pair<std::string, std::string>, Counts> rows_;
};

}  // namespace biocd
