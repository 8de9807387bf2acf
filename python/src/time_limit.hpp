// SPDX-License-Identifier: BSD-3-Clause
// TimeLimit: ends a search after a time, and looks for Ctrl-C.
#pragma once

#include <optional>

#include "hinge_tools/clock.hpp"
#include "run_slices.hpp"

namespace hinge::python {

/// The time starts when it is made.
class TimeLimit {
 public:
  /// seconds: 0 to 1e9; empty: no limit.
  explicit TimeLimit(std::optional<double> seconds) : limit_(seconds) {}
  /// Calls poll(). Returns true if the time has passed.
  bool has_passed() const {
    poll();
    return limit_();
  }

 private:
  tool::TimeLimit limit_;
};

}  // namespace hinge::python
