// SPDX-License-Identifier: BSD-3-Clause
// RobotCheckerHandle: a robot's checker as Python holds it, with its environment; many threads may call it at once.
#pragma once

#include <pybind11/pybind11.h>

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "arrays.hpp"
#include "environment_handle.hpp"
#include "hinge/core/error.hpp"
#include "hinge/robotics/path_checker.hpp"
#include "hinge/robotics/robot_checker.hpp"
#include "robot_handle.hpp"
#include "run_slices.hpp"
#include "worker_pool.hpp"

namespace hinge::python {

/// The data of one thread.
struct RobotWorker {
  robotics::RobotChecker checker;
  EnvironmentCopy around{};

  /// Calls checker.update() and names configuration k in its error.
  void update(const Configurations& q, std::size_t k, const char* name = "q") {
    try {
      checker.update(q[k]);
    } catch (const ConfigurationError& error) {
      throw ConfigurationError(std::string(name) + (q.one ? "" : "[" + std::to_string(k) + "]") + ": " + error.what());
    }
  }
};

using RobotPool = WorkerPool<RobotWorker>;
using PathPool = WorkerPool<robotics::PathChecker>;

/// A row of the structured arrays of pairs. first, second: rows of Robot.links; from link_count on: bodies.
struct LinkPairRow {
  std::int64_t configuration;
  std::int32_t first, second;
  std::uint32_t triangle1, triangle2;
  double distance, threshold;
};

/// A row with the closest points of a pair.
struct LinkDistanceRow {
  std::int64_t configuration;
  std::int32_t first, second;
  std::uint32_t triangle1, triangle2;
  double distance, gap;
  double point1[3], point2[3], normal[3];
  bool collides;
  Padding<7> padding{};
};

/// What a call asks about: the robot against itself, against the bodies, or both.
struct Against {
  bool self = true, bodies = true;
};

/// Throws ValueError for another text than "all", "self" and "environment".
Against as_against(const std::string& text);

/// A checker. What changes it (set_base, allow, calibrate) puts another pool in place, so running calls keep theirs.
struct RobotCheckerHandle {
  using MadeByInit = void;
  RobotHandle robot;
  std::shared_ptr<RobotPool> pool;
  std::shared_ptr<EnvironmentHandle> environment;  ///< may be null
  unsigned threads = 1;                            ///< default of calls

  std::size_t dof() const noexcept { return robot.dof(); }
  const robotics::RobotChecker& checker() const noexcept { return pool->prototype().checker; }
  /// Uses another checker from now on.
  void replace(const robotics::RobotChecker& checker);
  std::int32_t body_row(robotics::BodyId body) const noexcept {
    return static_cast<std::int32_t>(robot->link_count() - 1 + static_cast<std::size_t>(body));
  }
  /// Row of the robot's side of a contact with a body: the body that it holds, or its link.
  template <class Contact>
  std::int32_t own_row(const Contact& contact) const noexcept {
    return contact.held ? body_row(*contact.held) : link_row(contact.link);
  }

  /// Checkers of paths through the present environment, made when first needed. The interpreter's lock is held. Call it
  /// while a Use exists.
  std::shared_ptr<PathPool> path_checkers(const std::shared_ptr<RobotPool>& of);

 private:
  std::shared_ptr<PathPool> paths_;  // this and the next: guarded by the interpreter's lock
  std::shared_ptr<const RobotPool> paths_of_;
  std::shared_ptr<const EnvironmentHandle> paths_through_;
  std::uint64_t paths_at_ = 0;
};

/// What one call works with: the pool and the environment as they are at its start. Made with the interpreter's lock.
class RobotCall {
 public:
  explicit RobotCall(RobotCheckerHandle& handle)
      : pool_(handle.pool), environment_(handle.environment), use_(environment_.get()) {}

  RobotPool& pool() noexcept { return *pool_; }
  const std::shared_ptr<RobotPool>& shared_pool() const noexcept { return pool_; }
  /// Returns the environment of this worker at its present state, or null if there are no bodies.
  robotics::Environment* bodies(RobotWorker& worker) const {
    if (environment_ == nullptr || environment_->bodies().size() == 0) return nullptr;
    environment_->follow(worker.around);
    return &*worker.around.bodies;
  }

 private:
  std::shared_ptr<RobotPool> pool_;
  std::shared_ptr<EnvironmentHandle> environment_;
  EnvironmentHandle::Use use_;
};

/// Calls work(worker, bodies, k) for every k < count, on several threads; bodies may be null.
template <class Work>
void run_robot(RobotCheckerHandle& handle, std::size_t count, const pybind11::object& threads,
               const pybind11::object& progress, const Work& work) {
  RobotCall call(handle);
  run_slices(call.pool(), count, as_threads(threads, handle.threads), progress,
             [&](RobotWorker& worker, std::size_t first, std::size_t last) {
               robotics::Environment* bodies = call.bodies(worker);
               for (std::size_t k = first; k < last; ++k) work(worker, bodies, k);
             });
}

/// Joins the rows of all configurations, in their order, as an array.
template <class Row>
pybind11::array_t<Row> joined_rows(const std::vector<std::vector<Row>>& rows) {
  std::vector<Row> all;
  std::size_t count = 0;
  for (const auto& some : rows) count += some.size();
  all.reserve(count);
  for (const auto& some : rows) all.insert(all.end(), some.begin(), some.end());
  return to_array(std::move(all));
}

LinkDistanceRow distance_row(std::size_t configuration, const robotics::ClosestLinks& found);

using RobotCheckerClass = pybind11::class_<RobotCheckerHandle>;
void add_robot_pairs(RobotCheckerClass& checker);  ///< pairs, distances, containment
void add_clearances(RobotCheckerClass& checker);   ///< distances with derivatives
void add_robot_paths(RobotCheckerClass& checker);
void add_robot_relaxation(RobotCheckerClass& checker);
void add_robot_planning(RobotCheckerClass& checker);
void add_two_robots(RobotCheckerClass& checker);

}  // namespace hinge::python
