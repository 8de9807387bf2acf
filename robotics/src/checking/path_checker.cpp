// SPDX-License-Identifier: BSD-3-Clause
// Implements PathChecker: bodies become links on fixed joints of one robot. Only this file instantiates CertifiedPath
// for robots.
#include "hinge/robotics/path_checker.hpp"

#include <algorithm>
#include <array>
#include <span>
#include <string>
#include <utility>

#include "checking/find_inside.hpp"
#include "hinge/core/pose.hpp"
#include "hinge/kinematics/dof_selection.hpp"
#include "hinge/kinematics/rigid_groups.hpp"
#include "hinge/path/check_sampled.hpp"
#include "hinge/query/collectors.hpp"
#include "hinge/robotics/environment.hpp"
#include "hinge/robotics/link_pairs.hpp"
#include "hinge/robotics/robot_checker.hpp"
#include "hinge/robotics/robot_description.hpp"

namespace hinge::robotics {

struct PathChecker::Scene {
  std::shared_ptr<const Robot> robot;
  std::vector<LinkOrBody> owners;  // by link
  LinkPairs tested;
  LinkMargins margins;
  std::optional<PathContact> always;
};

namespace {

/// A hierarchy whose yes/no query also finds links inside solids.
struct WithInsides {
  RobotHierarchy<Simd>& surfaces;
  const SolidPairs& pairs;
  const Robot& robot;
  std::vector<std::array<double, 3>> scratch{};

