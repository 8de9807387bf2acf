// SPDX-License-Identifier: BSD-3-Clause
// biocd check: tests the coordinates of each model or frame of files; every admitted pair counts.
#include <fmt/format.h>

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "clash_table.hpp"
#include "conformation_file.hpp"
#include "frames.hpp"
#include "hinge/batch/ensemble.hpp"
#include "hinge/core/error.hpp"
#include "hinge/molecular/bond_gauge.hpp"
#include "hinge/molecular/severity.hpp"
#include "hinge_tools/counted.hpp"
#include "hinge_tools/max_pairs_option.hpp"
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

struct Checked {
  Verdict verdict;
  BondDeviation bond;
  std::string pairs{};                 // JSON; empty for other outputs, and for modes without a list
  std::vector<hinge::Vec3> positions;  // empty unless --out takes them
  std::string error;                   // not empty if there is no verdict
  std::shared_ptr<const Job> own{};    // for a model with other atoms than the first
  std::string difference{};            // how its atoms differ
};

/// Returns MolProbity's clashscore if its rules are in use and all pairs are listed, otherwise nothing.
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

/// headed: whether the next list of pairs starts with the names of its columns.
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

/// Checks a model with other atoms than the first, with a topology of its own.
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
  const Frames frames(options.trajectories, options.file, s, options.read);
  const auto [begin, end] = shard_range(options.shard.value_or(Shard{}), frames.size());
  ConformationFile file(options, s, options.out.empty() ? 0 : frames.atom_count(), frames.is_single());

  Json head{{"tool", "biocd"}, {"command", "check"}, {"model", model_json(options, job)}, {"mode", mode.text()}};
  frames.describe(head);
  head["constant_contacts"] = constant_contacts_json(job);
  Results results(options, std::move(head), frames.size(), ",bond_residual,closure_residual");
  if (options.output == Output::csv) print_constant_contacts(job);
  if (options.output == Output::table) fmt::print("{}", heading(options, job));

  std::optional<PairText> pair_text;
  if (options.output == Output::json && lists_pairs(mode)) pair_text.emplace(job);
  const BondGauge gauge(*job.molecule);
  const bool has_closures = !job.molecule->closure_atoms().empty();
  Summary summary(closure_names(job), false, options.output == Output::json);
  BondDeviation worst;  // over all bonds and conformations
  std::string worst_name;
  bool headed = true;  // the next list of pairs starts with the names of its columns
  ViewChoice choice;
  MoleculePage page(options, job, false, lists_pairs(mode));
  std::optional<ClashTable> clashes;
  if (options.by) clashes.emplace(*options.by);
  std::uint64_t left_out = 0;  // pairs that are not printed
  std::size_t others = 0;      // models with other atoms than the first
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
  const auto report = [&, begin = begin](std::size_t n, const Checked& checked) {
    if (!checked.error.empty()) throw hinge::LoadError(checked.error);
    const auto k = static_cast<std::size_t>(begin) + n;
    const Job& of = checked.own ? *checked.own : job;
    if (checked.own) {  // its pairs are not counted: their indices mean other atoms
      if (++others == 1)
        fmt::print(stderr, "note: {}; it is checked with its own atoms and bonds\n", checked.difference);
      Verdict counted = checked.verdict;
      counted.pairs.clear();
      summary.add(s, counted);
    } else {
      summary.add(s, checked.verdict);
    }
    if (clashes) clashes->add(of, checked.verdict);
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
      results.add(row, checked.pairs);
    }
    if (options.output == Output::csv)
      results.add(with_columns(csv_rows(of, k, checked.verdict, printed),
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
    bar.show(n + 1);
  };
  const auto finish = [&](const std::string& error) {
    if (others > 1)
      fmt::print(stderr, "note: {} other atoms than the first model; see `other_atoms` of --json\n",
                 counted(others - 1, "more model has", "more models have"));
    note_left_out(options, left_out);
    Json all = summary.json(has_closures);
    if (clashes) {
      all["by"] = word_of(*options.by);
      all["clashes"] = clashes->json();
    }
    results.finish(std::move(all), error);
    if (options.output != Output::table) return;
    if (clashes) fmt::print("{}", clashes->text(options.max_pairs.value_or(hinge::tool::usual_max_pairs)));
    if (worst.residual >= 0.0005)
      fmt::print("bond farthest from its length in the reference: {} - {}, {:.3f} angstrom against {:.3f} ({})\n",
                 label(s, worst.first), label(s, worst.second), worst.length, worst.reference, worst_name);
    print_closures(job, summary.worst_residuals());
    fmt::print("{}\n", hinge::tool::collide_text(summary.colliding(), summary.checked(),
                                                 frames.are_models() ? "model" : "frame"));
  };
  try {
    hinge::Ensemble(job.checker, options.threads)
        .run(static_cast<std::size_t>(end - begin), judge, report, results_at_once(s.atoms.size()));
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
