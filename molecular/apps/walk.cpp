// SPDX-License-Identifier: BSD-3-Clause
// biocd walk: runs a Monte Carlo walk of collision-free moves from the file's conformation.
#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <stdexcept>
#include <string>
#include <vector>

#include "conformation_file.hpp"
#include "hinge/core/error.hpp"
#include "hinge/molecular/walker.hpp"
#include "hinge_tools/clock.hpp"
#include "hinge_tools/counted.hpp"
#include "hinge_tools/json_text.hpp"
#include "hinge_tools/progress_bar.hpp"
#include "molecule_page.hpp"
#include "options.hpp"
#include "report.hpp"
#include "view.hpp"

namespace biocd {

namespace {

using namespace hinge::molecular;
using hinge::tool::counted;

void check_options(const Options& options, const Job& job) {
  if (options.check.engine != "simd")
    throw hinge::ModelError("walk: engine '" + options.check.engine + "': expected simd, the only engine for moves");
  if (!options.place.empty())
    throw hinge::ModelError("--place: a walk changes only torsions, expected no placed parts");
  const std::size_t dof = job.checker.dof_count();
  require_free_torsions(options, job);
  if (options.changes > dof)
    throw hinge::ModelError(
        fmt::format("--changes {}: expected at most {}, the number of free torsions", options.changes, dof));
}

void check_start(const Options& options, const Structure& s, Walker& walker) {
  const std::vector<hinge::Hit> hits = walker.collisions();
  if (hits.empty()) return;
  const auto name = [&](hinge::PrimitiveId i) { return label(s, static_cast<std::uint32_t>(hinge::index(i))); };
  throw hinge::LoadError(
      fmt::format("{}: collides in {}, first {} and {}; expected a start without collisions "
                  "(--exempt-reference exempts these pairs)",
                  options.file, counted(hits.size(), "pair"), name(hits.front().first), name(hits.front().second)));
}

}  // namespace

Exit run_walk(const Options& options) {
  Job job = load(options);
  print_notes(job);
  if (!options.explain.empty()) {
    explain(options, job);
    return Exit::free;
  }
  check_options(options, job);
  const Structure& s = job.molecule->structure();
  Walker walker(job.checker, {.closures = job.kept.closures,
                              .changes = options.changes,
                              .sigma = options.step_degrees * degree,
                              .seed = options.seed});
  check_start(options, s, walker);
  if (options.output == Output::table) fmt::print("{}", heading(options, job));

  ConformationFile file(options, s, s.atoms.size(), false);
  hinge::tool::ProgressBar bar(options.steps);
  MoleculePage page(options, job, true);
  const std::uint64_t shown_every = std::max<std::uint64_t>(1, options.steps / 100);
  const auto start = hinge::tool::Clock::now();
  for (std::uint64_t step = 0; step < options.steps; ++step) {
    walker.step();
    if (file.wanted() && (step + 1) % options.every == 0)
      file.add(walker.positions(), static_cast<int>(file.size()) + 1, false);
    if (page.wanted() && (step + 1) % shown_every == 0)
      page.add_next({step + 1, fmt::format("after step {}", step + 1), false, walker.positions(), {}});
    bar.show(step + 1);
  }
  const double walking = hinge::tool::seconds_since(start);
  file.finish();

  // Checks the final conformation by a query that is independent of the moves.
  const Verdict end = job.checker.check(walker.configuration(), Mode::parse("any", "angstrom"));
  if (end.collides) throw std::logic_error("the walk ended in a collision that no move reported");
  const WalkCounts counts = walker.counts();
  const std::uint64_t rejected = options.steps - counts.accepted;
  if (options.output == Output::json) {
    Json json{{"tool", "biocd"}, {"command", "walk"}, {"model", model_json(options, job)}, {"seed", options.seed}};
    json["step_degrees"] = options.step_degrees;
    json["changes"] = options.changes;
    json["constant_contacts"] = constant_contacts_json(job);
    json["summary"] = {{"steps", options.steps},
                       {"accepted", counts.accepted},
                       {"rejected", rejected},
                       {"unclosed", counts.unclosed},
                       {"frames", file.size()},
                       {"full_queries", counts.full_queries},
                       {"closure_residual", end.closure_residual}};
    fmt::print("{}\n", hinge::tool::json_text(json, 1));
  } else {
    fmt::print("{} of {} accepted ({:.2f} %), {} rejected, {:.0f} steps per second\n", counts.accepted,
               counted(options.steps, "step"),
               100.0 * static_cast<double>(counts.accepted) / static_cast<double>(options.steps), rejected,
               static_cast<double>(options.steps) / walking);
    if (file.size() > 0) fmt::print("{} written to {}\n", counted(file.size(), "conformation"), options.out);
    if (!job.kept.closures.empty())
      fmt::print("closures kept: {}; moves rejected because they did not close: {}\n", job.kept.closures.size(),
                 counts.unclosed);
    if (end.closure_residual > 0.0)
      fmt::print("closures: the worst residual at the end is {:.3g} angstrom\n", end.closure_residual);
  }
  if (options.view) write_view(options, job, {"the end of the walk", walker.positions(), {}}, file.size() > 0);
  page.write("free", fmt::format("{} of {} accepted; every conformation of the walk is free", counts.accepted,
                                 counted(options.steps, "step")));
  return Exit::free;
}

}  // namespace biocd
