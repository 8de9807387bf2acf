// SPDX-License-Identifier: BSD-3-Clause
// biocd sample: draws random conformations, checks them in parallel, and reports them in index order.
#include <fmt/format.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <limits>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "conformation_file.hpp"
#include "draw.hpp"
#include "hinge/batch/ensemble.hpp"
#include "hinge/core/error.hpp"
#include "hinge/molecular/sampler.hpp"
#include "hinge_tools/clock.hpp"
#include "hinge_tools/counted.hpp"
#include "hinge_tools/parts.hpp"
#include "hinge_tools/progress_bar.hpp"
#include "molecule_page.hpp"
#include "options.hpp"
#include "pair_table.hpp"
#include "pair_text.hpp"
#include "report.hpp"
#include "results.hpp"
#include "scene.hpp"
#include "shortfall.hpp"
#include "summary.hpp"
#include "torsion_columns.hpp"
#include "view.hpp"

namespace biocd {

namespace {

using namespace hinge::molecular;
using hinge::tool::Rows;

void print_table(const Job& job, const Summary& summary, bool collision_free, double seconds) {
  const auto share = [](std::uint64_t part, std::uint64_t all) {
    return all == 0 ? 0.0 : 100.0 * static_cast<double>(part) / static_cast<double>(all);
  };
  const double rate = static_cast<double>(summary.checked()) / seconds;
  if (collision_free)
    fmt::print("{} of {} found, all free, {:.1f} per second\n", summary.checked(),
               hinge::tool::counted(summary.checked() + summary.starts()->missing, "conformation"), rate);
  else
    fmt::print("{} ({:.2f} %), {:.0f} conformations per second\n",
               hinge::tool::collide_text(summary.colliding(), summary.checked(), "conformation"),
               share(summary.colliding(), summary.checked()), rate);
  if (const auto& starts = summary.starts()) {
    const std::uint64_t all = summary.checked() + starts->refused + starts->unclosed;
    fmt::print("starts: {}; closed: {} ({:.2f} %); ended by a collision: {}; samples missing: {}\n", all,
               all - starts->unclosed, share(all - starts->unclosed, all), starts->refused, starts->missing);
  } else if (summary.worst_residual() > 0.0) {
    fmt::print("closures: not solved, so cycles open (--closures keep closes them)\n");
  }
  print_closures(job, summary.worst_residuals());
  const std::vector<PairCount> offenders = summary.top();
  if (!offenders.empty()) fmt::print("  {:<18} {:<18} conformations\n", "atom 1", "atom 2");
  for (const PairCount& o : offenders) fmt::print("  {:<18} {:<18} {:13}\n", o.label_i, o.label_j, o.count);
  if (summary.count_error() > 0)
    fmt::print("  counts of pairs may be too low by up to {}: there were too many different pairs\n",
               summary.count_error());
}

}  // namespace

Exit run_sample(const Options& options) {
  const Job job = load(options);
  const Mode mode = Mode::parse(options.mode, "angstrom");
  print_notes(job);
  print_left_out(options, job);
  if (!options.explain.empty()) {
    explain(options, job);
    return Exit::free;
  }
  const Sampling sampling = sampling_of(options);
  const bool closed = !job.kept.closures.empty() || options.collision_free;
  const bool statistics = options.prior ? *options.prior == Prior::ramachandran : !options.sigma_degrees;
  const std::uint64_t most_starts = options.most_tries.value_or(options.collision_free ? 1000 : 100);
  const Structure& s = job.molecule->structure();
  ConformationFile file(options, s, s.atoms.size(), false);

  TorsionFile torsions(options.torsions_out, job.checker.dof_count());
  if (options.torsions && options.output == Output::table)
    throw hinge::ModelError("--torsions: expected --json or --csv in addition, or --torsions-out FILE.npy instead");

  Json head{{"tool", "biocd"}, {"command", "sample"}, {"model", model_json(options, job)}, {"mode", mode.text()}};
  head["seed"] = options.seed;
  head["sigma_degrees"] = options.sigma_degrees ? Json(*options.sigma_degrees) : Json();
  if (options.collision_free)
    head["prior"] = statistics ? "ramachandran" : options.sigma_degrees ? "gaussian" : "uniform";
  if (options.torsions) head["dofs"] = dofs_json(job);
  head["constant_contacts"] = constant_contacts_json(job);
  const hinge::tool::RowsHead rows_head =
      head_of_rows(options, head, placements_header(job) + (options.torsions ? torsion_names(job) : ""), options.count);
  if (!options.parts.wanted()) hinge::tool::print(opening(rows_head));
  if (options.output == Output::csv) print_constant_contacts(job);
  if (options.output == Output::table) fmt::print("{}", heading(options, job));

  std::optional<PairText> pair_text;
  if (options.output == Output::json && lists_pairs(mode)) pair_text.emplace(job);
  const auto start = hinge::tool::Clock::now();
  const hinge::tool::TimeLimit out_of_time(options.seconds);
  Worker worker{job.checker, {}, {}, options.torsions || !options.torsions_out.empty()};
  ViewChoice choice;
  MoleculePage page(options, job, false, lists_pairs(mode));
  std::uint64_t left_out = 0;  // pairs that are not printed
  if (options.collision_free) {
    const FreeSampling how{.sampling = sampling,
                           .prior = statistics ? Prior::ramachandran : Prior::independent,
                           .most_starts = most_starts};
    worker.free.emplace(job.checker, how, job.kept.closures, job.ranges);
  } else if (closed) {
    worker.closed.emplace(*job.molecule, job.checker.selection(), sampling, most_starts, job.kept.closures, job.ranges);
  }
  // check_batch() answers yes or no only, and does not measure closures.
  const bool in_blocks =
      mode.kind == Mode::Kind::any && !closed && closure_names(job).empty() && job.checker.dof_count() > 0;
  hinge::Ensemble ensemble(worker, options.threads);
  const auto judge = [&](Worker& mine, std::uint64_t k) {
    Sample sample = draw(mine, job, sampling, k, mode, out_of_time);
    if (sample.found && file.takes(sample.verdict.collides)) sample.positions = mine.checker.positions();
    if (sample.found && pair_text) sample.pairs = pair_text->list(pairs_to_print(options, sample.verdict.pairs));
    return sample;
  };
  const auto report = [&](std::uint64_t k, const Sample& sample, Rows& rows, Summary& summary, Shortfall& shortfall) {
    if (options.output == Output::npy) rows.add_verdict(!sample.found ? 2 : sample.verdict.collides ? 1 : 0);
    if (closed) summary.add(Starts{sample.found ? 0U : 1U, sample.unclosed, sample.refused});
    if (!sample.found) return shortfall.add(s, sample.blockers, sample.stopped);
    summary.add(s, sample.verdict);
    choice.offer(k, sample.verdict);
    page.offer(k, sample.verdict);
    const std::size_t printed = pairs_to_print(options, sample.verdict.pairs).size();
    left_out += sample.verdict.pairs.size() - printed;
    if (options.output == Output::json) {
      Json row = verdict_json(job, k, sample.verdict, mode);
      add_left_out(row, options, sample.verdict.pairs, mode);
      if (!sample.verdict.closure_residuals.empty())
        row["closures"] = closures_json(job, sample.verdict.closure_residuals);
      if (options.collision_free) row["starts"] = sample.unclosed + sample.refused + 1;
      if (!sample.placements.empty()) row["placements"] = placements_json(job, sample.placements);
      if (options.torsions) row["torsions"] = sample.torsions;
      rows.add_json(row_text(row, sample.pairs));
    }
    if (options.output == Output::csv) {
      const std::string text = with_placements(csv_rows(job, k, sample.verdict, printed), sample.placements);
      rows.add_csv(options.torsions ? with_columns(text, torsion_columns(sample.torsions)) : text);
    }
    torsions.add(sample.torsions);
    file.add(sample.positions, static_cast<int>(k) + 1, sample.verdict.collides);
  };
  const auto run = [&](std::uint64_t begin, std::uint64_t end, Rows& rows, Summary& summary, Shortfall& shortfall) {
    const auto count = static_cast<std::size_t>(end - begin);
    std::optional<hinge::tool::ProgressBar> bar;
    if (!options.parts.wanted()) bar.emplace(count);
    const auto take = [&](std::size_t n, const Sample& sample) {
      report(begin + n, sample, rows, summary, shortfall);
      if (bar) bar->show(n + 1);
    };
    if (in_blocks)
      ensemble.run((count + block_size - 1) / block_size,
                   [&](Worker& mine, std::size_t b) {
                     const std::uint64_t first = begin + b * block_size;
                     return draw_block(mine, job, sampling, first, std::min<std::uint64_t>(first + block_size, end),
                                       [&](bool collides) { return file.takes(collides); });
                   },
                   [&](std::size_t b, const std::vector<Sample>& samples) {
                     for (std::size_t k = 0; k < samples.size(); ++k) take(b * block_size + k, samples[k]);
                   },
                   std::max<std::size_t>(1, results_at_once(s.atoms.size()) / block_size));
    else
      ensemble.run(
          count, [&](Worker& mine, std::size_t n) { return judge(mine, begin + n); }, take,
          results_at_once(s.atoms.size()));
  };
  const auto counts = [&] {
    return Summary(closure_names(job), closed, options.output == Output::table || options.output == Output::json);
  };
  if (options.parts.wanted()) {
    run_units(options.parts, question_of(options, "sample", rows_head, head),
              [&](std::uint64_t begin, std::uint64_t end, Rows& rows) {
                Summary summary = counts();
                Shortfall shortfall;
                run(begin, end, rows, summary, shortfall);
                Json all = summary.json(true);
                shortfall.add_to(all, std::numeric_limits<std::size_t>::max());
                return counts_of(options, summary, all);
              });
    return Exit::free;
  }
  Summary summary = counts();
  Shortfall shortfall;
  Rows rows = hinge::tool::printed_rows();
  try {
    run(0, options.count, rows, summary, shortfall);
    file.finish();
    torsions.finish();
  } catch (const hinge::Error& error) {  // for example a full disk
    print_summary(options, summary.json(true), error.what());
    throw;
  }
  const double checking = hinge::tool::seconds_since(start);
  Json total = summary.json(true);
  shortfall.add_to(total, most_in_the_way);
  print_summary(options, std::move(total));
  note_left_out(options, left_out);
  if (options.output == Output::table) print_table(job, summary, options.collision_free, checking);
  if (options.view && choice.best()) {
    const Sample shown = draw(worker, job, sampling, *choice.best(), Mode{Mode::Kind::all});
    write_view(options, job,
               {fmt::format("conformation {}", *choice.best()), worker.checker.positions(), shown.verdict.pairs},
               file.size() > 0);
  }
  for (const std::uint64_t k : page.chosen()) {
    Sample shown = draw(worker, job, sampling, k, lists_pairs(mode) ? mode : Mode{Mode::Kind::all});
    page.add({k, fmt::format("conformation {}", k), shown.verdict.collides, worker.checker.positions(),
              std::move(shown.verdict.pairs)});
  }
  page.write(summary.colliding() > 0 ? "collides" : "free",
             hinge::tool::collide_text(summary.colliding(), summary.checked(), "conformation"));
  shortfall.print(options.collision_free, options.count, most_starts);
  return exit_of(summary);
}

}  // namespace biocd
