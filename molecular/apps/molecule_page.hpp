// SPDX-License-Identifier: BSD-3-Clause
// MoleculePage: the HTML file of --report, with the molecule, its conformations and their clashes.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "hinge/core/vec3.hpp"
#include "hinge/molecular/checker.hpp"
#include "hinge_tools/complete_file.hpp"
#include "hinge_tools/report_choice.hpp"
#include "hinge_tools/report_page.hpp"
#include "options.hpp"

namespace biocd {

/// A conformation that the page shows.
struct PageFrame {
  std::uint64_t index = 0;                       ///< in the run
  std::string name;                              ///< such as "model 3"
  bool collides = false;                         ///< the verdict
  std::vector<hinge::Vec3> positions;            ///< angstrom, one per atom
  std::vector<hinge::molecular::Contact> pairs;  ///< pairs to list and mark
};

/// Returns what a page says about the command, the question and the files; without a verdict.
hinge::tool::ReportWords page_words(const Options& options, const Job& job);

/// Collects what the page shows. Does nothing without --report. Refers to the options and the job.
class MoleculePage {
 public:
  /// is_path: the frames follow each other in time, and all are shown. counts_pairs: offered verdicts list pairs.
  /// Throws LoadError if the file cannot be written.
  MoleculePage(const Options& options, const Job& job, bool is_path, bool counts_pairs = true);

  /// True if --report is given.
  bool wanted() const noexcept { return file_.wanted(); }
  /// The words of the page. The constructor sets all but `state` and `verdict`.
  hinge::tool::ReportWords& words() noexcept { return words_; }

  /// Takes a conformation into account, in the order of the run.
  void offer(std::uint64_t index, const hinge::molecular::Verdict& verdict);
  /// Returns the indices of the conformations to add: the worst of the offered ones, in the order of the run.
  std::vector<std::uint64_t> chosen() const;
  /// Adds a chosen conformation, in the order of chosen().
  void add(PageFrame frame);
  /// Offers and adds a conformation.
  void add_next(PageFrame frame);

  /// Writes the file. state: "free", "collides" or "undecided"; verdict: one sentence. Throws LoadError if it cannot be
  /// written.
  void write(const char* state, const std::string& verdict);

 private:
  const Options& options_;
  const Job& job_;
  hinge::tool::CompleteFile file_;
  hinge::tool::ReportWords words_;
  hinge::tool::ReportChoice choice_;
  std::vector<PageFrame> frames_;
};

}  // namespace biocd
