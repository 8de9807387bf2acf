// SPDX-License-Identifier: BSD-3-Clause
// biocd path: tests whether the straight path between two conformations is free.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdio>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "hinge/core/error.hpp"
#include "hinge/molecular/path_checker.hpp"
#include "hinge/path/path_answer.hpp"
#include "hinge_tools/counted.hpp"
#include "hinge_tools/json_text.hpp"
#include "molecule_page.hpp"
#include "options.hpp"
#include "pair_table.hpp"
#include "path_end.hpp"
#include "report.hpp"
#include "view.hpp"

namespace biocd {

using namespace hinge::molecular;
using hinge::PathAnswer;
using hinge::PathVerdict;
using hinge::tool::counted;

namespace {

struct Asked {
  PathEnd from, to;
  PathAnswer answer;
  std::vector<Contact> pairs;     // pairs that collide at the colliding state
  double closure_residual = 0.0;  // worst closure residual at either end, angstrom
};

Json path_json(const Options& options, const Job& job, const Asked& asked) {
  const PathAnswer& answer = asked.answer;
  Json json{{"tool", "biocd"}, {"command", "path"}, {"model", model_json(options, job)}};
  json["constant_contacts"] = constant_contacts_json(job);
  json["dofs"] = Json::array();
  for (const hinge::DofId dof : job.checker.selection().dofs()) json["dofs"].push_back(dof_label(job, dof));
  json["from"] = end_json(job, asked.from);
  json["to"] = end_json(job, asked.to);
  json["closure_residual"] = asked.closure_residual;
  json["method"] = options.sampled_degrees ? "sampled" : "certified";
  json["resolution_degrees"] = options.sampled_degrees ? Json(*options.sampled_degrees) : Json();
  json["min_step"] = options.sampled_degrees ? Json() : Json(options.min_step);
  json["verdict"] = name(answer.verdict);
  json["proved"] = answer.verdict == PathVerdict::colliding || (answer.is_free() && !options.sampled_degrees);
  json["parameter"] = answer.is_free() ? Json() : Json(answer.parameter);
  json["half_width"] = answer.verdict == PathVerdict::undecided ? Json(answer.half_width) : Json();
  json["turns"] = answer.is_free() ? Json() : Json(in_degrees(job, answer.configuration));
  json["pairs"] = Json::array();
  for (const Contact& pair : pairs_to_print(options, asked.pairs)) json["pairs"].push_back(pair_json(job, pair));
  add_left_out(json, options, asked.pairs, Mode{Mode::Kind::all});
  json["undecided_pair"] = Json();
  if (answer.verdict == PathVerdict::undecided && answer.hit)
    json["undecided_pair"] = pair_json(job, {*answer.hit, false});
  json["states_looked_at"] = answer.counts.configurations;
  return json;
}

void print_table(const Options& options, const Job& job, const Asked& asked) {
  const PathAnswer& answer = asked.answer;
  fmt::print("{}", heading(options, job));
  fmt::print("path from {} to {}", shown(asked.from), shown(asked.to));
  const auto dofs = job.checker.selection().dofs();
  for (const bool turning : {true, false}) {
    std::size_t most = dofs.size();
    const auto change = [&](std::size_t k) { return std::abs(asked.to.turns[k] - asked.from.turns[k]); };
    for (std::size_t k = 0; k < dofs.size(); ++k)
      if (turns(job, dofs[k]) == turning && (most == dofs.size() || change(k) > change(most))) most = k;
    if (most == dofs.size()) continue;
    fmt::print("; largest {} {:.4g} {} ({})", turning ? "turn" : "move", change(most) / (turning ? degree : 1.0),
               turning ? "degrees" : "angstrom", dof_label(job, dofs[most]));
  }
  fmt::print("\n");
  if (asked.closure_residual > 0.0)
    fmt::print("closures: not solved, so cycles open; the larger residual of the two ends is {:.3f} angstrom\n",
               asked.closure_residual);
  switch (answer.verdict) {
    case PathVerdict::free:
      if (options.sampled_degrees)
        fmt::print("free at {} at most {} degrees apart; the states between them were not tested\n",
                   counted(answer.counts.configurations, "state"), *options.sampled_degrees);
      else
        fmt::print("free: proved for every state, by testing {}\n", counted(answer.counts.configurations, "state"));
      break;
    case PathVerdict::colliding:
      fmt::print("collides at t = {:.4g}, {}\n{}", answer.parameter, counted(asked.pairs.size(), "pair"),
                 pair_table(options, job, asked.pairs, true));
      break;
    case PathVerdict::undecided:
      fmt::print("undecided: nothing is proved within {:.2g} of t = {:.8g}\n", answer.half_width, answer.parameter);
      if (answer.hit) fmt::print("{}", pair_table(options, job, {{*answer.hit, false}}, true));
      break;
  }
}

/// Prints a note about the closure with the largest residual at the ends and at 15 states between them.
void note_open_closures(const Job& job, const Asked& asked) {
  constexpr std::size_t steps = 16;
  Checker checker = job.checker;
  std::vector<double> worst(closure_names(job).size(), 0.0), q(asked.from.turns.size());
  for (std::size_t step = 0; step <= steps && !worst.empty(); ++step) {
    const double t = static_cast<double>(step) / static_cast<double>(steps);
    for (std::size_t k = 0; k < q.size(); ++k) q[k] = (1.0 - t) * asked.from.turns[k] + t * asked.to.turns[k];
    const auto residuals = checker.check(q, Mode{Mode::Kind::any}).closure_residuals;
    for (std::size_t c = 0; c < worst.size(); ++c) worst[c] = std::max(worst[c], residuals[c]);
  }
  const auto most = std::ranges::max_element(worst);
  if (most == worst.end() || *most <= 1e-6) return;
  std::fprintf(stderr,
               "note: a straight path does not keep cycles closed: %td of %s on it, the most %s, by %.3f angstrom\n",
               std::ranges::count_if(worst, [](double residual) { return residual > 1e-6; }),
               counted(worst.size(), "closure opens", "closures open").c_str(),
               closure_names(job)[static_cast<std::size_t>(most - worst.begin())].c_str(), *most);
}

/// Writes the page of --report: states of the path, and the state where it collides or is undecided.
void write_page(MoleculePage& page, const Options& options, const Job& job, const Asked& asked) {
  if (!page.wanted()) return;
  constexpr std::size_t steps = 60;
  std::vector<double> shown;
  for (std::size_t k = 0; k <= steps; ++k) shown.push_back(static_cast<double>(k) / double{steps});
  if (!asked.answer.is_free())
    shown.insert(std::ranges::lower_bound(shown, asked.answer.parameter), asked.answer.parameter);
  Checker checker = job.checker;
  for (std::size_t k = 0; k < shown.size(); ++k) {
    const double t = shown[k];
    std::vector<double> q = asked.answer.configuration;
    if (asked.answer.is_free() || t != asked.answer.parameter) {
      q = asked.from.turns;
      for (std::size_t j = 0; j < q.size(); ++j) q[j] += t * (asked.to.turns[j] - asked.from.turns[j]);
    }
    Verdict verdict = checker.check(q, Mode{Mode::Kind::all});
    page.add_next({k, fmt::format("t = {:.4g}", t), verdict.collides, checker.positions(), std::move(verdict.pairs)});
  }
  switch (asked.answer.verdict) {
    case PathVerdict::free:
      return page.write("free", options.sampled_degrees ? "every tested state of the path is free"
                                                        : "the path is free, proved for every state");
    case PathVerdict::colliding:
      return page.write("collides",
                        fmt::format("the path collides, for example at t = {:.4g}", asked.answer.parameter));
    case PathVerdict::undecided: break;
  }
  page.write("undecided", fmt::format("nothing is proved within {:.2g} of t = {:.8g}", asked.answer.half_width,
                                      asked.answer.parameter));
}

}  // namespace

Exit run_path(const Options& options) {
  if (!options.loop.empty())
    throw hinge::ModelError("--loop: a path does not keep cycles closed, expected no loops (use biocd sample)");
  const Job job = load(options);
  print_notes(job);
  if (!options.explain.empty()) {
    explain(options, job);
    return Exit::free;
  }
  MoleculePage page(options, job, true);
  Asked asked{
      read_path_end("--from", options.from, options, job), read_path_end("--to", options.to, options, job), {}, {}};
  take_shorter_way(job, asked.from, asked.to);
  for (const PathEnd* end : {&asked.from, &asked.to})
    if (const std::string note = note_of(*end, job); !note.empty()) std::fprintf(stderr, "note: %s\n", note.c_str());

  PathChecker paths(job.checker);
  asked.answer = options.sampled_degrees
                     ? paths.sample(asked.from.turns, asked.to.turns, *options.sampled_degrees * degree)
                     : paths.certify(asked.from.turns, asked.to.turns, options.min_step);
  Checker checker = job.checker;
  for (const PathEnd* end : {&asked.from, &asked.to})
    asked.closure_residual =
        std::max(asked.closure_residual, checker.check(end->turns, Mode{Mode::Kind::any}).closure_residual);
  note_open_closures(job, asked);
  if (asked.answer.verdict == PathVerdict::colliding)
    asked.pairs = checker.check(asked.answer.configuration, Mode{Mode::Kind::all}).pairs;

  if (options.output == Output::json)
    fmt::print("{}\n", hinge::tool::json_text(path_json(options, job, asked), 1));
  else
    print_table(options, job, asked);
  if (options.view) {
    const bool is_free = asked.answer.is_free();
    checker.check(is_free ? asked.to.turns : asked.answer.configuration, Mode{Mode::Kind::all});
    std::vector<Contact> pairs = asked.pairs;
    if (asked.answer.verdict == PathVerdict::undecided && asked.answer.hit) pairs.push_back({*asked.answer.hit, false});
    write_view(options, job,
               {is_free ? "the end of the path" : fmt::format("t = {:.4g}", asked.answer.parameter),
                checker.positions(), std::move(pairs)},
               false);
  }
  write_page(page, options, job, asked);
  switch (asked.answer.verdict) {
    case PathVerdict::free: return Exit::free;
    case PathVerdict::colliding: return Exit::collision;
    case PathVerdict::undecided: break;
  }
  return Exit::undecided;
}

}  // namespace biocd
