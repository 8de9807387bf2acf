// SPDX-License-Identifier: BSD-3-Clause
// Summary: what is counted over the conformations of a run, from verdicts or from rows that were printed of them.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <unordered_map>
#include <vector>

#include "hinge/molecular/checker.hpp"
#include "hinge_tools/frequent_keys.hpp"
#include "report.hpp"

namespace biocd {

/// A pair of atoms, and in how many conformations it collides.
struct Offender {
  std::uint32_t i = 0, j = 0;
  std::string label_i, label_j;
  std::uint64_t count = 0;
};

/// What it took to close samples, and how many did not.
struct Starts {
  std::uint64_t missing = 0;   ///< samples that no start gave
  std::uint64_t unclosed = 0;  ///< starts that did not close
  std::uint64_t refused = 0;   ///< closed, but colliding
};

class Summary {
 public:
  Summary() = default;
  /// closures: their names. Starts are counted only where samples are closed, offenders only where they are shown.
  Summary(std::vector<std::string> closures, bool closed, bool with_offenders);

  /// The structure must outlive the summary.
  void add(const hinge::molecular::Structure& structure, const hinge::molecular::Verdict& verdict);
  /// MolProbity's, of a conformation added before.
  void add_clashscore(double clashscore);
  /// A row of verdict_json.
  void add(const Json& row);
  /// The first row of a conformation in CSV.
  void add_csv(const std::string& row);
  void add(const Starts& starts);
  /// What rows do not say: the summary of those added.
  void add_closures(const Json& summary);

  std::uint64_t checked() const { return checked_; }
  std::uint64_t colliding() const { return colliding_; }
  double worst_residual() const { return worst_residual_; }
  /// By closure, angstrom; empty until a conformation had any.
  const std::vector<double>& worst_residuals() const { return worst_residuals_; }
  const std::optional<Starts>& starts() const { return starts_; }
  /// The ten pairs that collide most often, most frequent first.
  std::vector<Offender> top() const;
  /// Counts of offenders may be too low by at most this: memory is bounded (FrequentKeys).
  std::uint64_t count_error() const { return offenders_.count_error(); }
  /// checked, colliding, clashscore (mean) and worst_clashscore where there are any, worst_closure_residual and
  /// closures where conformations were computed, offenders, offenders_count_error unless it is 0, and missing,
  /// starts_unclosed, closed_refused where they were closed.
  Json json(bool with_closures) const;
  /// With the keys that another summary has.
  Json json_like(const Json& other) const { return json(other.contains("worst_closure_residual")); }

 private:
  std::uint64_t checked_ = 0;
  std::uint64_t colliding_ = 0;
  double worst_residual_ = 0.0;
  std::vector<std::string> closures_;
  std::vector<double> worst_residuals_;
  std::optional<Starts> starts_;
  std::uint64_t scored_ = 0;
  double clashscores_ = 0.0;  // sum
  double worst_clashscore_ = 0.0;
  bool with_offenders_ = true;
  hinge::tool::FrequentKeys offenders_;  // (i << 32) + j
  const hinge::molecular::Structure* structure_ = nullptr;
  std::unordered_map<std::uint32_t, std::string> labels_;  // of rows, by atom
};

}  // namespace biocd
