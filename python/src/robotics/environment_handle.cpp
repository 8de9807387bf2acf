// SPDX-License-Identifier: BSD-3-Clause
// Implements EnvironmentHandle.
#include "environment_handle.hpp"

#include <chrono>
#include <map>
#include <mutex>
#include <stdexcept>
#include <thread>

namespace hinge::python {

namespace py = pybind11;

namespace {

/// The environments that calls of this thread use, and how many calls.
std::map<const void*, int>& used_here() {
  thread_local std::map<const void*, int> used;
  return used;
}

/// Longer lists of changes are dropped: a copy that is far behind is made anew.
constexpr std::size_t most_changes = 1024;

}  // namespace

EnvironmentHandle::Use::Use(EnvironmentHandle* used) : used_(used) {
  if (used_ == nullptr) return;
  int& calls = used_here()[used_];
  if (calls++ > 0) return;
  std::unique_lock lock(used_->mutex_);
  const auto may_begin = [&] { return !used_->changing_ && used_->waiting_ == 0; };
  if (!may_begin()) {
    lock.unlock();
    const py::gil_scoped_release unlocked;
    lock.lock();
    used_->freed_.wait(lock, may_begin);
    ++used_->uses_;
    lock.unlock();  // before the interpreter's lock is taken: a change holds them in the other order
    return;
  }
  ++used_->uses_;
}

EnvironmentHandle::Use::~Use() {
  if (used_ == nullptr) return;
  const auto found = used_here().find(used_);
  if (--found->second > 0) return;
  used_here().erase(found);
  const std::lock_guard lock(used_->mutex_);
  --used_->uses_;
  used_->freed_.notify_all();
}

class EnvironmentHandle::Writing {
 public:
  explicit Writing(EnvironmentHandle& changed) : changed_(changed) {
    if (used_here().contains(&changed_))
      throw std::runtime_error(
          "environment: changed by a callback of a call that uses it, expected no change until the call ends");
    const auto may_begin = [&] { return !changed_.changing_ && changed_.uses_ == 0; };
    {
      const std::lock_guard lock(changed_.mutex_);
      changed_.changing_ = may_begin();
      if (changed_.changing_) return;
      ++changed_.waiting_;
    }
    while (true) {
      {
        const py::gil_scoped_release unlocked;
        std::unique_lock lock(changed_.mutex_);
        if (changed_.freed_.wait_for(lock, std::chrono::milliseconds(20), may_begin)) {
          changed_.changing_ = true;
          --changed_.waiting_;
          break;
        }
      }
      if (PyErr_CheckSignals() == 0) continue;
      const std::lock_guard lock(changed_.mutex_);
      --changed_.waiting_;
      changed_.freed_.notify_all();
      throw py::error_already_set();
    }
  }
  Writing(const Writing&) = delete;
  Writing& operator=(const Writing&) = delete;
  ~Writing() {
    const std::lock_guard lock(changed_.mutex_);
    changed_.changing_ = false;
    changed_.freed_.notify_all();
  }

 private:
  EnvironmentHandle& changed_;
};

void EnvironmentHandle::follow(EnvironmentCopy& copy) const {
  if (!copy.bodies || copy.epoch != epoch_) {
    copy.bodies.emplace(bodies_);
    copy.epoch = epoch_;
  } else {
    for (std::size_t k = copy.applied; k < changes_.size(); ++k) changes_[k](*copy.bodies);
  }
  copy.applied = changes_.size();
}

void EnvironmentHandle::change(const std::function<void(robotics::Environment&)>& apply) {
  const Writing writing(*this);
  apply(bodies_);  // throws before anything changes
  ++version_;
  if (changes_.size() < most_changes) {
    changes_.push_back(apply);
  } else {
    changes_.clear();
    ++epoch_;
  }
}

void EnvironmentHandle::rebuild(const std::function<void(robotics::Environment&)>& apply) {
  const Writing writing(*this);
  apply(bodies_);
  ++version_;
  ++epoch_;
  changes_.clear();
}

}  // namespace hinge::python
