// SPDX-License-Identifier: BSD-3-Clause
// Implements ask() and the worker: the robot first, then the bodies around it.
#include "answer.hpp"

#include <map>
#include <string>
#include <variant>

#include "bodies.hpp"
#include "hinge/core/error.hpp"
#include "hinge/core/id.hpp"
#include "hinge/kinematics/dof_selection.hpp"
#include "hinge/kinematics/rigid_groups.hpp"
#include "hinge/robotics/containment.hpp"
#include "hinge/robotics/link_margins.hpp"
#include "hinge/robotics/tessellate.hpp"

namespace robocd {

using namespace hinge::robotics;

Worker make_worker(const Options& options, Job& job) {
  const LinkMargins margins(*job.robot, options.clearance);
  Worker worker{RobotChecker(job.robot, job.tested, margins, CheckOptions{options.engine}), {}};
  if (options.environment.empty()) return worker;
  worker.environment.emplace(options.clearance, options.engine);
  std::map<std::string, std::vector<BodyId>> named;
  for (const Body& body : job.bodies) {
    Shape shape = shape_of(body, job.notes);
    auto* mesh = std::get_if<MeshShape>(&shape);
    if (options.contained && mesh != nullptr) mesh->solid = closed(tessellate(*mesh).triangles);
    try {
      const hinge::Pose in_world = body.holder ? hinge::Pose() : body.pose;
      const BodyId id = worker.environment->add(shape, in_world, body.name, job.robot->tessellation());
      if (body.holder) worker.environment->attach(id, job.robot, *job.robot->find_link(*body.holder), body.pose);
      named[body.name].push_back(id);
    } catch (const hinge::ModelError& error) {
      throw hinge::ModelError("--env: " + std::string(error.what()));
    }
  }
  for (const auto& [link, body] : job.allowed)
    for (const BodyId id : named.at(body)) worker.environment->allow(id, job.robot, {*job.robot->find_link(link)});
  return worker;
}

PathChecker path_checker(const Worker& worker) {
  return worker.environment ? PathChecker(worker.checker, *worker.environment) : PathChecker(worker.checker);
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
      case Mode::Kind::within:
        answer.body_pairs = checker.within(environment, mode.margin);
        answer.body_distances = checker.distances(environment, mode.margin);
        break;
      case Mode::Kind::closest: answer.closest_body = checker.closest(environment); break;
    }
    // Pairs within a margin need not collide.
    if (mode.kind == Mode::Kind::within && !answer.body_pairs.empty())
      answer.collides = answer.collides || checker.collides(environment);
    if (mode.kind == Mode::Kind::all) answer.collides = answer.collides || !answer.body_pairs.empty();
    if (answer.closest_body)
      answer.collides = answer.collides || answer.closest_body->gap < 0.0 || answer.closest_body->distance == 0.0;
  }
  // With --contained closed meshes are solid, so containment implies a collision.
  if (contained && answer.collides) {
    answer.contained = checker.contained();
    if (worker.environment) answer.contained_bodies = checker.contained(*worker.environment);
  }
  return answer;
}

std::vector<std::string> notes_on_bodies(const Options& options, Worker& worker) {
  std::vector<std::string> notes;
  if (!worker.environment) return notes;
  Environment& environment = *worker.environment;
  if (options.contained)
    for (const BodyId body : environment.bodies())
      if (const auto edge = environment.open_edge(body); edge && environment.triangle_count(body) > 1)
        notes.push_back(environment.name(body) +
                        " has an open mesh, so containment in it is not tested: " + edge->text());
  const Robot& robot = worker.checker.robot();
  const hinge::KinematicTree& tree = robot.model().tree();
  const hinge::RigidGroups groups(tree, hinge::DofSelection::all(tree));
  for (const BodyContact& contact : worker.checker.collisions(environment)) {
    if (groups.group_of(contact.link) != hinge::GroupId{0}) continue;
    if (contact.held || environment.attached_to(contact.body)) continue;  // one of the two may move
    const std::string &link = robot.link_name(contact.link), &body = environment.name(contact.body);
    notes.push_back("link '" + link + "' never moves and collides with body '" + body +
                    "' in every configuration; --allow '" + link + "' '" + body + "' leaves this pair out");
  }
  return notes;
}

}  // namespace robocd
