// SPDX-License-Identifier: BSD-3-Clause
// Implements the state of RobotChecker and its queries of the robot against itself.
#include "hinge/robotics/robot_checker.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "approximation/between.hpp"
#include "checking/closeness.hpp"
#include "checking/contacts.hpp"
#include "checking/find_inside.hpp"
#include "checking/free_in_world.hpp"
#include "hinge/core/error.hpp"
#include "hinge/core/number_text.hpp"
#include "hinge/kinematics/dof_selection.hpp"
#include "hinge/kinematics/joint.hpp"
#include "hinge/kinematics/rigid_groups.hpp"
#include "hinge/query/collectors.hpp"

namespace hinge::robotics {

namespace {

/// Above this value (rad or m) a sum along a chain of prismatic joints may overflow.
constexpr double largest_value = 1e300;

/// Of the first `queries_observed` yes/no queries, some calibrate the order of pairs. Sixteen calibrations are nearly
/// as good as 300 (docs/development/robots.md).
constexpr std::size_t queries_observed = 256, queries_per_calibration = 16;

std::shared_ptr<const Robot> checked(std::shared_ptr<const Robot> robot) {
  if (robot == nullptr) throw ModelError("robot checker: expected a robot, got none");
  return robot;
}

/// Returns the bounds of the triangles of every link, in the link's frame, radii included.
std::vector<Aabb> local_boxes_of(const Robot& robot, const LinkMargins& margins) {
  std::vector<Aabb> boxes(robot.link_count());
  for (std::size_t i = 0; i < robot.model().size(); ++i) {
    const Aabb box = robot.model().primitives()[i].bounds();
    const double radius = margins.radius(id<PrimitiveId>(i));
    boxes[index(robot.model().links()[i])].extend(radius > 0.0 ? box.inflated(radius) : box);
  }
  return boxes;
}

}  // namespace

RobotChecker::RobotChecker(std::shared_ptr<const Robot> robot, LinkPairs tested, LinkMargins margins,
                           const CheckOptions& options)
    : robot_(checked(std::move(robot))),
      filter_(*robot_, std::move(tested)),
      margins_(std::move(margins)),
      engine_(options.engine),
      hierarchy_(make_hierarchy(engine_, robot_->model(), filter_, margins_)),
      full_(robot_->model().tree().dof_count()),
      link_hits_(robot_->model().links()),
      local_boxes_(std::make_shared<const std::vector<Aabb>>(local_boxes_of(*robot_, margins_))) {
  find_solid_pairs();
  fits_sphere_batch_ = fits_sphere_batch();
  update(std::vector<double>(robot_->independent_joints().size(), 0.0));
}

void RobotChecker::find_solid_pairs() {
  solid_pairs_ = std::visit(
      [&](const auto& hierarchy) { return std::make_shared<const SolidPairs>(hierarchy, *robot_, filter_.tested()); },
      *hierarchy_);
}

void RobotChecker::expand(std::span<const double> independent, std::span<double> full) const {
  robot_->expand(independent, full);
  for (std::size_t d = 0; d < full.size(); ++d)
    if (!(std::abs(full[d]) <= largest_value))
      throw ConfigurationError("joint '" + robot_->description().joints[robot_->joint_of(id<DofId>(d))].name +
                               "' takes the value " + number_text(full[d]) +
                               ", expected a finite number of at most 1e300");
}

void RobotChecker::update(std::span<const double> independent) {
  next_.resize(full_.size());
  expand(independent, next_);
  if (kinematics_) {
    kinematics_->set_configuration(next_);
    try {
      place(*hierarchy_, base_, *kinematics_);
    } catch (const ConfigurationError&) {
      kinematics_->set_configuration(full_);
      throw;
    }
  } else {
    std::visit([&](auto& hierarchy) { hierarchy.update(next_); }, *hierarchy_);
  }
  full_.swap(next_);
  link_boxes_stand_ = false;
}

void RobotChecker::set_base(const Pose& base) {
  if (!is_rigid(base))
    throw ConfigurationError("base of robot '" + robot_->name() +
                             "': not a rigid placement (finite, R R^T = 1, det 1)");
  if (!kinematics_) {
    const KinematicTree& tree = robot_->model().tree();
    detail::ForwardKinematics kinematics(std::make_shared<const RigidGroups>(tree, DofSelection::all(tree)),
                                         tree.dof_count());
    kinematics.set_configuration(full_);
    AnyHierarchy hierarchy = make_hierarchy(engine_, free_in_world(robot_->model()), filter_, margins_);
    place(hierarchy, base, kinematics);
    hierarchy_ = std::move(hierarchy);
    kinematics_ = std::move(kinematics);
    find_solid_pairs();
  } else {
    place(*hierarchy_, base, *kinematics_);
  }
  base_ = base;
  link_boxes_stand_ = false;
}

void RobotChecker::place(AnyHierarchy& hierarchy, const Pose& base, detail::ForwardKinematics& kinematics) {
  std::visit(
      [&](auto& h) {
        // Group 0 is the world, then follow the groups of the robot.
        poses_.assign(1, Pose{});
        for (std::size_t g = 0; g + 1 < h.model().groups()->size(); ++g)
          poses_.push_back(base * kinematics.pose(id<GroupId>(g)));
        h.update_poses(poses_);
      },
      hierarchy);
}

Pose RobotChecker::link_pose(LinkId link) {
  if (index(link) >= robot_->link_count())
    throw ModelError("link " + std::to_string(index(link)) + ": robot '" + robot_->name() + "' and the world have " +
                     std::to_string(robot_->link_count()) + " links");
  return std::visit([&](auto& hierarchy) { return hierarchy.link_pose(link); }, *hierarchy_);
}

void RobotChecker::calibrate_pair_order() {
  std::visit([](auto& hierarchy) { hierarchy.calibrate_pair_order(); }, *hierarchy_);
}

template <class Found>
bool RobotChecker::find_insides(const Found& found) {
  return std::visit([&](auto& hierarchy) { return solid_pairs_->find(hierarchy, *robot_, solid_centres_, found); },
                    *hierarchy_);
}

bool RobotChecker::any_inside() {
  return find_insides([](const Inside&) { return true; });
}

bool RobotChecker::collides() {
  if (queries_ < queries_observed && ++queries_ % queries_per_calibration == 0) calibrate_pair_order();
  return std::visit([](auto& hierarchy) { return hierarchy.self_collides(); }, *hierarchy_) || any_inside();
}

std::vector<LinkContact> RobotChecker::within(double margin) {
  std::vector<LinkContact> contacts = surfaces_within(margin);
  find_insides([&](const Inside& inside) {
    const auto [a, b] = std::minmax(inside.outer, inside.inner);
    put_contact(contacts, {a, b, inside.hit(margins_.clearance(a, b))});
    return false;
  });
  return contacts;
}

std::vector<LinkContact> RobotChecker::surfaces_within(double margin) {
  check_margin(margin);
  const auto ask = [&](LinkPairHits& found) {
    std::visit([&](auto& hierarchy) { hierarchy.self_query(found); }, *hierarchy_);
    std::vector<LinkContact> contacts;
    const std::span<const LinkId> links = robot_->model().links();
    for (const Hit& hit : found.hits()) contacts.push_back({links[index(hit.first)], links[index(hit.second)], hit});
    return contacts;
  };
  if (margin > 0.0) {
    LinkPairHits found(robot_->model().links(), margin);
    return ask(found);
  }
  link_hits_.clear();
  return ask(link_hits_);
}

std::vector<Hit> RobotChecker::triangle_pairs() {
  return std::visit([](auto& hierarchy) { return hierarchy.self_collisions(); }, *hierarchy_);
}

std::optional<ClosestLinks> RobotChecker::closest_surfaces(AnyHierarchy& any) {
  const std::span<const LinkId> links = robot_->model().links();
  return std::visit(
      [&](auto& hierarchy) -> std::optional<ClosestLinks> {
        std::optional<Hit> hit = hierarchy.self_closest();
        if (!hit) return {};
        Closeness found = measure(hierarchy, hierarchy, *hit, margins_.sum(hit->first, hit->second));
        if (!found.collides) {
          // Because of rounding, another pair may be a hit although its gap is slightly larger.
          AnyHit meeting;
          hierarchy.self_query(meeting);
          if (meeting.done()) {
            hit = meeting.hit();
            found = measure(hierarchy, hierarchy, *hit, margins_.sum(hit->first, hit->second));
          }
        }
        return answer(links[index(hit->first)], links[index(hit->second)], *hit, found);
      },
      any);
}

std::optional<ClosestLinks> RobotChecker::closest() {
  std::optional<ClosestLinks> best = closest_surfaces(*hierarchy_);
  if (best && is_far(*best)) {
    const Pose frame = place_nearby(best->link1);
    if (const auto closer = closest_surfaces(*nearby_)) take_nearby(*best, *closer, frame);
  }
  find_insides([&](const Inside& inside) {
    const auto [a, b] = std::minmax(inside.outer, inside.inner);
    take_closer(best, {a, b, inside.hit(margins_.clearance(a, b))}, inside.point);
    return false;
  });
  return best;
}

Verdict RobotChecker::check(std::span<const double> independent, const Mode& mode) {
  update(independent);
  Verdict verdict;
  switch (mode.kind) {
    case Mode::Kind::any: verdict.collides = collides(); break;
    case Mode::Kind::all:
      verdict.pairs = colliding_links();
      verdict.collides = !verdict.pairs.empty();
      break;
    case Mode::Kind::within:
      verdict.pairs = within(mode.margin);
      verdict.distances = distances(mode.margin);
      // A margin may list pairs that do not collide, so the verdict needs its own query.
      verdict.collides = collides();
      break;
    case Mode::Kind::closest:
      verdict.closest = closest();
      verdict.collides = verdict.closest && verdict.closest->collides();
      break;
  }
  return verdict;
}

}  // namespace hinge::robotics
