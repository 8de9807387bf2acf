// SPDX-License-Identifier: BSD-3-Clause
// The clock that measures how long something takes, and a time limit.
#pragma once

#include <chrono>
#include <optional>

namespace hinge::tool {

using Clock = std::chrono::steady_clock;

inline double seconds_since(Clock::time_point start) {
  return std::chrono::duration<double>(Clock::now() - start).count();
}

/// A call returns whether `seconds` have passed since construction. Without seconds, it returns false.
class TimeLimit {
 public:
  explicit TimeLimit(std::optional<double> seconds) : seconds_(seconds) {}
  bool operator()() const { return seconds_ && seconds_since(start_) >= *seconds_; }

 private:
  std::optional<double> seconds_;
  Clock::time_point start_ = Clock::now();
};

}  // namespace hinge::tool
