// SPDX-License-Identifier: BSD-3-Clause
// biocd sample: random conformations, checked in parallel, reported in index order.
#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cstdint>
#include <map>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

#include "hinge/core/error.hpp"
#include "hinge/ensemble/ensemble.hpp"
#include "hinge/molecular/sampler.hpp"
#include "hinge/molecular/write_structure.hpp"
#include "hinge/tool/complete_file.hpp"
#include "hinge/tool/progress_bar.hpp"
#include "options.hpp"
#include "report.hpp"

namespace biocd {

namespace {

using namespace hinge::molecular;

struct Sample {
  Verdict verdict;
  std::vector<hinge::Vec3> positions;  // only when they are to be written
};

struct Summary {
  std::uint64_t checked = 0;
  std::uint64_t colliding = 0;
  double worst_residual = 0.0;
  std::map<std::pair<hinge::PrimitiveId, hinge::PrimitiveId>, std::uint64_t> offenders;

  void add(const Verdict& verdict) {
    ++checked;
    colliding += verdict.collides ? 1 : 0;
    worst_residual = std::max(worst_residual, verdict.closure_residual);
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

void print_json_end(const Structure& s, const Summary& summary) {
  Json offenders = Json::array();
  for (const auto& [pair, count] : summary.top(10)) {
    const auto i = static_cast<std::uint32_t>(hinge::index(pair.first));
    const auto j = static_cast<std::uint32_t>(hinge::index(pair.second));
    offenders.push_back({{"i", i}, {"j", j}, {"label_i", label(s, i)}, {"label_j", label(s, j)}, {"count", count}});
  }
  Json end{{"checked", summary.checked},
           {"colliding", summary.colliding},
           {"worst_closure_residual", summary.worst_residual},
           {"offenders", offenders}};
  fmt::print("\n],\n\"summary\": {}}}\n", end.dump());
}

void print_table(const Structure& s, const Summary& summary, double seconds) {
  fmt::print("{} of {} conformations collide ({:.2f} %), {:.0f} conformations per second\n", summary.colliding,
             summary.checked, 100.0 * static_cast<double>(summary.colliding) / static_cast<double>(summary.checked),
             static_cast<double>(summary.checked) / seconds);
  if (summary.worst_residual > 0.0)
    fmt::print("closures: sampled freely, so cycles open; the worst residual is {:.3f} angstrom\n",
               summary.worst_residual);
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
    fmt::print("{}", csv_header());
  }
  if (options.output == Output::table) fmt::print("{}", heading(options, job));

  Summary summary;
  hinge::tool::ProgressBar bar(options.count);
  const auto start = std::chrono::steady_clock::now();
  const auto judge = [&](Checker& checker, std::size_t k) {
    Sample sample{checker.check(sample_configuration(sampling, k, checker.dof_count()), mode), {}};
    if (file.wanted()) sample.positions = checker.positions();
    return sample;
  };
  const auto report = [&](std::size_t k, const Sample& sample) {
    summary.add(sample.verdict);
    if (options.output == Output::json)
      fmt::print("{}\n{}", k == 0 ? "" : ",", verdict_json(s, k, sample.verdict, mode).dump());
    if (options.output == Output::csv) fmt::print("{}", csv_rows(s, k, sample.verdict));
    if (file.wanted()) write_pdb_model(file.stream(), s, sample.positions, static_cast<int>(k) + 1);
    bar.show(k + 1);
  };
  hinge::Ensemble(job.checker, options.threads).run(static_cast<std::size_t>(options.count), judge, report);
  const std::chrono::duration<double> checking = std::chrono::steady_clock::now() - start;
  if (file.wanted()) file.stream() << "END\n";
  file.finish();
  if (options.output == Output::json) print_json_end(s, summary);
  if (options.output == Output::table) print_table(s, summary, checking.count());
  return summary.colliding > 0 ? Exit::collision : Exit::free;
}

}  // namespace biocd
