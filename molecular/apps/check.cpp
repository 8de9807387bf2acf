// SPDX-License-Identifier: BSD-3-Clause
// biocd check: coordinates of files, model by model or frame by frame, every admitted pair.
#include <fmt/format.h>

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "conformation_file.hpp"
#include "frames.hpp"
#include "hinge/core/error.hpp"
#include "hinge/ensemble/ensemble.hpp"
#include "hinge/molecular/severity.hpp"
#include "hinge/tool/progress_bar.hpp"
#include "options.hpp"
#include "report.hpp"
#include "results.hpp"
#include "summary.hpp"

namespace biocd {

namespace {

using namespace hinge::molecular;

struct Checked {
  Verdict verdict;
  std::vector<hinge::Vec3> positions;  // only when they are to be written
  std::string error;                   // why there is no verdict
};

/// MolProbity's, where its rules are in use and all pairs were asked about.
std::optional<double> clashscore_of(const Options& options, const Job& job, const Verdict& verdict, const Mode& mode) {
  const bool lists_all = mode.kind == Mode::Kind::all || mode.kind == Mode::Kind::within;
  if (options.check.thresholds.rules != "molprobity" || !lists_all || !options.between.empty() ||
      !options.inside.empty() || options.check.exempt_reference)
    return std::nullopt;
  const auto clashes =
      std::count_if(verdict.pairs.begin(), verdict.pairs.end(), [](const Contact& pair) { return pair.collides; });
  return clashscore(static_cast<std::size_t>(clashes), job.molecule->structure().atoms.size());
}

void print_table_row(const Job& job, const std::string& name, const Verdict& verdict, const Mode& mode,
                     const std::optional<double>& clashscore) {
  fmt::print("{}: {}", name, verdict.collides ? "collides" : "free");
  if (mode.kind == Mode::Kind::all) fmt::print(", {} pairs", verdict.pairs.size());
  if (mode.kind == Mode::Kind::within)
    fmt::print(", {} pairs closer than their threshold + {}", verdict.pairs.size(), mode.margin);
  if (clashscore) fmt::print(", clashscore {:.2f}", *clashscore);
  fmt::print("\n");
  for (const Contact& pair : verdict.pairs) fmt::print("{}\n", pair_line(job, pair));
  if (verdict.closest) fmt::print("{}  (closest)\n", pair_line(job, *verdict.closest));
}

}  // namespace

Exit run_check(const Options& options) {
  Options first = options;
  // A pipe is read but once; models of files that are joined are read with them.
  first.read.first_model = options.with.empty() && std::filesystem::is_regular_file(options.file);
  const Job job = load(first);
  const Mode mode = Mode::parse(options.mode, "angstrom");
  print_notes(job);
  if (!options.explain.empty()) {
    explain(options, job);
    return Exit::free;
  }
  const Structure& s = job.molecule->structure();
  const Frames frames(options.trajectories, options.file, s, options.read);
  const auto [begin, end] = shard_range(options.shard.value_or(Shard{}), frames.size());
  ConformationFile file(options, s, options.out.empty() ? 0 : frames.atom_count(), frames.is_single());

  Json head{{"tool", "biocd"}, {"command", "check"}, {"model", model_json(options, job)}, {"mode", mode.text()}};
  frames.describe(head);
  head["constant_contacts"] = constant_contacts_json(job);
  Results results(options, std::move(head), frames.size());
  if (options.output == Output::csv) print_constant_contacts(job);
  if (options.output == Output::table) fmt::print("{}", heading(options, job));

  Summary summary;
  hinge::tool::ProgressBar bar(end - begin);
  const auto judge = [&, begin = begin](Checker& checker, std::size_t n) {
    Checked checked;
    const auto k = static_cast<std::size_t>(begin) + n;
    const Trajectory& source = frames.file(k);
    try {
      std::vector<hinge::Vec3> whole = source.frame(frames.place(k).frame);
      if (file.wants_whole_frames()) checked.positions = whole;
      std::vector<hinge::Vec3> own = source.kept(std::move(whole));
      checked.verdict = checker.check_coordinates(own, mode);
      if (!file.takes(checked.verdict.collides))
        checked.positions = {};
      else if (!file.wants_whole_frames())
        checked.positions = std::move(own);
    } catch (const hinge::LoadError& error) {
      checked.error = error.what();
    }
    return checked;
  };
  const auto report = [&, begin = begin](std::size_t n, const Checked& checked) {
    if (!checked.error.empty()) throw hinge::LoadError(checked.error);
    const auto k = static_cast<std::size_t>(begin) + n;
    summary.add(s, checked.verdict);
    const std::optional<double> clashscore = clashscore_of(options, job, checked.verdict, mode);
    if (clashscore) summary.add_clashscore(*clashscore);
    if (options.output == Output::json) {
      Json row = verdict_json(job, k, checked.verdict, mode);
      frames.name(row, k);
      if (clashscore) row["clashscore"] = *clashscore;
      results.add(row);
    }
    if (options.output == Output::csv) results.add(csv_rows(job, k, checked.verdict));
    if (options.output == Output::table) print_table_row(job, frames.name(k), checked.verdict, mode, clashscore);
    file.add(checked.positions, static_cast<int>(k) + 1, checked.verdict.collides);
    bar.show(n + 1);
  };
  const auto finish = [&](const std::string& error) {
    results.finish(summary.json(false), error);
    if (options.output == Output::table)
      fmt::print("{} of {} {} collide\n", summary.colliding(), summary.checked(),
                 frames.are_models() ? "models" : "frames");
  };
  try {
    hinge::Ensemble(job.checker, options.threads)
        .run(static_cast<std::size_t>(end - begin), judge, report, results_at_once(s.atoms.size()));
  } catch (const hinge::LoadError& error) {
    // What was checked before counts, and is complete in itself.
    finish(error.what());
    file.finish();
    throw;
  } catch (const hinge::ModelError& error) {
    finish(error.what());  // a conformation that does not fit the file of --out, which is not left behind
    throw;
  }
  finish({});
  file.finish();
  return summary.colliding() > 0 ? Exit::collision : Exit::free;
}

}  // namespace biocd
