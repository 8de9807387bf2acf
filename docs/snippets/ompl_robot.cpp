// SPDX-License-Identifier: BSD-3-Clause
// A motion around a post, planned by OMPL. A RobotChecker tests states, and a PathChecker proves motions between
// them.
#include <hinge/robotics/path_checker.hpp>
#include <hinge/robotics/robot_checker.hpp>

#include <ompl/base/MotionValidator.h>

#include <ompl/base/spaces/RealVectorStateSpace.h>
#include <ompl/geometric/SimpleSetup.h>
#include <ompl/geometric/planners/rrt/RRTConnect.h>
#include <ompl/util/Console.h>
#include <ompl/util/RandomNumbers.h>

#include <cstddef>
#include <cstdio>
#include <memory>
#include <span>
#include <string>
#include <utility>

using namespace hinge::robotics;
namespace ob = ompl::base;

using Space = ob::RealVectorStateSpace;

// One object per thread: a checker holds its last state.
class RobotIsFree : public ob::StateValidityChecker {
 public:
  RobotIsFree(const ob::SpaceInformationPtr& space, const RobotChecker& checker)
      : ob::StateValidityChecker(space), checker_(checker) {}
  bool isValid(const ob::State* state) const override {
    const double* values = state->as<Space::StateType>()->values;
    checker_.update(std::span(values, si_->getStateDimension()));
    return si_->satisfiesBounds(state) && !checker_.collides();
  }

 private:
  mutable RobotChecker checker_;
};

// A motion is valid if the whole motion is proved free. No step size is needed.
class MotionIsFree : public ob::MotionValidator {
 public:
  MotionIsFree(const ob::SpaceInformationPtr& space, const RobotChecker& checker)
      : ob::MotionValidator(space), paths_(checker) {}
  bool checkMotion(const ob::State* from, const ob::State* to) const override {
    const bool free = si_->satisfiesBounds(to) && paths_.certify(values(from), values(to)).is_free();
    ++(free ? valid_ : invalid_);
    return free;
  }
  // The reported collision need not be the first one. If a motion is not free, only its start is known to be free.
  bool checkMotion(const ob::State* from, const ob::State* to, std::pair<ob::State*, double>& last) const override {
    if (checkMotion(from, to)) return true;
    if (last.first != nullptr) si_->copyState(last.first, from);
    last.second = 0.0;
    return false;
  }

 private:
  std::span<const double> values(const ob::State* state) const {
    return {state->as<Space::StateType>()->values, si_->getStateDimension()};
  }
  mutable PathChecker paths_;
};

// Three links of 1 m in a plane, and a post 2 m from the base.
RobotDescription arm_and_post() {
  using hinge::Pose, hinge::Mat3, hinge::Vec3;
  const Pose along_x{hinge::rotation_about(Vec3::UnitY(), 1.5707963267948966), Vec3(0.5, 0, 0)};
  RobotDescription arm{"arm", {{"base"}, {"post", {{CylinderShape{0.1, 1.0}}}}}, {}};
  arm.joints.push_back({"stand", JointType::fixed, "base", "post", Pose{Mat3::Identity(), Vec3(2, 0, 0)}});
  for (const char number : {'1', '2', '3'}) {
    const std::string parent = arm.links.size() == 2 ? "base" : arm.links.back().name;
    const std::string link = std::string("link") + number;
    arm.links.push_back({link, {{CapsuleShape{0.05, 0.8}, along_x}}});
    const Pose end{Mat3::Identity(), Vec3(parent == "base" ? 0 : 1, 0, 0)};
    arm.joints.push_back(
        {std::string("joint") + number, JointType::revolute, parent, link, end, Vec3::UnitZ(), -2.5, 2.5});
  }
  return arm;
}

int main() {
  ompl::msg::noOutputHandler();
  ompl::RNG::setSeed(1);
  const auto robot = std::make_shared<const Robot>(arm_and_post());
  const RobotChecker checker(robot, tested_pairs(*robot), LinkMargins(*robot));

  const auto space = std::make_shared<Space>(robot->lower().size());
  ob::RealVectorBounds bounds(space->getDimension());
  bounds.low.assign(robot->lower().begin(), robot->lower().end());
  bounds.high.assign(robot->upper().begin(), robot->upper().end());
  space->setBounds(bounds);

  ompl::geometric::SimpleSetup setup(space);
  const auto information = setup.getSpaceInformation();
  setup.setStateValidityChecker(std::make_shared<RobotIsFree>(information, checker));
  information->setMotionValidator(std::make_shared<MotionIsFree>(information, checker));
  setup.setPlanner(std::make_shared<ompl::geometric::RRTConnect>(information));
  ob::ScopedState<Space> start(space), goal(space);
  start = std::vector{0.6, 0.0, 0.0};
  goal = std::vector{-0.6, 0.0, 0.0};
  setup.setStartAndGoalStates(start, goal);
  setup.setup();

  if (information->checkMotion(start.get(), goal.get())) return 1;  // the post blocks the straight motion
  if (setup.solve(10.0) != ob::PlannerStatus::EXACT_SOLUTION) return 1;
  setup.simplifySolution();
  auto path = setup.getSolutionPath();
  const std::size_t corners = path.getStateCount();
  path.interpolate(1000);
  RobotChecker exact = checker;
  for (const ob::State* state : path.getStates()) {
    exact.update(std::span(state->as<Space::StateType>()->values, space->getDimension()));
    if (exact.collides()) return 1;
  }
  std::printf("%zu motions, each proved free; %zu states of them, none collides\n", corners - 1, path.getStateCount());
  return 0;
}
