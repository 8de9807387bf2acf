// SPDX-License-Identifier: BSD-3-Clause
// biocd check: tests the coordinates of each model or frame of files; every admitted pair counts.
#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "checked.hpp"
#include "clash_table.hpp"
#include "conformation_file.hpp"
#include "frames.hpp"
#include "hinge/batch/ensemble.hpp"
#include "hinge/core/error.hpp"
#include "hinge/molecular/bond_gauge.hpp"
#include "hinge_tools/counted.hpp"
#include "hinge_tools/max_pairs_option.hpp"
#include "hinge_tools/parts.hpp"
#include "hinge_tools/progress_bar.hpp"
#include "molecule_page.hpp"
#include "options.hpp"
#include "pair_table.hpp"
#include "pair_text.hpp"
#include "report.hpp"
#include "results.hpp"
#include "summary.hpp"
#include "view.hpp"

namespace biocd {

namespace {

using namespace hinge::molecular;
using hinge::tool::counted;
using hinge::tool::Rows;

/// Counts over the conformations of a run or a unit.
struct Counts {
  Summary summary;
  std::optional<ClashTable> clashes;  // --by

  Json json(bool has_closures) const {
    Json all = summary.json(has_closures);
    if (clashes) clashes->add_to(all);
    return all;
  }
};

/// Writes the page of --report. mode: the pairs to list; others: models that were checked with atoms of their own.
void write_page(MoleculePage& page, const Job& job, const Frames& frames, const Mode& mode, std::size_t others,
                const Summary& summary) {
  if (!page.wanted()) return;
  Checker checker = job.checker;
  for (const std::uint64_t k : page.chosen()) {
    std::vector<hinge::Vec3> own = frames.file(k).kept(frames.file(k).frame(frames.place(k).frame));
    Verdict verdict = checker.check_coordinates(own, lists_pairs(mode) ? mode : Mode{Mode::Kind::all});
    page.add({k, frames.name(k), verdict.collides, std::move(own), std::move(verdict.pairs)});
  }
  const char* word = frames.are_models() ? "model" : "frame";
  page.words().frame_word = {word, std::string(word) + "s"};
  page.words().numbers_from = static_cast<unsigned>(std::max(0, frames.number(0)));
  if (others > 0)
    page.words().notes.push_back(counted(others, "model has", "models have") +
                                 " other atoms than the first model and is not shown");
  page.write(summary.colliding() > 0 ? "collides" : "free",
             hinge::tool::collide_text(summary.colliding(), summary.checked(), word));
}

}  // namespace

Exit run_check(const Options& options) {
  Options first = options;
  // A pipe can be read only once. Models of joined files are read with them.
  first.read.first_model = options.with.empty() && std::filesystem::is_regular_file(options.file);
  std::optional<Job> loaded(load(first));
  if (!options.out.empty() && options.trajectories.empty() && loaded->molecule->structure().more_models &&
      !have_same_atoms(options, loaded->molecule->structure())) {
    first.read.first_model = false;  // reads only the atoms that all models have
    loaded.emplace(load(first));
  }
  const Job& job = *loaded;
  const Mode mode = Mode::parse(options.mode, "angstrom");
  print_notes(job);
  print_left_out(options, job);
  if (!options.explain.empty()) {
    explain(options, job);
    return Exit::free;
  }
  const Structure& s = job.molecule->structure();
  ReadOptions frames_from = options.read;
  if (options.parts.wanted()) {  // all processes of the run share the places of the frames
    hinge::tool::PartsFolder(options.parts.folder).make();
    frames_from.index_folder = options.parts.folder;
  }
  const Frames frames(options.trajectories, options.file, s, frames_from);
  ConformationFile file(options, s, options.out.empty() ? 0 : frames.atom_count(), frames.is_single());

  Json head{{"tool", "biocd"}, {"command", "check"}, {"model", model_json(options, job)}, {"mode", mode.text()}};
  frames.describe(head);
  head["constant_contacts"] = constant_contacts_json(job);
  const hinge::tool::RowsHead rows_head = head_of_rows(options, head, ",bond_residual,closure_residual", frames.size());
  if (!options.parts.wanted()) hinge::tool::print(opening(rows_head));
  if (options.output == Output::csv) print_constant_contacts(job);
  if (options.output == Output::table) fmt::print("{}", heading(options, job));

  std::optional<PairText> pair_text;
  if (options.output == Output::json && lists_pairs(mode)) pair_text.emplace(job);
  const BondGauge gauge(*job.molecule);
  const bool has_closures = !job.molecule->closure_atoms().empty();
  BondDeviation worst;  // over all bonds and conformations
  std::string worst_name;
  bool headed = true;  // the next list of pairs starts with the names of its columns
  ViewChoice choice;
  MoleculePage page(options, job, false, lists_pairs(mode));
  std::uint64_t left_out = 0;  // pairs that are not printed
  std::size_t others = 0;      // models with other atoms than the first
  const auto judge = [&](Checker& checker, std::size_t k) {
    Checked checked;
    const Trajectory& source = frames.file(k);
    try {
      std::vector<hinge::Vec3> whole = source.frame(frames.place(k).frame);
      if (file.wants_whole_frames()) checked.positions = whole;
      std::vector<hinge::Vec3> own = source.kept(std::move(whole));
      checked.verdict = checker.check_coordinates(own, mode);
      if (pair_text) checked.pairs = pair_text->list(pairs_to_print(options, checked.verdict.pairs));
      checked.bond = gauge.worst_bond(own);
      checked.verdict.closure_residuals = gauge.closure_residuals(own);
      for (const double residual : checked.verdict.closure_residuals)
        checked.verdict.closure_residual = std::max(checked.verdict.closure_residual, residual);
      if (!file.takes(checked.verdict.collides))
        checked.positions = {};
      else if (!file.wants_whole_frames())
        checked.positions = std::move(own);
    } catch (const OtherAtoms& error) {
      if (!frames.are_models()) {
        checked.error = error.what();
        return checked;
      }
      checked = check_alone(options, frames.number(k), mode, error.what());
      checked.verdict.closure_residuals.assign(job.molecule->closure_atoms().size(), 0.0);
      if (pair_text) checked.pairs = PairText(*checked.own).list(pairs_to_print(options, checked.verdict.pairs));
    } catch (const hinge::LoadError& error) {
      checked.error = error.what();
    }
    return checked;
  };
  const auto report = [&](std::size_t k, const Checked& checked, Rows& rows, Counts& counts) {
    if (!checked.error.empty()) throw hinge::LoadError(checked.error);
    Summary& summary = counts.summary;
    if (options.output == Output::npy) rows.add_verdict(checked.verdict.collides ? 1 : 0);
    const Job& of = checked.own ? *checked.own : job;
    if (checked.own) {  // its pairs are not counted: their indices mean other atoms
      if (++others == 1)
        fmt::print(stderr, "note: {}; it is checked with its own atoms and bonds\n", checked.difference);
      Verdict without_pairs = checked.verdict;
      without_pairs.pairs.clear();
      summary.add(s, without_pairs);
    } else {
      summary.add(s, checked.verdict);
    }
    if (counts.clashes) counts.clashes->add(of, checked.verdict);
    const std::size_t printed = pairs_to_print(options, checked.verdict.pairs).size();
    left_out += checked.verdict.pairs.size() - printed;
    const std::optional<double> clashscore = clashscore_of(options, of, checked.verdict, mode);
    if (clashscore) summary.add_clashscore(*clashscore);
    if (options.output == Output::json) {
      Json row = verdict_json(of, k, checked.verdict, mode);
      add_left_out(row, options, checked.verdict.pairs, mode);
      frames.name(row, k);
      if (clashscore) row["clashscore"] = *clashscore;
      if (checked.own) row["other_atoms"] = checked.difference;
      row["worst_bond"] = bond_json(s, checked.bond);
      if (has_closures) row["closures"] = closures_json(job, checked.verdict.closure_residuals);
      rows.add_json(row_text(row, checked.pairs));
    }
    if (options.output == Output::csv)
      rows.add_csv(with_columns(csv_rows(of, k, checked.verdict, printed),
                                fmt::format(",{},{}", checked.bond.residual, checked.verdict.closure_residual)));
    if (options.output == Output::table)
      print_table_row(options, of, frames.name(k), checked, mode, clashscore, headed);
    if (checked.bond.residual > worst.residual) {
      worst = checked.bond;
      worst_name = frames.name(k);
    }
    if (!checked.own) {
      choice.offer(k, checked.verdict);
      page.offer(k, checked.verdict);
    }
    file.add(checked.positions, static_cast<int>(k) + 1, checked.verdict.collides);
  };
  hinge::Ensemble ensemble(job.checker, options.threads);
  const auto run = [&](std::uint64_t begin, std::uint64_t end, Rows& rows, Counts& counts) {
    const auto count = static_cast<std::size_t>(end - begin), from = static_cast<std::size_t>(begin);
    std::optional<hinge::tool::ProgressBar> bar;
    if (!options.parts.wanted()) bar.emplace(count);
    ensemble.run(
        count, [&](Checker& checker, std::size_t n) { return judge(checker, from + n); },
        [&](std::size_t n, const Checked& checked) {
          report(from + n, checked, rows, counts);
          if (bar) bar->show(n + 1);
        },
        results_at_once(s.atoms.size()));
  };
  const auto no_counts = [&] {
    return Counts{Summary(closure_names(job), false, options.output == Output::json),
                  options.by ? std::optional<ClashTable>(*options.by) : std::nullopt};
  };
  if (options.parts.wanted()) {
    run_units(options.parts, question_of(options, "check", rows_head, head),
              [&](std::uint64_t begin, std::uint64_t end, Rows& rows) {
                Counts counts = no_counts();
                run(begin, end, rows, counts);
                return counts_of(options, counts.summary, counts.json(has_closures));
              });
    return Exit::free;
  }
  Counts counts = no_counts();
  const Summary& summary = counts.summary;
  Rows rows = hinge::tool::printed_rows();
  const auto finish = [&](const std::string& error) {
    if (others > 1)
      fmt::print(stderr, "note: {} other atoms than the first model; see `other_atoms` of --json\n",
                 counted(others - 1, "more model has", "more models have"));
    note_left_out(options, left_out);
    print_summary(options, counts.json(has_closures), error);
    if (options.output != Output::table) return;
    if (counts.clashes)
      fmt::print("{}", counts.clashes->text(options.max_pairs.value_or(hinge::tool::usual_max_pairs)));
    if (worst.residual >= 0.0005)
      fmt::print("bond farthest from its length in the reference: {} - {}, {:.3f} angstrom against {:.3f} ({})\n",
                 label(s, worst.first), label(s, worst.second), worst.length, worst.reference, worst_name);
    print_closures(job, summary.worst_residuals());
    fmt::print("{}\n", hinge::tool::collide_text(summary.colliding(), summary.checked(),
                                                 frames.are_models() ? "model" : "frame"));
  };
  try {
    run(0, frames.size(), rows, counts);
    file.finish();
  } catch (const hinge::LoadError& error) {
    // The results of the conformations before the error stay valid and complete.
    finish(error.what());
    file.finish();
    throw;
  } catch (const hinge::ModelError& error) {
    finish(error.what());  // a conformation does not fit the format of --out; that file is not left behind
    throw;
  }
  finish({});
  if (options.view && choice.best()) {
    const std::size_t k = *choice.best();
    const std::vector<hinge::Vec3> own = frames.file(k).kept(frames.file(k).frame(frames.place(k).frame));
    Checker checker = job.checker;
    const bool same_atoms = !file.wants_whole_frames() || frames.atom_count() == s.atoms.size();
    write_view(options, job, {frames.name(k), own, checker.check_coordinates(own, Mode{Mode::Kind::all}).pairs},
               same_atoms && file.size() > 0);
  }
  write_page(page, job, frames, mode, others, summary);
  return summary.colliding() > 0 ? Exit::collision : Exit::free;
}

}  // namespace biocd
