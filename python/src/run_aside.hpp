// SPDX-License-Identifier: BSD-3-Clause
// run_aside: calls that cannot look for Ctrl-C themselves, such as reading a file or building a hierarchy.
#pragma once

#include <pybind11/pybind11.h>

#include <chrono>
#include <functional>
#include <memory>
#include <optional>
#include <type_traits>
#include <utility>

namespace hinge::python {

/// The time from one look for Ctrl-C to the next.
inline constexpr auto signal_time = std::chrono::milliseconds(20);

/// Calls work() on another thread and returns at its end. The interpreter's lock is held at the call and released
/// meanwhile. Throws what the work throws. Ctrl-C ends the call with KeyboardInterrupt within 50 ms, but not the work:
/// it runs on, what it made is dropped, and the process waits for it before it exits; a second Ctrl-C ends the process
/// at once. The work must own everything it uses, and must not use Python.
void run_aside_without_result(std::function<void()> work);

/// The same for work with a result, which is returned.
template <class Work>
std::invoke_result_t<Work&> run_aside(Work work) {
  using Result = std::invoke_result_t<Work&>;
  const auto result = std::make_shared<std::optional<Result>>();
  const auto owned = std::make_shared<Work>(std::move(work));  // std::function needs what can be copied
  run_aside_without_result([result, owned] { result->emplace((*owned)()); });
  return std::move(**result);
}

/// Makes the interpreter wait at its exit for work that Ctrl-C left behind.
void wait_for_work_at_exit();

}  // namespace hinge::python
