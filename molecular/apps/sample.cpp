// SPDX-License-Identifier: BSD-3-Clause
// biocd sample: random conformations, checked in parallel, reported in index order.
#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cstdint>
#include <map>
#include <numbers>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "hinge/core/error.hpp"
#include "hinge/ensemble/ensemble.hpp"
#include "hinge/molecular/closed_sampler.hpp"
#include "hinge/molecular/sampler.hpp"
#include "hinge/molecular/write_structure.hpp"
#include "hinge/tool/complete_file.hpp"
#include "hinge/tool/progress_bar.hpp"
#include "options.hpp"
#include "report.hpp"
#include "scene.hpp"

namespace biocd {

namespace {

using namespace hinge::molecular;

struct Sample {
  Verdict verdict;
  std::vector<hinge::Vec3> positions;  // only when they are to be written
  bool found = true;                   // false: no start closed (or none was free, where that was asked for)
  std::uint64_t unclosed = 0, refused = 0;
  Placements placements{};
};

/// One per thread.
struct Worker {
  Checker checker;
  std::optional<ClosedSampler> closed;
};

Sample draw(Worker& worker, const Job& job, const Sampling& sampling, std::size_t k, const Mode& mode,
            bool collision_free) {
  if (!worker.closed) {
    const std::vector<double> q = sample_configuration(sampling, k, *job.molecule, job.selection, job.ranges);
    Sample sample{worker.checker.check(q, mode), {}};
    sample.placements = placements_of(job, q);
    return sample;
  }
  const auto accept = [&](std::span<const double> q) {
    return !collision_free || !worker.checker.check(q, Mode::parse("any")).collides;
  };
  const ClosedSample closed = worker.closed->sample(k, accept);
  Sample sample{{}, {}, closed.found(), closed.unclosed, closed.refused};
  if (closed.found()) sample.verdict = worker.checker.check(closed.q, mode);
  return sample;
}

struct Summary {
  std::uint64_t checked = 0;
  std::uint64_t colliding = 0;
  double worst_residual = 0.0;
  std::vector<double> worst_residuals;  // of each closure
  std::uint64_t missing = 0, unclosed = 0, refused = 0;
  std::map<std::pair<hinge::PrimitiveId, hinge::PrimitiveId>, std::uint64_t> offenders;

  void add(const Sample& sample) {
    unclosed += sample.unclosed;
    refused += sample.refused;
    if (!sample.found) {
      ++missing;
      return;
    }
    const Verdict& verdict = sample.verdict;
    ++checked;
    colliding += verdict.collides ? 1 : 0;
    worst_residual = std::max(worst_residual, verdict.closure_residual);
    worst_residuals.resize(verdict.closure_residuals.size());
    for (std::size_t k = 0; k < worst_residuals.size(); ++k)
      worst_residuals[k] = std::max(worst_residuals[k], verdict.closure_residuals[k]);
    for (const Contact& pair : verdict.pairs)
      if (pair.collides) ++offenders[{pair.hit.first, pair.hit.second}];
  }

