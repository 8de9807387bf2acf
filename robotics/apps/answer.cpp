// SPDX-License-Identifier: BSD-3-Clause
// The robot first, then the bodies around it.
#include "answer.hpp"

#include <memory>

#include "hinge/robotics/link_margins.hpp"
#include "hinge/robotics/read_mesh.hpp"

namespace robocd {

using namespace hinge::robotics;

Worker make_worker(const Options& options, const Job& job) {
  const LinkMargins margins(*job.robot, options.clearance);
  Worker worker{RobotChecker(job.robot, job.tested, margins, CheckOptions{options.engine}), {}};
  if (options.environment.empty()) return worker;
  worker.environment.emplace(options.clearance, options.engine);
  for (const std::string& file : options.environment)
    worker.environment->add(std::make_shared<const TriangleMesh>(read_mesh(file)), {}, file);
  return worker;
}

Answer ask(Worker& worker, std::span<const double> q, const Mode& mode, bool contained) {
  RobotChecker& checker = worker.checker;
  Answer answer;
  answer.self = checker.check(q, mode);
  answer.collides = answer.self.collides;
  if (worker.environment) {
    Environment& environment = *worker.environment;
    switch (mode.kind) {
      case Mode::Kind::any: answer.collides = answer.collides || checker.collides(environment); break;
      case Mode::Kind::all: answer.body_pairs = checker.collisions(environment); break;
      case Mode::Kind::within: answer.body_pairs = checker.within(environment, mode.margin); break;
      case Mode::Kind::closest: answer.closest_body = checker.closest(environment); break;
    }
    // What is within a margin need not collide.
    if (mode.kind == Mode::Kind::within && !answer.body_pairs.empty())
      answer.collides = answer.collides || checker.collides(environment);
    if (mode.kind == Mode::Kind::all) answer.collides = answer.collides || !answer.body_pairs.empty();
    if (answer.closest_body)
      answer.collides = answer.collides || answer.closest_body->gap < 0.0 || answer.closest_body->distance == 0.0;
  }
  if (contained) {
    answer.contained = checker.contained();
    if (worker.environment) answer.contained_bodies = checker.contained(*worker.environment);
    answer.collides = answer.collides || !answer.contained.empty() || !answer.contained_bodies.empty();
  }
  return answer;
}

std::vector<std::string> open_meshes(Worker& worker) {
  std::vector<std::string> notes;
  const auto note = [&](const std::string& who, const OpenEdge& edge) {
    notes.push_back(who + " has an open mesh, nothing is looked for inside it: " + edge.text());
  };
  for (const OpenLink& open : worker.checker.not_closed())
    note("link '" + worker.checker.robot().link_name(open.link) + "'", open.edge);
  if (!worker.environment) return notes;
  for (const BodyId body : worker.environment->bodies())
    if (const auto edge = worker.environment->open_edge(body)) note(worker.environment->name(body), *edge);
  return notes;
}

}  // namespace robocd