  std::size_t dof_count() const noexcept { return surfaces.dof_count(); }
  void update(std::span<const double> q) { surfaces.update(q); }
  template <class C>
  void self_query(C& collector) {
    surfaces.self_query(collector);
    if (!collector.done()) add_insides(collector);
  }
  template <class C>
  void add_insides(C& collector) {
    pairs.find(surfaces, robot, scratch, [&](const Inside& inside) {
      collector.add(inside.hit(surfaces.matrix().clearance(inside.outer, inside.inner)));
      return collector.done();
    });
  }
};

std::vector<LinkOrBody> own_links(const Robot& robot) {
  std::vector<LinkOrBody> owners;
  for (std::size_t l = 0; l < robot.link_count(); ++l) owners.emplace_back(id<LinkId>(l));
  return owners;
}

/// Returns a name that no link and no joint has.
std::string new_name(const Robot& robot, std::size_t number) {
  std::string name = "body ";
  name += std::to_string(number);
  while (robot.find_link(name) || robot.find_joint(name)) name += '\'';
  return name;
}

}  // namespace

PathChecker::Scene PathChecker::with_bodies(const RobotChecker& checker, const Environment& environment) {
  const Robot& alone = checker.robot();
  const auto held_by_this = [&](const Environment::Body& body) { return Environment::held_by(body, &alone); };
  const std::vector<BodyId> bodies = environment.bodies();
  std::vector<LinkOrBody> owners = own_links(alone);
  RobotDescription description = alone.description();
  for (const BodyId name : bodies) {
    const Environment::Body& body = environment.at(name);
    const std::string link = new_name(alone, owners.size());
    const bool held = held_by_this(body);
    // The frame of the root link is the base.
    const Pose pose = checker.base() == Pose{} ? body.pose : checker.base().inverse() * body.pose;
    description.links.push_back({link, body.shape->description().links.back().geometry});
    description.joints.push_back({link, JointType::fixed, alone.link_name(held ? body.attachment->link : id<LinkId>(1)),
                                  link, held ? body.attachment->in_link : pose});
    owners.emplace_back(name);
  }
  // The joints of the bodies come last, so the other links keep their ids.
  auto robot = std::make_shared<const Robot>(std::move(description), alone.tessellation());

  LinkPairs tested(robot->link_count());
  std::vector<PairClearance> clearances;
  const KinematicTree& tree = robot->model().tree();
  const RigidGroups groups(tree, DofSelection::all(tree));
  const double own = checker.margins().clearance();
  const auto test = [&](LinkId a, LinkId b, double clearance) {
    if (groups.group_of(a) == groups.group_of(b)) return;  // never move against each other: tested once, see `always`
    tested.insert(a, b);
    if (clearance != own) clearances.push_back({a, b, clearance});
  };
  for (const auto& [a, b] : checker.tested().list()) test(a, b, checker.margins().clearance(a, b));
  const auto link_of = [&](std::size_t k) { return id<LinkId>(alone.link_count() + k); };
  for (std::size_t k = 0; k < bodies.size(); ++k) {
    const Environment::Body& body = environment.at(bodies[k]);
    const std::vector<bool> may_touch = Environment::may_touch(body, alone);
    for (std::size_t l = 1; l < alone.link_count(); ++l)
      if (alone.triangle_count(id<LinkId>(l)) > 0 && (may_touch.empty() || !may_touch[l]))
        test(id<LinkId>(l), link_of(k), std::max(own, environment.clearance()));
    for (std::size_t other = 0; other < k; ++other)
      if (held_by_this(body) || held_by_this(environment.at(bodies[other])))
        test(link_of(other), link_of(k), environment.clearance());
  }

  std::optional<PathContact> always;
  RobotChecker asked = checker;
  Environment around = environment;
  const auto body_link = [&](BodyId body) {
    return link_of(static_cast<std::size_t>(std::find(bodies.begin(), bodies.end(), body) - bodies.begin()));
  };
  for (const BodyContact& found : asked.collisions(around)) {
    const LinkId first = found.held ? body_link(*found.held) : found.link, second = body_link(found.body);
    if (groups.group_of(first) == groups.group_of(second))
      always = PathContact{owners[index(first)], owners[index(second)], found.hit.distance, found.hit.threshold};
  }
  LinkMargins margins(*robot, own, clearances);
  return {std::move(robot), std::move(owners), std::move(tested), std::move(margins), always};
}

PathChecker::PathChecker(const RobotChecker& checker)
    : PathChecker(checker, {},
                  Scene{checker.shared_robot(), own_links(checker.robot()), checker.tested(), checker.margins(), {}}) {}

PathChecker::PathChecker(const RobotChecker& checker, const Environment& environment)
    : PathChecker(checker, environment, with_bodies(checker, environment)) {}

PathChecker::PathChecker(const RobotChecker& checker, std::optional<Environment> bodies, Scene scene)
    : checker_(checker),
      bodies_(std::move(bodies)),
      robot_(std::move(scene.robot)),
      owners_(std::move(scene.owners)),
      always_(scene.always),
      hierarchy_(robot_->model(), LinkPairFilter(*robot_, std::move(scene.tested)), std::move(scene.margins)),
      solid_pairs_(std::make_shared<const SolidPairs>(hierarchy_, *robot_, hierarchy_.filter().tested())),
      certified_(hierarchy_) {}

bool PathChecker::is_free(std::span<const double> q) {
  checker_.update(q);
  return !checker_.collides() && !(bodies_ && checker_.collides(*bodies_));
}

PathContact PathChecker::contact(const Hit& hit) const {
  const auto owner = [&](PrimitiveId i) { return owners_[index(robot_->model().links()[index(i)])]; };
  return {owner(hit.first), owner(hit.second), hit.distance, hit.threshold};
}

template <class Check>
RobotPathAnswer PathChecker::answer(std::span<const double> from, std::span<const double> to, const Check& check) {
  const std::vector<double> first = robot_->expand(from), last = robot_->expand(to);
  RobotPathAnswer answer;
  if (always_) {
    answer.verdict = PathVerdict::colliding;
    answer.configuration.assign(from.begin(), from.end());
    answer.contact = always_;
    return answer;
  }
  const PathAnswer found = check(first, last);
  answer.counts = found.counts;
  answer.verdict = found.verdict;
  answer.parameter = found.parameter;
  answer.half_width = found.half_width;
  if (!found.is_free()) StraightPath(from, to, from.size()).at(found.parameter, answer.configuration);
  if (found.hit) answer.contact = contact(*found.hit);
  return answer;
}

RobotPathAnswer PathChecker::certify(std::span<const double> from, std::span<const double> to, double smallest_step,
                                     const std::function<void()>& between) {
  check_smallest_step(smallest_step);
  return answer(from, to, [&](const std::vector<double>& a, const std::vector<double>& b) {
    // While surfaces stay apart, no component enters or leaves a solid. One test at the start is enough.
    PathAnswer at_start;
    hierarchy_.update(a);
    AnyHit inside;
    WithInsides{hierarchy_, *solid_pairs_, *robot_}.add_insides(inside);
    if (!inside.done()) return certified_.check(a, b, smallest_step, between);
    at_start.verdict = PathVerdict::colliding;
    at_start.counts.configurations = 1;
    at_start.configuration = a;
    at_start.hit = inside.hit();
    return at_start;
  });
}

RobotPathAnswer PathChecker::sample(std::span<const double> from, std::span<const double> to, double resolution,
                                    const std::function<void()>& between) {
  count_steps(StraightPath(robot_->expand(from), robot_->expand(to), hierarchy_.dof_count()), resolution);
  return answer(from, to, [&](const std::vector<double>& a, const std::vector<double>& b) {
    WithInsides scene{hierarchy_, *solid_pairs_, *robot_};
    return check_sampled(scene, a, b, resolution, between);
  });
}

}  // namespace hinge::robotics