  /// The pairs that collide most often, most frequent first.
  std::vector<std::pair<std::pair<hinge::PrimitiveId, hinge::PrimitiveId>, std::uint64_t>> top(std::size_t n) const {
    std::vector<std::pair<std::pair<hinge::PrimitiveId, hinge::PrimitiveId>, std::uint64_t>> all(offenders.begin(),
                                                                                                 offenders.end());
    std::stable_sort(all.begin(), all.end(), [](const auto& a, const auto& b) { return a.second > b.second; });
    all.resize(std::min(n, all.size()));
    return all;
  }
};

void print_json_end(const Job& job, const Summary& summary, bool closed) {
  const Structure& s = job.molecule->structure();
  Json offenders = Json::array();
  for (const auto& [pair, count] : summary.top(10)) {
    const auto i = static_cast<std::uint32_t>(hinge::index(pair.first));
    const auto j = static_cast<std::uint32_t>(hinge::index(pair.second));
    offenders.push_back({{"i", i}, {"j", j}, {"label_i", label(s, i)}, {"label_j", label(s, j)}, {"count", count}});
  }
  Json end{{"checked", summary.checked},
           {"colliding", summary.colliding},
           {"worst_closure_residual", summary.worst_residual},
           {"closures", closures_json(job, summary.worst_residuals)},
           {"offenders", offenders}};
  if (closed) {
    end["missing"] = summary.missing;
    end["starts_unclosed"] = summary.unclosed;
    end["closed_refused"] = summary.refused;
  }
  fmt::print("\n],\n\"summary\": {}}}\n", end.dump());
}

void print_table(const Job& job, const Summary& summary, bool closed, double seconds) {
  const Structure& s = job.molecule->structure();
  const auto share = [](std::uint64_t part, std::uint64_t all) {
    return all == 0 ? 0.0 : 100.0 * static_cast<double>(part) / static_cast<double>(all);
  };
  fmt::print("{} of {} conformations collide ({:.2f} %), {:.0f} conformations per second\n", summary.colliding,
             summary.checked, share(summary.colliding, summary.checked),
             static_cast<double>(summary.checked) / seconds);
  if (closed) {
    const std::uint64_t starts = summary.checked + summary.refused + summary.unclosed;
    fmt::print(
        "starts: {}, of which {} closed ({:.2f} %), {} of those refused because they collide; samples missing: {}\n",
        starts, starts - summary.unclosed, share(starts - summary.unclosed, starts), summary.refused, summary.missing);
  } else if (summary.worst_residual > 0.0) {
    fmt::print("closures: sampled freely, so cycles open (--closures keep keeps them closed)\n");
  }
  for (std::size_t k = 0; k < summary.worst_residuals.size(); ++k)
    fmt::print("  closure {:<34} worst residual {:.3g} angstrom\n", job.molecule->model().tree().closures()[k].name,
               summary.worst_residuals[k]);
  for (const auto& [pair, count] : summary.top(10))
    fmt::print("  {:<18} {:<18} {:8}\n", label(s, static_cast<std::uint32_t>(hinge::index(pair.first))),
               label(s, static_cast<std::uint32_t>(hinge::index(pair.second))), count);
}

}  // namespace

Exit run_sample(const Options& options) {
  const Job job = load(options);
  const Mode mode = Mode::parse(options.mode, "angstrom");
  print_notes(job);
  if (!options.explain.empty()) {
    explain(options, job);
    return Exit::free;
  }
  if (options.count == 0) throw hinge::ModelError("-n 0: expected at least one conformation");
  Sampling sampling{options.seed, {}};
  if (options.sigma_degrees) sampling.sigma = *options.sigma_degrees * std::numbers::pi / 180.0;
  const bool closed = options.keep_closures || !options.loop.empty();
  if (options.collision_free && !closed)
    throw hinge::ModelError("--collision-free: expected --loop or --closures keep beside it");
  const Structure& s = job.molecule->structure();
  hinge::tool::CompleteFile file(options.out);

  if (options.output == Output::json) {
    Json head{{"tool", "biocd"}, {"command", "sample"}, {"model", model_json(options, job)}, {"mode", mode.text()}};
    head["seed"] = options.seed;
    head["sigma_degrees"] = options.sigma_degrees ? Json(*options.sigma_degrees) : Json();
    head["constant_contacts"] = constant_contacts_json(job);
    std::string text = head.dump(1);
    text.resize(text.rfind('\n'));  // the closing brace comes with the summary
    fmt::print("{},\n\"conformations\": [", text);
  }
  if (options.output == Output::csv) {
    print_constant_contacts(job);
    fmt::print("{}", csv_header(placements_header(job)));
  }
  if (options.output == Output::table) fmt::print("{}", heading(options, job));

  Summary summary;
  hinge::tool::ProgressBar bar(options.count);
  const auto start = std::chrono::steady_clock::now();
  Worker worker{job.checker, {}};
  if (closed) worker.closed.emplace(*job.molecule, job.selection, sampling, options.most_tries);
  const auto judge = [&](Worker& mine, std::size_t k) {
    Sample sample = draw(mine, job, sampling, k, mode, options.collision_free);
    if (file.wanted() && sample.found) sample.positions = mine.checker.positions();
    return sample;
  };
  const auto report = [&](std::size_t k, const Sample& sample) {
    bar.show(k + 1);
    summary.add(sample);
    if (!sample.found) return;
    if (options.output == Output::json) {
      Json row = verdict_json(s, k, sample.verdict, mode);
      if (!sample.verdict.closure_residuals.empty())
        row["closures"] = closures_json(job, sample.verdict.closure_residuals);
      if (!sample.placements.empty()) row["placements"] = placements_json(job, sample.placements);
      fmt::print("{}\n{}", summary.checked == 1 ? "" : ",", row.dump());
    }
    if (options.output == Output::csv)
      fmt::print("{}", with_placements(csv_rows(s, k, sample.verdict), sample.placements));
    if (file.wanted()) write_pdb_model(file.stream(), s, sample.positions, static_cast<int>(k) + 1);
  };
  hinge::Ensemble(worker, options.threads).run(static_cast<std::size_t>(options.count), judge, report);
  const std::chrono::duration<double> checking = std::chrono::steady_clock::now() - start;
  if (file.wanted()) file.stream() << "END\n";
  file.finish();
  if (options.output == Output::json) print_json_end(job, summary, closed);
  if (options.output == Output::table) print_table(job, summary, closed, checking.count());
  if (summary.missing > 0)
    fmt::print(stderr, "{} of {} samples are missing: none of {} starts closed{}\n", summary.missing, options.count,
               options.most_tries, options.collision_free ? " without a collision" : "");
  if (summary.checked == 0) return Exit::usage;
  return summary.colliding > 0 ? Exit::collision : Exit::free;
}

}  // namespace biocd
