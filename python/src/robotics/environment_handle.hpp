// SPDX-License-Identifier: BSD-3-Clause
// EnvironmentHandle: bodies that change while checkers with copies of them are called from many threads.
#pragma once

#include <pybind11/pybind11.h>

#include <condition_variable>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include "hinge/robotics/environment.hpp"
#include "hinge/robotics/tessellate.hpp"
#include "made_caster.hpp"

namespace hinge::python {

/// A copy of an environment for one thread, and how far it has followed the changes of the original.
struct EnvironmentCopy {
  std::optional<robotics::Environment> bodies;
  std::uint64_t epoch = 0;
  std::size_t applied = 0;  ///< number of changes of this epoch
};

/// An environment. Calls that compute hold Use while they run, so a change waits until no call runs: every answer of a
/// call is for one state of the bodies.
class EnvironmentHandle {
 public:
  using MadeByInit = void;
  EnvironmentHandle(double clearance, const std::string& engine, robotics::Tessellation tessellation)
      : bodies_(clearance, engine), tessellation_(tessellation) {}

  /// Keeps the environment as it is. Waits for a change that is under way. The interpreter's lock is held when it is
  /// made; it is released during the wait.
  class Use {
   public:
    explicit Use(EnvironmentHandle* used);  ///< null: nothing is kept
    Use(const Use&) = delete;
    Use& operator=(const Use&) = delete;
    ~Use();

   private:
    EnvironmentHandle* used_;
  };

  /// The original. Constant while a Use exists.
  const robotics::Environment& bodies() const noexcept { return bodies_; }
  const robotics::Tessellation& tessellation() const noexcept { return tessellation_; }
  /// A number that grows with every change.
  std::uint64_t version() const noexcept { return version_; }
  /// Brings the copy to the present state. Call it while a Use exists.
  void follow(EnvironmentCopy& copy) const;

  /// Changes that copies repeat: poses, attachments, what may touch. The interpreter's lock is held at the call; it is
  /// released while other calls end, and Ctrl-C ends the wait. Throws RuntimeError in a progress callback of a call
  /// that uses the environment.
  void change(const std::function<void(robotics::Environment&)>& apply);
  /// Changes after which copies are made anew, because they share what was added.
  void rebuild(const std::function<void(robotics::Environment&)>& apply);

 private:
  /// Changes wait in line before calls that begin later, so they wait for running calls only.
  class Writing;

  robotics::Environment bodies_;
  robotics::Tessellation tessellation_;
  std::uint64_t epoch_ = 1, version_ = 0;
  std::vector<std::function<void(robotics::Environment&)>> changes_;  // of this epoch
  std::mutex mutex_;
  std::condition_variable freed_;
  std::size_t uses_ = 0, waiting_ = 0;  // threads that use the environment; changes that wait
  bool changing_ = false;
};

}  // namespace hinge::python
