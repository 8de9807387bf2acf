// SPDX-License-Identifier: BSD-3-Clause
// biocd sample: draws random conformations, checks them in parallel, and reports them in index order.
#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "conformation_file.hpp"
#include "hinge/batch/ensemble.hpp"
#include "hinge/core/error.hpp"
#include "hinge/molecular/closed_sampler.hpp"
#include "hinge/molecular/free_sampler.hpp"
#include "hinge/molecular/sampler.hpp"
#include "hinge_tools/counted.hpp"
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

struct Sample {
  Verdict verdict;
  std::vector<hinge::Vec3> positions;  // empty unless --out takes them
  bool found = true;                   // false: no start closed, or none gave a free conformation
  bool stopped = false;                // the time was over
  std::uint64_t unclosed = 0, refused = 0;
  std::vector<hinge::Hit> blockers{};  // see FreeSample
  Placements placements{};
  std::string pairs{};             // JSON; empty for other outputs, and for modes without a list
  std::vector<double> torsions{};  // values of the selected DOF, as torsion_values gives them
};

/// State of one thread.
struct Worker {
  Checker checker;
  std::optional<ClosedSampler> closed;
  std::optional<FreeSampler> free;
};

/// Sets the outputs that depend on q only.
void describe(Sample& sample, const Job& job, const std::vector<double>& q) {
  sample.placements = placements_of(job, q);
  sample.torsions = torsion_values(job, q);
}

Sample draw(Worker& worker, const Job& job, const Sampling& sampling, std::uint64_t k, const Mode& mode,
            const std::function<bool()>& stop = {}) {
  std::vector<double> q;
  Sample sample;
  if (worker.free) {
    FreeSample found = worker.free->sample(k, stop);
    sample.found = found.found();
    q = std::move(found.q);
    sample.unclosed = found.unclosed;
    sample.refused = found.dead_ends;
    sample.blockers = std::move(found.blockers);
    sample.stopped = found.stopped;
  } else if (worker.closed) {
    ClosedSample closed = worker.closed->sample(k);
    sample.found = closed.found();
    q = std::move(closed.q);
    sample.unclosed = closed.unclosed;
  } else {
    q = sample_configuration(sampling, k, *job.molecule, job.checker.selection(), job.ranges);
  }
  if (!sample.found) return sample;
  describe(sample, job, q);
  sample.verdict = worker.checker.check(q, mode);
  return sample;
}

/// Conformations that one call of check_batch() tests.
constexpr std::size_t block_size = 16;

