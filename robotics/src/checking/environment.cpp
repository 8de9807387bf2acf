// SPDX-License-Identifier: BSD-3-Clause
// Implements bodies. Each has its own hierarchy with one free group, so a new pose never rebuilds anything.
#include "hinge/robotics/environment.hpp"

#include <algorithm>
#include <array>
#include <string_view>
#include <utility>

#include "approximation/placed_box.hpp"
#include "description/check_description.hpp"
#include "hinge/core/error.hpp"
#include "hinge/core/finite.hpp"
#include "hinge/core/number_text.hpp"
#include "hinge/kinematics/dof_selection.hpp"
#include "hinge/kinematics/rigid_groups.hpp"
#include "hinge/robotics/link_margins.hpp"
#include "hinge/robotics/link_pairs.hpp"
#include "hinge/robotics/robot_description.hpp"
#include "hinge/robotics/tested_pairs.hpp"

namespace hinge::robotics {

namespace {

constexpr std::string_view not_rigid = "not a rigid placement (finite, R R^T = 1, det 1)";

std::string who(std::size_t number, const std::string& name) {
  return "body " + std::to_string(number) + (name.empty() ? "" : " '" + name + "'");
}

/// Returns a root without geometry and one link with the shape, on a joint. Hierarchies place the link by its pose, so
/// it moves freely.
std::shared_ptr<const Robot> robot_of(const Shape& shape, const Tessellation& tessellation) {
  RobotDescription description{"body", {{"ground"}, {"body"}}, {{"pose", JointType::continuous, "ground", "body"}}};
  description.links[1].geometry.push_back({shape});
  return std::make_shared<const Robot>(std::move(description), tessellation);
}

/// Returns the bounds of all triangles in the body's frame, radii included.
Aabb box_of(const Robot& robot) {
  Aabb box;
  for (std::size_t i = 0; i < robot.model().size(); ++i) {
    const Aabb bounds = robot.model().primitives()[i].bounds();
    box.extend(robot.radii().empty() ? bounds : bounds.inflated(robot.radii()[i]));
  }
  return box;
}

}  // namespace

Environment::Environment(double clearance, std::string engine) : clearance_(clearance), engine_(std::move(engine)) {
  if (!is_finite(clearance) || clearance < 0.0)
    throw ModelError("clearance of an environment is " + number_text(clearance) + ": expected a finite length >= 0");
  if (engine_ != "simd" && engine_ != "lazy" && engine_ != "brute")
    throw ModelError("engine '" + engine_ + "': expected simd, lazy or brute");
}

BodyId Environment::add(const Shape& shape, const Pose& pose, std::string name, const Tessellation& tessellation) {
  const std::string label = who(bodies_.size(), name);
  const std::string problem = problem_of(shape);
  if (!problem.empty()) throw ModelError(label + ": " + problem);
  if (!is_rigid(pose)) throw ModelError(label + ": its pose is " + std::string(not_rigid));
  std::shared_ptr<const Robot> robot;
  try {
    robot = robot_of(shape, tessellation);
  } catch (const ModelError& error) {
    throw ModelError(label + ": " + error.what());
  }
  AnyHierarchy hierarchy = make_hierarchy(
      engine_, robot->model(), LinkPairFilter(*robot, LinkPairs(robot->link_count())), LinkMargins(*robot, clearance_));
  const Aabb local = box_of(*robot);
  Body body{std::move(name), std::move(robot), std::move(hierarchy), pose, local};
  place(body, pose);
  bodies_.emplace_back(std::move(body));
  return BodyId{static_cast<std::uint32_t>(bodies_.size() - 1)};
}

void Environment::allow(BodyId body, const std::shared_ptr<const Robot>& robot, const std::vector<LinkId>& links) {
  Body& touched = at(body);
  const std::string label = who(static_cast<std::size_t>(body), touched.name);
  if (robot == nullptr) throw ModelError(label + ": expected a robot whose links may touch it, got none");
  for (const LinkId link : links)
    if (index(link) == 0 || index(link) >= robot->link_count())
      throw ModelError(label + ": may touch link " + std::to_string(index(link)) + ", but robot '" + robot->name() +
                       "' has links 1 to " + std::to_string(robot->link_count() - 1));
  auto known = std::find_if(touched.allowed.begin(), touched.allowed.end(),
                            [&](const Allowed& allowed) { return allowed.robot == robot; });
  if (known == touched.allowed.end())
    known = touched.allowed.insert(known, {robot, std::vector<bool>(robot->link_count(), false)});
  for (const LinkId link : links) known->may_touch[index(link)] = true;
}

std::vector<bool> Environment::may_touch(const Body& body, const Robot& robot) {
  std::vector<bool> links;
  if (held_by(body, &robot)) links = body.attachment->may_touch;
  for (const Allowed& allowed : body.allowed) {
    if (allowed.robot.get() != &robot) continue;
    links.resize(robot.link_count(), false);
    for (std::size_t l = 0; l < links.size(); ++l) links[l] = links[l] || allowed.may_touch[l];
  }
  return links;
}

void Environment::remove(BodyId body) {
  at(body);
  bodies_[static_cast<std::size_t>(body)].reset();
}

void Environment::set_pose(BodyId body, const Pose& pose) {
  Body& moved = at(body);
  const std::string label = who(static_cast<std::size_t>(body), moved.name);
  if (moved.attachment)
    throw ConfigurationError(label + " is attached to link '" +
                             moved.attachment->robot->link_name(moved.attachment->link) + "' of robot '" +
                             moved.attachment->robot->name() + "', expected a detached body");
  if (!is_rigid(pose)) throw ConfigurationError(label + ": its pose is " + std::string(not_rigid));
  place(moved, pose);
}

void Environment::attach(BodyId body, std::shared_ptr<const Robot> robot, LinkId link, const Pose& in_link,
                         std::optional<std::vector<LinkId>> may_touch) {
  Body& held = at(body);
  const std::string label = who(static_cast<std::size_t>(body), held.name);
  if (robot == nullptr) throw ModelError(label + ": expected a robot to attach it to, got none");
  const auto check = [&](LinkId named, const char* what) {
    if (index(named) == 0 || index(named) >= robot->link_count())
      throw ModelError(label + ": " + what + " link " + std::to_string(index(named)) + ", but robot '" + robot->name() +
                       "' has links 1 to " + std::to_string(robot->link_count() - 1));
  };
  check(link, "attached to");
  if (!is_rigid(in_link)) throw ConfigurationError(label + ": its pose in the link is " + std::string(not_rigid));
  const KinematicTree& tree = robot->model().tree();
  const RigidGroups groups(tree, DofSelection::all(tree));
  Attachment attachment{robot, link, in_link, std::vector<bool>(robot->link_count(), false), groups.group_of(link)};
  if (may_touch) {
    for (const LinkId named : *may_touch) {
      check(named, "may touch");
      attachment.may_touch[index(named)] = true;
    }
  } else {
    for (std::size_t l = 1; l < robot->link_count(); ++l)
      attachment.may_touch[l] = groups.group_of(id<LinkId>(l)) == attachment.group;
  }
  held.attachment = std::move(attachment);
}

void Environment::detach(BodyId body) { at(body).attachment.reset(); }

std::optional<LinkId> Environment::attached_to(BodyId body) const {
  const Body& held = at(body);
  if (!held.attachment) return {};
  return held.attachment->link;
}

std::size_t Environment::size() const noexcept {
  return static_cast<std::size_t>(
      std::count_if(bodies_.begin(), bodies_.end(), [](const auto& body) { return body.has_value(); }));
}

std::vector<BodyId> Environment::bodies() const {
  std::vector<BodyId> present;
  for (std::size_t k = 0; k < bodies_.size(); ++k)
    if (bodies_[k]) present.push_back(BodyId{static_cast<std::uint32_t>(k)});
  return present;
}

std::optional<OpenEdge> Environment::open_edge(BodyId body) const { return topology(at(body)).open; }

Environment::Body& Environment::at(BodyId body) {
  std::as_const(*this).at(body);
  return *bodies_[static_cast<std::size_t>(body)];
}

const Environment::Body& Environment::at(BodyId body) const {
  const auto k = static_cast<std::size_t>(body);
  if (k >= bodies_.size() || !bodies_[k])
    throw ModelError(
        "body " + std::to_string(k) +
        (k < bodies_.size() ? " was removed from the environment" : " was never added to the environment"));
  return *bodies_[k];
}

void Environment::place(Body& body, const Pose& pose) {
  std::visit([&](auto& hierarchy) { hierarchy.update_poses(std::array<Pose, 2>{Pose{}, pose}); }, body.hierarchy);
  body.pose = pose;
  body.box = placed_box(body.local, pose);
}

const Environment::Topology& Environment::topology(const Body& body) {
  if (!body.topology) {
    const std::span<const Triangle> mesh = body.shape->model().primitives();
    body.topology = std::make_shared<const Topology>(Topology{robotics::open_edge(mesh), parts(mesh)});
  }
  return *body.topology;
}

}  // namespace hinge::robotics
