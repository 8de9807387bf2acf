// SPDX-License-Identifier: BSD-3-Clause
// MotionSpace: a MotionProblem as OMPL's planners see it, with the tests of its states and motions.
#pragma once

#include <ompl/base/MotionValidator.h>
#include <ompl/base/ScopedState.h>
#include <ompl/base/SpaceInformation.h>
#include <ompl/base/StateValidityChecker.h>
#include <ompl/geometric/PathGeometric.h>
#include <ompl/util/Console.h>

#include <algorithm>
#include <cstdint>
#include <functional>
#include <memory>
#include <mutex>
#include <span>
#include <utility>
#include <vector>

#include "hinge_planning/joint_space.hpp"
#include "hinge_planning/motion_problem.hpp"

namespace hinge::planning {

/// Options of find_motion().
struct MotionSearch {
  double range = 1.0;               ///< longest motion that is added to a tree, in the unit of MotionProblem::distance
  std::uint64_t most_motions = 1;   ///< largest number of motions to test before a first solution
  std::uint64_t seed = 1;           ///< of the random configurations
  std::function<bool()> stop = {};  ///< called before every draw and motion; if it returns true, the search ends
};

using Waypoints = std::vector<std::vector<double>>;

namespace detail {

class StateIsFree : public ompl::base::StateValidityChecker {
 public:
  StateIsFree(const ompl::base::SpaceInformationPtr& information, const MotionProblem& problem)
      : ompl::base::StateValidityChecker(information), problem_(problem) {}
  bool isValid(const ompl::base::State* state) const override { return problem_.is_free(JointSpace::values(state)); }

 private:
  const MotionProblem& problem_;
};

/// What a search demands of a motion.
enum class Proof : std::uint8_t { needed, later };

/// A motion is valid if all of it is proved free, or with Proof::later, if it seems free. After the search was stopped,
/// none is: RRT-Connect asks nothing else while one tree grows towards the other.
class MotionIsFree : public ompl::base::MotionValidator {
 public:
  MotionIsFree(const ompl::base::SpaceInformationPtr& information, const MotionProblem& problem, Proof proof,
               std::function<bool()> stop)
      : ompl::base::MotionValidator(information), problem_(problem), proof_(proof), stop_(std::move(stop)) {}
  bool checkMotion(const ompl::base::State* from, const ompl::base::State* to) const override {
    const std::span<const double> a = JointSpace::values(from), b = JointSpace::values(to);
    const bool free = !(stop_ && stop_()) && (!problem_.seems_free || problem_.seems_free(a, b)) &&
                      (proof_ == Proof::later || problem_.is_motion_free(a, b));
    ++(free ? valid_ : invalid_);
    return free;
  }
  /// Of a motion that is not free only the start is known to be free.
  bool checkMotion(const ompl::base::State* from, const ompl::base::State* to,
                   std::pair<ompl::base::State*, double>& last) const override {
    if (checkMotion(from, to)) return true;
    if (last.first != nullptr) si_->copyState(last.first, from);
    last.second = 0.0;
    return false;
  }

 private:
  const MotionProblem& problem_;
  Proof proof_;
  std::function<bool()> stop_;
};

/// Suppresses OMPL's messages while an object exists, then restores the handler of the program.
class QuietOmpl {
 public:
  QuietOmpl() {
    const std::scoped_lock lock(mutex_);
    if (count_++ > 0) return;
    handler_ = ompl::msg::getOutputHandler();
    ompl::msg::noOutputHandler();
  }
  ~QuietOmpl() {
    const std::scoped_lock lock(mutex_);
    if (--count_ == 0) ompl::msg::useOutputHandler(handler_);
  }
  QuietOmpl(const QuietOmpl&) = delete;
  QuietOmpl& operator=(const QuietOmpl&) = delete;

 private:
  inline static std::mutex mutex_;
  inline static int count_ = 0;
  inline static ompl::msg::OutputHandler* handler_ = nullptr;
};

/// The state space of a problem, with the tests of its states and motions.
class MotionSpace {
 public:
  /// Both must outlive this object.
  MotionSpace(const MotionProblem& problem, const MotionSearch& search, Proof proof = Proof::needed)
      : information_(
            std::make_shared<ompl::base::SpaceInformation>(std::make_shared<JointSpace>(problem, search.seed))),
        motions_(std::make_shared<MotionIsFree>(information_, problem, proof, search.stop)) {
    information_->setStateValidityChecker(std::make_shared<StateIsFree>(information_, problem));
    information_->setMotionValidator(motions_);
    information_->setup();
  }
  const ompl::base::SpaceInformationPtr& information() const { return information_; }
  /// Number of motions that were tested.
  std::uint64_t tested() const {
    return std::uint64_t{motions_->getValidMotionCount()} + motions_->getInvalidMotionCount();
  }
  ompl::base::ScopedState<> state(std::span<const double> q) const {
    ompl::base::ScopedState<> made(information_);
    std::ranges::copy(q, JointSpace::values(made.get()).begin());
    return made;
  }
  static Waypoints waypoints(const ompl::geometric::PathGeometric& path) {
    Waypoints all;
    for (std::size_t k = 0; k < path.getStateCount(); ++k) {
      const std::span<const double> q = JointSpace::values(path.getState(static_cast<unsigned>(k)));
      all.emplace_back(q.begin(), q.end());
    }
    return all;
  }

 private:
  QuietOmpl quiet_;
  ompl::base::SpaceInformationPtr information_;
  std::shared_ptr<MotionIsFree> motions_;
};

}  // namespace detail

}  // namespace hinge::planning
