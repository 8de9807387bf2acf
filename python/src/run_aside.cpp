// SPDX-License-Identifier: BSD-3-Clause
// Work on another thread, which Ctrl-C leaves behind.
#include "run_aside.hpp"

#include <condition_variable>
#include <cstddef>
#include <cstdlib>
#include <exception>
#include <mutex>
#include <thread>

namespace hinge::python {

namespace py = pybind11;

namespace {

/// Numbers of threads that work. It lives until the process ends, because the threads may outlive static objects.
struct Workers {
  std::mutex mutex;
  std::condition_variable ended;
  std::size_t running = 0;
};

Workers& workers() {
  static auto* const all = new Workers;
  return *all;
}

struct Task {
  explicit Task(std::function<void()> of) : work(std::move(of)) {}
  std::function<void()> work;
  std::exception_ptr error;
  bool done = false;  // guarded by Workers::mutex
};

void run(Task& task) noexcept {
  try {
    task.work();
  } catch (...) {
    task.error = std::current_exception();
  }
  task.work = nullptr;
}

/// Waits until `ended` returns true. Throws error_already_set for a signal. The interpreter's lock is held.
template <class Ended>
void wait_until(const Ended& ended) {
  while (true) {
    {
      const py::gil_scoped_release unlocked;
      std::unique_lock lock(workers().mutex);
      if (workers().ended.wait_for(lock, signal_time, ended)) return;
    }
    if (PyErr_CheckSignals() != 0) throw py::error_already_set();
  }
}

void flush_streams() {
  for (const char* name : {"stdout", "stderr"}) {
    try {
      py::module_::import("sys").attr(name).attr("flush")();
    } catch (const py::error_already_set&) {  // closed, or not a file
    }
  }
}

void wait_for_work() {
  try {
    wait_until([] { return workers().running == 0; });
  } catch (const py::error_already_set&) {  // a second Ctrl-C; static objects may not be destroyed under the work
    flush_streams();
    constexpr int status_of_interrupted = 130;
    std::_Exit(status_of_interrupted);
  }
}

}  // namespace

void run_aside_without_result(std::function<void()> work) {
  auto task = std::make_shared<Task>(std::move(work));
  {
    const std::lock_guard lock(workers().mutex);
    ++workers().running;
  }
  try {
    std::thread([task]() mutable {
      run(*task);
      const std::lock_guard lock(workers().mutex);
      task->done = true;
      task.reset();
      --workers().running;
      workers().ended.notify_all();
    }).detach();
  } catch (...) {  // no thread can be started
    const std::lock_guard lock(workers().mutex);
    --workers().running;
    throw;
  }
  wait_until([&] { return task->done; });
  if (task->error) std::rethrow_exception(std::exchange(task->error, nullptr));
}

void wait_for_work_at_exit() { py::module_::import("atexit").attr("register")(py::cpp_function(&wait_for_work)); }

}  // namespace hinge::python
