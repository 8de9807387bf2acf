// SPDX-License-Identifier: BSD-3-Clause
// biocd plan: finds a motion between two conformations on which no pair collides.
#include "hinge/molecular/plan.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdio>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "conformation_file.hpp"
#include "hinge/core/error.hpp"
#include "hinge/molecular/fit_coordinates.hpp"
#include "hinge/molecular/path_checker.hpp"
#include "hinge_tools/clock.hpp"
#include "hinge_tools/counted.hpp"
#include "hinge_tools/json_text.hpp"
#include "molecule_page.hpp"
#include "options.hpp"
#include "pair_table.hpp"
#include "path_end.hpp"
#include "report.hpp"
#include "view.hpp"

namespace biocd {

namespace {

using namespace hinge::molecular;
using hinge::tool::counted;

/// Sets a fitted end to the conformation that the motion has there.
void replace_end(const Job& job, PathEnd& end, const std::vector<double>& q) {
  if (!end.fitted) return;
  Checker checker = job.checker;
  checker.check(q, Mode{});
  const Superposition found = superpose(checker.positions(), end.target);
  end.turns = q;
  end.fitted->rmsd = found.rmsd;
  end.fitted->farthest = found.farthest;
  end.fitted->atom = found.atom;
}

/// Prints the pairs if the end collides. Returns true if it does.
bool report_collision(const Options& options, const Job& job, const PathEnd& end, const char* which) {
  Checker checker = job.checker;
  const std::vector<Contact> pairs = checker.check(end.turns, Mode{Mode::Kind::all}).pairs;
  if (pairs.empty()) return false;
  if (options.output == Output::json) {
    Json json{{"tool", "biocd"}, {"command", "plan"}, {"model", model_json(options, job)}};
    json["colliding_end"] = which;
    json["pairs"] = Json::array();
    for (const Contact& pair : pairs_to_print(options, pairs)) json["pairs"].push_back(pair_json(job, pair));
    add_left_out(json, options, pairs, Mode{Mode::Kind::all});
    fmt::print("{}\n", hinge::tool::json_text(json, 1));
  } else {
    fmt::print("{}the {} collides in {}\n{}", heading(options, job), which, counted(pairs.size(), "pair"),
               pair_table(options, job, pairs, true));
  }
  fmt::print(stderr,
             "note: a motion needs ends without collisions: biocd relax mends them, --exempt-reference leaves "
             "out the pairs that collide in the file\n");
  return true;
}

/// Calls use(q) for the first waypoint, and for conformations up to each next one, at most --step apart.
template <class Use>
void for_frames(const Options& options, const Job& job, const std::vector<std::vector<double>>& waypoints,
                const Use& use) {
  constexpr double angstrom_per_degree = 0.1;  // moves of placed parts against turns
  use(waypoints.front());
  for (std::size_t w = 1; w < waypoints.size(); ++w) {
    const std::vector<double>&a = waypoints[w - 1], &b = waypoints[w];
    double largest = 0.0;
    for (std::size_t k = 0; k < a.size(); ++k)
      largest = std::max(largest, std::abs(b[k] - a[k]) /
                                      (turns(job, job.checker.selection().dofs()[k]) ? degree : angstrom_per_degree));
    const auto count = std::max<std::size_t>(1, static_cast<std::size_t>(std::ceil(largest / options.frame_step)));
    std::vector<double> q(a.size());
    for (std::size_t f = 1; f < count; ++f) {
      const double t = static_cast<double>(f) / static_cast<double>(count);
      for (std::size_t k = 0; k < q.size(); ++k) q[k] = a[k] + t * (b[k] - a[k]);
      use(q);
    }
    use(b);
  }
}

/// Returns the pairs that collide on the straight way from the last waypoint to the end.
std::vector<Contact> pairs_in_the_way(const Job& job, const PlannedMotion& planned, const PathEnd& to) {
  const hinge::PathAnswer answer = PathChecker(job.checker).certify(planned.waypoints.back(), to.turns);
  if (answer.verdict != hinge::PathVerdict::colliding) return {};
  Checker checker = job.checker;
  return checker.check(answer.configuration, Mode{Mode::Kind::all}).pairs;
}

Json plan_json(const Options& options, const Job& job, const PathEnd& from, const PathEnd& to,
               const PlannedMotion& planned, std::size_t frames) {
  Json json{{"tool", "biocd"}, {"command", "plan"}, {"model", model_json(options, job)}, {"seed", options.seed}};
  json["constant_contacts"] = constant_contacts_json(job);
  json["dofs"] = Json::array();
  for (const hinge::DofId dof : job.checker.selection().dofs()) json["dofs"].push_back(dof_label(job, dof));
  json["from"] = end_json(job, from);
  json["to"] = end_json(job, to);
  json["reached"] = planned.reached;
  json["length"] = rounded(planned.length);
  json["straight"] = rounded(planned.straight);
  json["remaining"] = rounded(planned.remaining);
  json["closure_residual"] = planned.open;
  json["motions"] = planned.motions;
  json["frames"] = frames;
  json["waypoints"] = Json::array();
  for (const std::vector<double>& q : planned.waypoints) json["waypoints"].push_back(in_degrees(job, q));
  return json;
}

void print_plan(const Options& options, const Job& job, const PathEnd& from, const PathEnd& to,
                const PlannedMotion& planned, std::size_t frames) {
  fmt::print("motion from {} to {}; the straight path is {:.3f} angstrom long\n", shown(from), shown(to),
             planned.straight);
  if (planned.reached) {
    fmt::print("found: {}, {:.3f} angstrom long; {} tested\n", counted(planned.waypoints.size(), "waypoint"),
               planned.length, counted(planned.motions, "motion"));
    fmt::print("free: proved for every state between neighbouring waypoints\n");
  } else {
    fmt::print("no motion was found; {} tested\n", counted(planned.motions, "motion"));
    fmt::print("the nearest conformation that was reached is {:.3f} angstrom from the end\n", planned.remaining);
    const std::vector<Contact> pairs = pairs_in_the_way(job, planned, to);
    if (!pairs.empty())
      fmt::print("on the straight way from there, these pairs collide:\n{}", pair_table(options, job, pairs, true));
  }
  if (!job.kept.closures.empty())
    fmt::print("closures kept: {}; between waypoints they are open by at most {:.2g} angstrom\n",
               job.kept.closures.size(), planned.open);
  if (frames > 0) fmt::print("{} written to {}\n", counted(frames, "conformation"), options.out);
}

/// Writes the page of --report.
void write_page(MoleculePage& page, const Options& options, const Job& job, const PlannedMotion& planned) {
  if (!page.wanted()) return;
  constexpr std::size_t most_shown = 200;
  std::vector<std::vector<double>> frames;
  for_frames(options, job, planned.waypoints, [&](const std::vector<double>& q) { frames.push_back(q); });
  const std::size_t shown = std::min(frames.size(), most_shown);
  Checker checker = job.checker;
  for (std::size_t n = 0; n < shown; ++n) {
    const std::size_t k = shown == 1 ? 0 : n * (frames.size() - 1) / (shown - 1);
    Verdict verdict = checker.check(frames[k], Mode{Mode::Kind::all});
    page.add_next({k, fmt::format("conformation {} of {}", k + 1, frames.size()), verdict.collides, checker.positions(),
                   std::move(verdict.pairs)});
  }
  page.write(planned.reached ? "free" : "undecided",
             planned.reached ? fmt::format("a motion was found, {:.3f} angstrom long, proved free", planned.length)
                             : fmt::format("no motion was found; the nearest conformation is {:.3f} angstrom from the "
                                           "end",
                                           planned.remaining));
}

}  // namespace

Exit run_plan(const Options& options) {
  const Job job = load(options);
  print_notes(job);
  print_left_out(options, job);
  if (!options.explain.empty()) {
    explain(options, job);
    return Exit::free;
  }
  require_free_torsions(options, job);
  const Structure& s = job.molecule->structure();
  ConformationFile file(options, s, s.atoms.size(), false);
  MoleculePage page(options, job, true);
  const hinge::tool::TimeLimit out_of_time(options.seconds);

  const FitOptions fit{job.kept.closures, true};
  PathEnd from = read_path_end("--from", options.from, options, job, fit, out_of_time);
  PathEnd to = read_path_end("--to", options.to, options, job, fit, out_of_time);
  take_shorter_way(job, from, to);
  PlanOptions how{.closures = job.kept.closures, .seed = options.seed};
  if (options.most_tries) how.most_motions = *options.most_tries;
  PlannedMotion planned;
  try {
    planned = plan(job.checker, {from.turns, from.target}, {to.turns, to.target}, how, out_of_time);
  } catch (const hinge::ConfigurationError&) {
    for (const auto& [end, which] : {std::pair{&from, "start"}, std::pair{&to, "end"}})
      if (report_collision(options, job, *end, which)) return Exit::collision;
    throw;
  }
  replace_end(job, from, planned.waypoints.front());
  if (planned.reached) replace_end(job, to, planned.waypoints.back());
  for (const PathEnd* end : {&from, &to})
    if (const std::string note = note_of(*end, job); !note.empty()) fmt::print(stderr, "note: {}\n", note);
  Checker checker = job.checker;
  if (file.wanted())
    for_frames(options, job, planned.waypoints, [&](const std::vector<double>& q) {
      checker.check(q, Mode{});
      file.add(checker.positions(), static_cast<int>(file.size()) + 1, false);
    });
  file.finish();

  if (options.output == Output::json)
    fmt::print("{}\n", hinge::tool::json_text(plan_json(options, job, from, to, planned, file.size()), 1));
  else {
    fmt::print("{}", heading(options, job));
    print_plan(options, job, from, to, planned, file.size());
  }
  if (!planned.reached)
    fmt::print(stderr, "note: {}\n",
               planned.stopped ? "--time has passed"
                               : "more free torsions (--free), tested motions (--tries) or another --seed may help");
  if (options.view) {
    checker.check(planned.waypoints.back(), Mode{});
    write_view(
        options, job,
        {planned.reached ? "the end of the motion" : "the nearest conformation to the end", checker.positions(), {}},
        file.size() > 0);
  }
  write_page(page, options, job, planned);
  return planned.reached ? Exit::free : Exit::shortfall;
}

}  // namespace biocd
