// SPDX-License-Identifier: BSD-3-Clause
// robocd demo: times and verifies random configurations, proves or refutes a motion, and draws a collision.
#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <filesystem>
#include <set>
#include <string>
#include <variant>
#include <vector>

#include "answer.hpp"
#include "configurations.hpp"
#include "hinge/core/error.hpp"
#include "hinge/core/id.hpp"
#include "hinge/robotics/path_checker.hpp"
#include "hinge/robotics/random_configuration.hpp"
#include "hinge/robotics/robot.hpp"
#include "hinge/robotics/tessellate.hpp"
#include "hinge_tools/clock.hpp"
#include "hinge_tools/complete_file.hpp"
#include "hinge_tools/picture.hpp"
#include "options.hpp"
#include "path_end.hpp"
#include "report.hpp"

namespace robocd {

using namespace hinge::robotics;
using hinge::PathVerdict;
using hinge::tool::Colour;
using hinge::tool::Picture;

namespace {

constexpr std::uint64_t seed = 1, timed = 10000;  // random configurations
constexpr std::uint64_t verified = 100;           // of them, by brute force
constexpr Colour link_colour{120, 150, 190}, start_colour{214, 224, 236}, body_colour{214, 190, 150},
    hit_colour{220, 60, 50};

void draw_shape(Picture& picture, const Shape& shape, const hinge::Pose& pose, const Colour& colour) {
  for (const hinge::Triangle& t : drawn_triangles(shape, pose)) picture.triangle(t.a, t.b, t.c, colour);
}

/// Draws the links at a configuration. Links whose names are in `hit` get another colour.
void draw_robot(Picture& picture, RobotChecker checker, const std::vector<double>& q, const Colour& colour,
                const std::set<std::string>& hit) {
  checker.update(q);
  for (const LinkDescription& link : checker.robot().description().links) {
    const hinge::Pose pose = checker.link_pose(*checker.robot().find_link(link.name));
    for (const PlacedShape& part : link.geometry)
      draw_shape(picture, part.shape, pose * part.origin, hit.contains(link.name) ? hit_colour : colour);
  }
}

std::string title(const Robot& robot, PathVerdict verdict) {
  switch (verdict) {
    case PathVerdict::free: return robot.name() + ": the motion is free (start: light)";
    case PathVerdict::colliding: return robot.name() + ": a collision of the motion (red; start: light)";
    case PathVerdict::undecided: break;
  }
  return robot.name() + ": the motion is undecided";
}

/// Prints the rate of yes/no answers and the share that collides. Returns the number of answers that brute force does
/// not give.
int time_random_configurations(const Options& options, const Job& job, RobotChecker& checker) {
  const Robot& robot = *job.robot;
  std::vector<double> q(robot.independent_joints().size());
  std::uint64_t colliding = 0;
  const auto start = hinge::tool::Clock::now();
  for (std::uint64_t k = 0; k < timed; ++k) {
    random_configuration(robot, seed, k, q);
    checker.update(q);
    colliding += checker.collides() ? 1 : 0;
  }
  const double seconds = hinge::tool::seconds_since(start);
  RobotChecker brute(job.robot, job.tested, LinkMargins(robot, options.clearance), CheckOptions{"brute"});
  int different = 0;
  for (std::uint64_t k = 0; k < verified; ++k) {
    random_configuration(robot, seed, k, q);
    checker.update(q);
    brute.update(q);
    const auto found = checker.colliding_links(), expected = brute.colliding_links();
    const bool same =
        std::equal(found.begin(), found.end(), expected.begin(), expected.end(),
                   [](const LinkContact& a, const LinkContact& b) { return a.link1 == b.link1 && a.link2 == b.link2; });
    different += same ? 0 : 1;
  }
  fmt::print(
      "{} random configurations, one thread: {:.0f} per second, {:.1f} % collide with the robot itself\n"
      "brute force on {} of them: {} differences\n",
      timed, static_cast<double>(timed) / seconds, 100.0 * static_cast<double>(colliding) / double{timed}, verified,
      different);
  return different;
}

}  // namespace

Exit run_demo(const Options& options) {
  if (std::filesystem::path(options.out).extension() != ".svg")
    throw hinge::ModelError("--out " + options.out + ": expected a file name with .svg");
  Job job = load(options);
  check_limits(options, *job.robot);
  const std::vector<double> from = read_path_end("--from", options.from, options, job);
  const std::vector<double> to = read_path_end("--to", options.to, options, job);
  Worker worker = make_worker(options, job);
  print_notes(job);
  fmt::print("{}", heading(options, job));
  const int different = time_random_configurations(options, job, worker.checker);

  PathChecker paths = path_checker(worker);
  const RobotPathAnswer path = paths.certify(from, to);
  std::set<std::string> hit;
  std::vector<double> shown = to;
  if (path.verdict == PathVerdict::colliding) {
    shown = path.configuration;
    const Answer answer = ask(worker, shown, Mode{Mode::Kind::all}, false);
    for (const auto& [first, second] : named_pairs(worker, answer)) {
      hit.insert(first);
      hit.insert(second);
    }
    fmt::print("motion from {} to {}: collides at t = {:.4f}\n{}", options.from, options.to, path.parameter,
               pair_table(worker, answer, options.max_pairs));
  } else {
    fmt::print("motion from {} to {}: {}\n", options.from, options.to,
               path.is_free() ? "free, proved for every state" : "undecided");
  }

  Picture picture({-0.55, -1.0, 0.45}, {0, 0, 1});
  draw_robot(picture, worker.checker, from, start_colour, {});
  draw_robot(picture, worker.checker, shown, link_colour, hit);
  std::vector<std::string> notes;
  for (const Body& body : job.bodies) draw_shape(picture, shape_of(body, notes), body.pose, body_colour);
  hinge::tool::Svg svg(520, 420);
  svg.text({12, 24}, title(*job.robot, path.verdict), "start", "font-weight=\"bold\"");
  picture.draw(svg, 20, 40, 480, 360);
  hinge::tool::CompleteFile file(options.out);
  file.stream() << svg.document();
  file.finish();
  fmt::print("written: {}\n", options.out);
  print_incomplete(*job.robot);
  return different == 0 ? Exit::free : Exit::bad_input;
}

}  // namespace robocd
