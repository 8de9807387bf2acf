// SPDX-License-Identifier: BSD-3-Clause
// robocd path: is the straight path between two configurations free?
#include <fmt/format.h>

#include <cstddef>
#include <cstdio>
#include <string>
#include <variant>
#include <vector>

#include "answer.hpp"
#include "configurations.hpp"
#include "hinge/core/error.hpp"
#include "hinge/motion/path_answer.hpp"
#include "hinge/robotics/path_checker.hpp"
#include "hinge/tool/json_text.hpp"
#include "options.hpp"
#include "path_end.hpp"
#include "report.hpp"

namespace robocd {

using namespace hinge::robotics;
using hinge::PathVerdict;

namespace {

struct Asked {
  std::vector<double> from, to;
  RobotPathAnswer path;
  Answer state;  // of the configuration that collides
};

const std::string& name(const Worker& worker, const LinkOrBody& part) {
  if (const auto* link = std::get_if<hinge::LinkId>(&part)) return worker.checker.robot().link_name(*link);
  return worker.environment->name(std::get<BodyId>(part));
}

Json path_json(const Options& options, const Job& job, const Worker& worker, const Asked& asked) {
  const RobotPathAnswer& path = asked.path;
  Json json{{"tool", "robocd"}, {"command", "path"}, {"robot", robot_json(options, job)}};
  json["clearance"] = options.clearance;
  json["environment"] = options.environment;
  json["notes"] = job.srdf.notes;
  json["joints"] = Json::array();
  for (std::size_t k = 0; k < job.robot->independent_joints().size(); ++k)
    json["joints"].push_back(job.robot->independent_name(k));
  json["from"] = Json{{"given", options.from}, {"values", asked.from}};
  json["to"] = Json{{"given", options.to}, {"values", asked.to}};
  json["method"] = options.sampled ? "sampled" : "certified";
  json["resolution"] = options.sampled ? Json(*options.sampled) : Json();
  json["min_step"] = options.sampled ? Json() : Json(options.min_step);
  json["verdict"] = name(path.verdict);
  json["proved"] = path.verdict == PathVerdict::colliding || (path.is_free() && !options.sampled);
  json["parameter"] = path.is_free() ? Json() : Json(path.parameter);
  json["half_width"] = path.verdict == PathVerdict::undecided ? Json(path.half_width) : Json();
  json["values"] = path.is_free() ? Json() : Json(path.configuration);
  const Json state = answer_json(worker, 0, asked.state, {Mode{}, !options.environment.empty(), false});
  for (const char* list : {"pairs", "environment_pairs"}) json[list] = state.value(list, Json::array());
  json["contact"] = Json();
  if (path.contact)
    json["contact"] = Json{{"first", name(worker, path.contact->first)},
                           {"second", name(worker, path.contact->second)},
                           {"distance", path.contact->distance},
                           {"threshold", path.contact->threshold}};
  json["states_looked_at"] = path.counts.configurations;
  return json;
}

void print_table(const Options& options, const Job& job, const Worker& worker, const Asked& asked) {
  const RobotPathAnswer& path = asked.path;
  fmt::print("{}", heading(options, job));
  const auto contact = [&] {
    if (path.contact) fmt::print("  {} - {}\n", name(worker, path.contact->first), name(worker, path.contact->second));
  };
  switch (path.verdict) {
    case PathVerdict::free:
      if (options.sampled)
        fmt::print("free at {} states at most {} rad or m apart; what lies between them was not looked at\n",
                   path.counts.configurations, *options.sampled);
      else
        fmt::print("free: proved for every state, from {} of them\n", path.counts.configurations);
      break;
    case PathVerdict::colliding: {
      fmt::print("collides at t = {}\n", path.parameter);
      const std::string lines = pair_lines(worker, asked.state);
      if (lines.empty()) contact();  // found with followers as the path has them, rounded otherwise
      fmt::print("{}", lines);
      break;
    }
    case PathVerdict::undecided:
      fmt::print("undecided: nothing is proved within {:.3g} of t = {}\n", path.half_width, path.parameter);
      contact();
      break;
  }
}

}  // namespace

Exit run_path(const Options& options) {
  const Job job = load(options);
  Asked asked{
      read_path_end("--from", options.from, options, job), read_path_end("--to", options.to, options, job), {}, {}};
  Worker worker = make_worker(options, job);
  print_notes(job);
  const Configurations ends{2, [&](std::size_t k) { return k == 0 ? asked.from : asked.to; }};
  if (const std::size_t outside = count_outside_limits(ends, *job.robot); outside > 0)
    std::fprintf(stderr, "note: %zu of 2 ends are outside the joint limits\n", outside);

  PathChecker paths =
      worker.environment ? PathChecker(worker.checker, *worker.environment) : PathChecker(worker.checker);
  asked.path = options.sampled ? paths.sample(asked.from, asked.to, *options.sampled)
                               : paths.certify(asked.from, asked.to, options.min_step);
  if (asked.path.verdict == PathVerdict::colliding)
    asked.state = ask(worker, asked.path.configuration, Mode{Mode::Kind::all}, false);

  if (options.output == Output::json)
    fmt::print("{}\n", hinge::tool::json_text(path_json(options, job, worker, asked), 1));
  else
    print_table(options, job, worker, asked);
  switch (asked.path.verdict) {
    case PathVerdict::free: return Exit::free;
    case PathVerdict::colliding: return Exit::collision;
    case PathVerdict::undecided: break;
  }
  return Exit::undecided;
}

}  // namespace robocd
