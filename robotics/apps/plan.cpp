// SPDX-License-Identifier: BSD-3-Clause
// robocd plan: finds a free motion between two configurations.
#include "hinge/robotics/plan.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <string>
#include <utility>
#include <vector>

#include "answer.hpp"
#include "configurations.hpp"
#include "hinge_tools/clock.hpp"
#include "hinge_tools/complete_file.hpp"
#include "hinge_tools/counted.hpp"
#include "hinge_tools/json_text.hpp"
#include "options.hpp"
#include "path_end.hpp"
#include "report.hpp"
#include "robot_page.hpp"

namespace robocd {

using namespace hinge::robotics;
using hinge::tool::counted;

namespace {

using Rows = std::vector<std::vector<double>>;

/// Returns the waypoints, and with --step rows between them, so that no joint changes by more than that.
Rows rows_to_write(const Rows& waypoints, const std::optional<double>& step) {
  Rows rows{waypoints.front()};
  for (std::size_t w = 1; w < waypoints.size(); ++w) {
    const std::vector<double>&a = waypoints[w - 1], &b = waypoints[w];
    double largest = 0.0;
    for (std::size_t j = 0; j < a.size(); ++j) largest = std::max(largest, std::abs(b[j] - a[j]));
    const auto count = step ? static_cast<std::size_t>(std::ceil(largest / *step)) : std::size_t{1};
    for (std::size_t k = 1; k < count; ++k) {
      const double t = static_cast<double>(k) / static_cast<double>(count);
      std::vector<double> q(a.size());
      for (std::size_t j = 0; j < q.size(); ++j) q[j] = a[j] + t * (b[j] - a[j]);
      rows.push_back(std::move(q));
    }
    rows.push_back(b);
  }
  return rows;
}

Json head_json(const Options& options, const Job& job) {
  Json json{{"tool", "robocd"}, {"command", "plan"}, {"robot", robot_json(options, job)}};
  json["clearance"] = options.clearance;
  add_surroundings(json, job);
  json["joints"] = joint_names(*job.robot);
  return json;
}

/// Prints the pairs in contact if the end collides. Returns true if it does.
bool report_end(const Options& options, const Job& job, Worker& worker, const std::vector<double>& q,
                const char* which) {
  const Answer answer = ask(worker, q, Mode{Mode::Kind::all}, false);
  if (!answer.collides) return false;
  if (options.output == Output::json) {
    Json json = head_json(options, job);
    json["colliding_end"] = which;
    const Json row =
        answer_json(worker, 0, q, answer, {Mode{}, !options.environment.empty(), false, options.max_pairs});
    for (const char* list : {"pairs", "environment_pairs"}) json[list] = row.value(list, Json::array());
    if (options.max_pairs) json["pairs_left_out"] = row.value("pairs_left_out", 0);
    fmt::print("{}\n", hinge::tool::json_text(json, 1));
  } else {
    fmt::print("{}the {} collides\n{}{}", heading(options, job), which, pair_heading(Mode{}),
               pair_table(worker, answer, options.max_pairs));
  }
  fmt::print(stderr, "note: a motion needs ends without collisions; robocd relax finds a free configuration nearby\n");
  return true;
}

}  // namespace

Exit run_plan(const Options& options) {
  Job job = load(options);
  const std::vector<double> from = read_path_end("--from", options.from, options, job);
  const std::vector<double> to = read_path_end("--to", options.to, options, job);
  Worker worker = make_worker(options, job);
  const Configurations given{2, [&](std::size_t k) { return k == 0 ? from : to; }};
  for (const std::string& note : notes_on_limits(given, options, *job.robot)) job.notes.push_back(note);
  for (const std::string& note : notes_on_bodies(options, worker)) job.notes.push_back(note);
  print_notes(job);
  hinge::tool::CompleteFile file(options.out);
  RobotPage page(options, job, worker, Mode{Mode::Kind::all}, true);
  for (const auto& [q, which] : {std::pair{&from, "start"}, std::pair{&to, "end"}})
    if (report_end(options, job, worker, *q, which)) return Exit::collision;

  const hinge::tool::TimeLimit out_of_time(options.seconds);
  PathChecker paths = path_checker(worker);
  const PlannedMotion planned =
      plan(paths, from, to, {.most_motions = options.motions, .seed = options.seed}, out_of_time);
  std::size_t written = 0;
  if (file.wanted()) {
    write_header(file.stream(), *job.robot);
    for (const std::vector<double>& row : rows_to_write(planned.waypoints, options.step)) {
      write_row(file.stream(), row);
      ++written;
    }
  }
  file.finish();

  if (options.output == Output::json) {
    Json json = head_json(options, job);
    json["seed"] = options.seed;
    json["from"] = {{"given", options.from}, {"values", from}};
    json["to"] = {{"given", options.to}, {"values", to}};
    json["reached"] = planned.reached;
    json["length"] = planned.length;
    json["straight"] = planned.straight;
    json["remaining"] = planned.remaining;
    json["motions"] = planned.motions;
    json["rows"] = written;
    json["waypoints"] = planned.waypoints;
    fmt::print("{}\n", hinge::tool::json_text(json, 1));
  } else {
    fmt::print("{}", heading(options, job));
    if (planned.reached) {
      fmt::print("found: {}, {:.3f} m long (the straight motion: {:.3f}); {} tested\n",
                 counted(planned.waypoints.size(), "waypoint"), planned.length, planned.straight,
                 counted(planned.motions, "motion"));
      fmt::print("free: proved for every state between neighbouring waypoints{}\n", incomplete(*job.robot));
    } else {
      fmt::print("no motion was found; {} tested\n", counted(planned.motions, "motion"));
      fmt::print("the nearest configuration that was reached is {:.3f} m from the end (the start: {:.3f})\n",
                 planned.remaining, planned.straight);
    }
    if (written > 0) fmt::print("{} written to {}\n", counted(written, "row"), options.out);
  }
  add_motion(page, planned.waypoints);
  page.write(planned.reached ? "free" : "undecided",
             planned.reached ? fmt::format("a motion was found, {:.3f} m long, proved free", planned.length)
                             : fmt::format("no motion was found; the nearest configuration is {:.3f} m from the end",
                                           planned.remaining));
  print_incomplete(*job.robot);
  if (!planned.reached)
    fmt::print(stderr, "note: {}\n",
               planned.stopped ? "--time has passed" : "more tested motions (--tries) or another --seed may help");
  return planned.reached ? Exit::free : Exit::shortfall;
}

}  // namespace robocd
