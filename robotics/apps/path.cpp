// SPDX-License-Identifier: BSD-3-Clause
// robocd path: checks whether the straight path between two configurations is free.
#include <fmt/format.h>

#include <cstddef>
#include <cstdio>
#include <optional>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "answer.hpp"
#include "configurations.hpp"
#include "hinge/core/error.hpp"
#include "hinge/path/path_answer.hpp"
#include "hinge/robotics/path_checker.hpp"
#include "hinge_tools/counted.hpp"
#include "hinge_tools/json_text.hpp"
#include "options.hpp"
#include "path_end.hpp"
#include "read_configurations.hpp"
#include "report.hpp"
#include "robot_page.hpp"

namespace robocd {

using namespace hinge::robotics;
using hinge::PathVerdict;
using hinge::tool::counted;

namespace {

struct Asked {
  std::vector<std::vector<double>> waypoints;  // two or more
  std::size_t segment = 0;           // the first that collides, otherwise the first undecided one, otherwise the last
  RobotPathAnswer path;              // of that segment
  Answer state;                      // of the colliding configuration
  std::size_t states_looked_at = 0;  // on all segments
};

const std::string& name(const Worker& worker, const LinkOrBody& part) {
  if (const auto* link = std::get_if<hinge::LinkId>(&part)) return worker.checker.robot().link_name(*link);
  return worker.environment->name(std::get<BodyId>(part));
}

/// Returns the two ends, or the rows of a file. Throws ModelError if there are fewer than two rows.
std::vector<std::vector<double>> read_waypoints(const Options& options, Job& job) {
  if (options.waypoints.empty())
    return {read_path_end("--from", options.from, options, job), read_path_end("--to", options.to, options, job)};
  auto rows = read_configurations(options.waypoints, *job.robot, job.notes);
  if (rows.size() < 2)
    throw hinge::ModelError("--waypoints " + options.waypoints + ": holds one configuration, expected two or more");
  return rows;
}

Json path_json(const Options& options, const Job& job, const Worker& worker, const Asked& asked) {
  const RobotPathAnswer& path = asked.path;
  Json json{{"tool", "robocd"}, {"command", "path"}, {"robot", robot_json(options, job)}};
  json["clearance"] = options.clearance;
  add_surroundings(json, job);
  json["joints"] = joint_names(*job.robot);
  const auto end = [&](const std::string& given, std::size_t row) {
    return Json{{"given", options.waypoints.empty() ? given : fmt::format("@{}:{}", options.waypoints, row)},
                {"values", asked.waypoints[row]}};
  };
  const bool is_free = path.is_free();
  json["from"] = end(options.from, is_free ? 0 : asked.segment);
  json["to"] = end(options.to, is_free ? asked.waypoints.size() - 1 : asked.segment + 1);
  json["segments"] = asked.waypoints.size() - 1;
  json["segment"] = is_free ? Json() : Json(asked.segment);
  json["method"] = options.sampled ? "sampled" : "certified";
  json["resolution"] = options.sampled ? Json(*options.sampled) : Json();
  json["min_step"] = options.sampled ? Json() : Json(options.min_step);
  json["verdict"] = name(path.verdict);
  json["proved"] = path.verdict == PathVerdict::colliding || (path.is_free() && !options.sampled);
  json["parameter"] = path.is_free() ? Json() : Json(path.parameter);
  json["half_width"] = path.verdict == PathVerdict::undecided ? Json(path.half_width) : Json();
  json["values"] = path.is_free() ? Json() : Json(path.configuration);
  const Json state = answer_json(worker, 0, path.configuration, asked.state,
                                 {Mode{}, !options.environment.empty(), false, options.max_pairs});
  for (const char* list : {"pairs", "environment_pairs"}) json[list] = state.value(list, Json::array());
  if (options.max_pairs) json["pairs_left_out"] = state.value("pairs_left_out", 0);
  json["contact"] = Json();
  if (path.contact)
    json["contact"] = Json{{"first", name(worker, path.contact->first)},
                           {"second", name(worker, path.contact->second)},
                           {"distance", path.contact->distance},
                           {"threshold", path.contact->threshold}};
  json["states_looked_at"] = asked.states_looked_at;
  return json;
}

void print_table(const Options& options, const Job& job, const Worker& worker, const Asked& asked) {
  const RobotPathAnswer& path = asked.path;
  fmt::print("{}", heading(options, job));
  const auto contact = [&] {
    if (path.contact)
      fmt::print("  {:<28} {}\n", name(worker, path.contact->first), name(worker, path.contact->second));
  };
  const std::size_t segments = asked.waypoints.size() - 1;
  const std::string where =
      segments == 1 ? ""
                    : fmt::format(" of segment {} (rows {} to {})", asked.segment, asked.segment, asked.segment + 1);
  if (segments > 1) fmt::print("{} segments\n", segments);
  switch (path.verdict) {
    case PathVerdict::free:
      if (options.sampled)
        fmt::print("free at {} at most {} rad or m apart; the states between them were not tested{}\n",
                   counted(asked.states_looked_at, "state"), *options.sampled, incomplete(*job.robot));
      else
        fmt::print("free: proved for every state, by testing {}{}\n", counted(asked.states_looked_at, "state"),
                   incomplete(*job.robot));
      break;
    case PathVerdict::colliding: {
      fmt::print("collides at t = {:.4g}{}{}\n{}", path.parameter, where, incomplete(*job.robot), pair_heading(Mode{}));
      const std::string lines = pair_table(worker, asked.state, options.max_pairs);
      if (lines.empty()) contact();  // the path rounds mimic joints differently
      fmt::print("{}", lines);
      break;
    }
    case PathVerdict::undecided:
      fmt::print("undecided: nothing is proved within {:.2g} of t = {:.8g}{}{}\n", path.half_width, path.parameter,
                 where, incomplete(*job.robot));
      contact();
      break;
  }
}

void write_page(RobotPage& page, const Options& options, const Asked& asked) {
  if (!page.wanted()) return;
  const RobotPathAnswer& path = asked.path;
  const std::string where = asked.waypoints.size() == 2 ? "" : fmt::format(" of segment {}", asked.segment);
  std::optional<MotionStop> stop;
  if (!path.is_free()) stop = MotionStop{asked.segment, path.parameter, path.configuration};
  add_motion(page, asked.waypoints, stop);
  switch (path.verdict) {
    case PathVerdict::free:
      return page.write("free", options.sampled ? "every tested state of the path is free"
                                                : "the path is free, proved for every state");
    case PathVerdict::colliding:
      return page.write("collides",
                        fmt::format("the path collides, for example at t = {:.4g}{}", path.parameter, where));
    case PathVerdict::undecided: break;
  }
  page.write("undecided",
             fmt::format("nothing is proved within {:.2g} of t = {:.8g}{}", path.half_width, path.parameter, where));
}

}  // namespace

Exit run_path(const Options& options) {
  Job job = load(options);
  Asked asked;
  asked.waypoints = read_waypoints(options, job);
  Worker worker = make_worker(options, job);
  const Configurations all{asked.waypoints.size(), [&](std::size_t k) { return asked.waypoints[k]; }};
  for (const std::string& note : notes_on_limits(all, options, *job.robot)) job.notes.push_back(note);
  for (const std::string& note : notes_on_bodies(options, worker)) job.notes.push_back(note);
  print_notes(job);

  RobotPage page(options, job, worker, Mode{Mode::Kind::all}, true);
  PathChecker paths = path_checker(worker);
  for (std::size_t k = 0; k + 1 < asked.waypoints.size(); ++k) {
    const std::vector<double>&from = asked.waypoints[k], &to = asked.waypoints[k + 1];
    RobotPathAnswer found =
        options.sampled ? paths.sample(from, to, *options.sampled) : paths.certify(from, to, options.min_step);
    asked.states_looked_at += found.counts.configurations;
    const bool collides = found.verdict == PathVerdict::colliding;
    if (collides || asked.path.is_free() || k == 0) {
      asked.segment = k;
      asked.path = std::move(found);
    }
    if (collides) break;
  }
  if (asked.path.verdict == PathVerdict::colliding)
    asked.state = ask(worker, asked.path.configuration, Mode{Mode::Kind::all}, false);

  if (options.output == Output::json)
    fmt::print("{}\n", hinge::tool::json_text(path_json(options, job, worker, asked), 1));
  else
    print_table(options, job, worker, asked);
  write_page(page, options, asked);
  print_incomplete(*job.robot);
  switch (asked.path.verdict) {
    case PathVerdict::free: return Exit::free;
    case PathVerdict::colliding: return Exit::collision;
    case PathVerdict::undecided: break;
  }
  return Exit::undecided;
}

}  // namespace robocd
