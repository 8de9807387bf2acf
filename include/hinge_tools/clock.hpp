// SPDX-License-Identifier: BSD-3-Clause
// The clock that measures how long something takes.
#pragma once

#include <chrono>

namespace hinge::tool {

using Clock = std::chrono::steady_clock;

inline double seconds_since(Clock::time_point start) {
  return std::chrono::duration<double>(Clock::now() - start).count();
}

}  // namespace hinge::tool
