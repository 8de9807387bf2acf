// SPDX-License-Identifier: BSD-3-Clause
// TimeLimit: ends a search after a time, and looks for Ctrl-C.
#pragma once

#include <chrono>
#include <optional>

#include "run_slices.hpp"

namespace hinge::python {

/// The time starts when it is made.
class TimeLimit {
 public:
  /// seconds: 0 to 1e9; empty: no limit.
  explicit TimeLimit(std::optional<double> seconds) {
    using Clock = std::chrono::steady_clock;
    if (seconds)
      end_ = Clock::now() + std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(*seconds));
  }
  /// Calls poll(). Returns true if the time has passed.
  bool has_passed() const {
    poll();
    return end_ && std::chrono::steady_clock::now() >= *end_;
  }

 private:
  std::optional<std::chrono::steady_clock::time_point> end_;
};

}  // namespace hinge::python
