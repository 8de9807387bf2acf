// SPDX-License-Identifier: BSD-3-Clause
// robocd relax: moves a configuration out of collision.
#include "hinge/robotics/relax.hpp"

#include <fmt/format.h>

#include <cstddef>
#include <string>
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

Json side_json(const Options& options, const Worker& worker, const std::vector<double>& q, const Answer& answer) {
  Json row = answer_json(worker, 0, q, answer, {Mode{}, !options.environment.empty(), false, options.max_pairs});
  row.erase("index");
  return row;
}

void print_joints(const Robot& robot, const std::vector<double>& before, const std::vector<double>& after) {
  fmt::print("  {:<28} {:>12} {:>12} {:>12}\n", "joint (rad or m)", "before", "after", "change");
  for (std::size_t j = 0; j < before.size(); ++j)
    if (before[j] != after[j])
      fmt::print("  {:<28} {:12.6f} {:12.6f} {:+12.6f}\n", robot.independent_name(j), before[j], after[j],
                 after[j] - before[j]);
}

}  // namespace

Exit run_relax(const Options& options) {
  Job job = load(options);
  const std::vector<double> start = read_path_end("--from", options.from, options, job);
  Worker worker = make_worker(options, job);
  const Configurations given{1, [&](std::size_t) { return std::vector<double>(start); }};
  for (const std::string& note : notes_on_limits(given, options, *job.robot)) job.notes.push_back(note);
  for (const std::string& note : notes_on_bodies(options, worker)) job.notes.push_back(note);
  print_notes(job);
  hinge::tool::CompleteFile file(options.out);
  RobotPage page(options, job, worker, Mode{Mode::Kind::all}, true);

  const hinge::tool::TimeLimit out_of_time(options.seconds);
  RelaxOptions how;
  how.seed = options.seed;
  how.most_tries = options.tries;
  hinge::robotics::Environment* const environment = worker.environment ? &*worker.environment : nullptr;
  const Relaxation relaxed = relax(worker.checker, environment, start, how, out_of_time);
  const Mode all{Mode::Kind::all};
  const Answer before = ask(worker, start, all, false), after = ask(worker, relaxed.q, all, false);
  if (file.wanted()) {
    write_header(file.stream(), *job.robot);
    write_row(file.stream(), relaxed.q);
  }
  file.finish();

  if (options.output == Output::json) {
    Json json{{"tool", "robocd"}, {"command", "relax"}, {"robot", robot_json(options, job)}};
    json["clearance"] = options.clearance;
    add_surroundings(json, job);
    json["seed"] = options.seed;
    json["joints"] = joint_names(*job.robot);
    json["before"] = side_json(options, worker, start, before);
    json["after"] = side_json(options, worker, relaxed.q, after);
    json["distance"] = relaxed.distance;
    json["tries"] = relaxed.tries;
    fmt::print("{}\n", hinge::tool::json_text(json, 1));
  } else {
    fmt::print("{}", heading(options, job));
    if (before.collides)
      fmt::print("before: collides\n{}{}", pair_heading(Mode{}), pair_table(worker, before, options.max_pairs));
    else
      fmt::print("before: free, nothing to do\n");
    if (before.collides && !after.collides) {
      fmt::print("after: free, {:.6f} away (root of the sum of squared changes, rad and m alike)\n", relaxed.distance);
      print_joints(*job.robot, start, relaxed.q);
    } else if (after.collides) {
      fmt::print("no free configuration was found\n");
    }
    if (!options.out.empty()) fmt::print("written to {}\n", options.out);
  }
  if (after.collides)
    fmt::print(stderr, "note: no free configuration in {}{}\n", counted(relaxed.tries, "try", "tries"),
               relaxed.stopped ? "; --time has passed" : "");
  page.add_next("before", start);
  page.add_next("after", relaxed.q);
  page.write(after.collides ? "collides" : "free", after.collides
                                                       ? std::string("no free configuration was found")
                                                       : fmt::format("free, {:.6f} from the start", relaxed.distance));
  print_incomplete(*job.robot);
  return after.collides ? Exit::collision : Exit::free;
}

}  // namespace robocd
