// SPDX-License-Identifier: BSD-3-Clause
// Summary: the counts over the conformations of a run, from verdicts or from printed rows.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "hinge/molecular/checker.hpp"
#include "options.hpp"
#include "pair_counts.hpp"
#include "report.hpp"

namespace biocd {

/// Counts of random starts and of samples without a conformation.
struct Starts {
  std::uint64_t missing = 0;   ///< samples for which no start was accepted
  std::uint64_t unclosed = 0;  ///< starts that did not close
  std::uint64_t refused = 0;   ///< starts that ended at a collision
};

/// Counts over the conformations of a run. One thread only.
class Summary {
 public:
  Summary() = default;
  /// closures: their names. closed: count starts too. with_offenders: count colliding pairs too.
  Summary(std::vector<std::string> closures, bool closed, bool with_offenders);

  /// Adds one verdict. The structure must outlive the summary.
  void add(const hinge::molecular::Structure& structure, const hinge::molecular::Verdict& verdict);
  /// Adds the MolProbity clashscore of a conformation that was added before.
  void add_clashscore(double clashscore);
  /// Adds a conformation by its row of verdict_json.
  void add(const Json& row);
  /// Adds counts of starts.
  void add(const Starts& starts);
  /// Adds the closure residuals and starts of a unit's summary, which its rows do not contain.
  void add_closures(const Json& summary);

  /// Returns the number of conformations added.
  std::uint64_t checked() const { return checked_; }
  /// Returns the number of these that collide.
  std::uint64_t colliding() const { return colliding_; }
  /// Returns the largest closure residual of all conformations, angstrom.
  double worst_residual() const { return worst_residual_; }
  /// Returns the worst residual per closure, angstrom; empty until a conformation with closures is added.
  const std::vector<double>& worst_residuals() const { return worst_residuals_; }
  /// Returns the counts of starts; nothing if they are not counted.
  const std::optional<Starts>& starts() const { return starts_; }
  /// Returns the ten pairs that collide most often, most frequent first.
  std::vector<PairCount> top() const;
  /// Returns the largest possible undercount of an offender: memory is bounded (FrequentKeys).
  std::uint64_t count_error() const { return offenders_.count_error(); }
  /// Returns the keys checked and colliding; clashscore (mean) and worst_clashscore if there are any;
  /// worst_closure_residual and closures if with_closures; offenders; offenders_count_error unless 0; missing,
  /// starts_unclosed and closed_refused if starts are counted.
  Json json(bool with_closures) const;

 private:
  std::uint64_t checked_ = 0;
  std::uint64_t colliding_ = 0;
  double worst_residual_ = 0.0;
  std::vector<std::string> closures_;
  std::vector<double> worst_residuals_;
  std::optional<Starts> starts_;
  std::uint64_t scored_ = 0;
  double clashscores_ = 0.0;  // sum over conformations
  double worst_clashscore_ = 0.0;
  bool with_offenders_ = true;
  PairCounts offenders_;
};

/// Returns the exit status of a run with these counts.
Exit exit_of(const Summary& summary);

}  // namespace biocd