/// Draws conformations first .. last - 1 and tests them together. takes(collides): positions are wanted.
template <class Takes>
std::vector<Sample> draw_block(Worker& worker, const Job& job, const Sampling& sampling, std::uint64_t first,
                               std::uint64_t last, const Takes& takes) {
  std::vector<Sample> samples;
  samples.reserve(static_cast<std::size_t>(last - first));
  std::vector<double> all;
  all.reserve(samples.capacity() * job.checker.dof_count());
  for (std::uint64_t k = first; k < last; ++k) {
    const std::vector<double> q = sample_configuration(sampling, k, *job.molecule, job.checker.selection(), job.ranges);
    all.insert(all.end(), q.begin(), q.end());
    describe(samples.emplace_back(), job, q);
  }
  const std::vector<std::uint8_t> verdicts = worker.checker.check_batch(all);
  for (std::size_t k = 0; k < verdicts.size(); ++k) {
    samples[k].verdict.collides = verdicts[k] != 0;
    if (!takes(verdicts[k] != 0)) continue;
    const std::size_t dof = all.size() / verdicts.size();
    worker.checker.check(std::span(all).subspan(k * dof, dof), Mode::parse("any"));
    samples[k].positions = worker.checker.positions();
  }
  return samples;
}

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
  const std::vector<Offender> offenders = summary.top();
  if (!offenders.empty()) fmt::print("  {:<18} {:<18} conformations\n", "atom 1", "atom 2");
  for (const Offender& o : offenders) fmt::print("  {:<18} {:<18} {:13}\n", o.label_i, o.label_j, o.count);
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
  const auto [begin, end] = shard_range(options.shard.value_or(Shard{}), options.count);
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
  Results results(options, std::move(head), options.count,
                  placements_header(job) + (options.torsions ? torsion_names(job) : ""));
  if (options.output == Output::csv) print_constant_contacts(job);
  if (options.output == Output::table) fmt::print("{}", heading(options, job));

  std::optional<PairText> pair_text;
  if (options.output == Output::json && lists_pairs(mode)) pair_text.emplace(job);
  Summary summary(closure_names(job), closed, options.output != Output::csv);
  hinge::tool::ProgressBar bar(end - begin);
  const auto start = std::chrono::steady_clock::now();
  const auto out_of_time = [&] {
    return options.seconds &&
           std::chrono::steady_clock::now() - start >= std::chrono::duration<double>(*options.seconds);
  };
  Worker worker{job.checker, {}, {}};
  Shortfall shortfall(s);
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
  const auto judge = [&, begin = begin](Worker& mine, std::size_t n) {
    Sample sample = draw(mine, job, sampling, begin + n, mode, out_of_time);
    if (sample.found && file.takes(sample.verdict.collides)) sample.positions = mine.checker.positions();
    if (sample.found && pair_text) sample.pairs = pair_text->list(pairs_to_print(options, sample.verdict.pairs));
    return sample;
  };
  const auto report = [&, begin = begin](std::size_t n, const Sample& sample) {
    const std::uint64_t k = begin + n;
    bar.show(n + 1);
    if (closed) summary.add(Starts{sample.found ? 0U : 1U, sample.unclosed, sample.refused});
    if (!sample.found) return shortfall.add(sample.blockers, sample.stopped);
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
      results.add(row, sample.pairs);
    }
    if (options.output == Output::csv) {
      const std::string rows = with_placements(csv_rows(job, k, sample.verdict, printed), sample.placements);
      results.add(options.torsions ? with_columns(rows, torsion_columns(sample.torsions)) : rows);
    }
    torsions.add(sample.torsions);
    file.add(sample.positions, static_cast<int>(k) + 1, sample.verdict.collides);
  };
  // check_batch() answers yes or no only, and does not measure closures.
  const bool in_blocks =
      mode.kind == Mode::Kind::any && !closed && closure_names(job).empty() && job.checker.dof_count() > 0;
  const auto count = static_cast<std::size_t>(end - begin);
  try {
    hinge::Ensemble ensemble(worker, options.threads);
    if (in_blocks)
      ensemble.run((count + block_size - 1) / block_size,
                   [&, begin = begin, end = end](Worker& mine, std::size_t b) {
                     const std::uint64_t first = begin + b * block_size;
                     return draw_block(mine, job, sampling, first, std::min<std::uint64_t>(first + block_size, end),
                                       [&](bool collides) { return file.takes(collides); });
                   },
                   [&](std::size_t b, const std::vector<Sample>& samples) {
                     for (std::size_t k = 0; k < samples.size(); ++k) report(b * block_size + k, samples[k]);
                   },
                   std::max<std::size_t>(1, results_at_once(s.atoms.size()) / block_size));
    else
      ensemble.run(count, judge, report, results_at_once(s.atoms.size()));
    file.finish();
    torsions.finish();
  } catch (const hinge::Error& error) {  // for example a full disk
    results.finish(summary.json(true), error.what());
    throw;
  }
  const std::chrono::duration<double> checking = std::chrono::steady_clock::now() - start;
  results.finish(summary.json(true));
  note_left_out(options, left_out);
  if (options.output == Output::table) print_table(job, summary, options.collision_free, checking.count());
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
  shortfall.print(options.collision_free, end - begin, most_starts);
  return exit_of(summary);
}

}  // namespace biocd
