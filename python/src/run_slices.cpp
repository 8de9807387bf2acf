// SPDX-License-Identifier: BSD-3-Clause
// Threads, interrupts and progress of long calls.
#include "run_slices.hpp"

#include <algorithm>
#include <atomic>
#include <chrono>
#include <condition_variable>
#include <exception>
#include <limits>
#include <mutex>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "run_aside.hpp"

namespace hinge::python {

namespace py = pybind11;

namespace {

using Clock = std::chrono::steady_clock;
constexpr auto slice_time = std::chrono::milliseconds(2);  // its configurations mostly stay in the cache
constexpr auto progress_time = std::chrono::milliseconds(100);

/// Ends the work of a thread after stop(). Another thread's exception is the answer of the call.
struct Stopped {};

/// What the threads of one call share.
class SharedWork {
 public:
  explicit SharedWork(std::size_t count) : end_(count) {}

  /// Works on slices until none is left or the work ends early. between(): called after every slice.
  template <class Between>
  void work(const Slice& slice, const Between& between) {
    std::size_t length = 1;  // items may take long; Ctrl-C waits for the end of a slice
    while (true) {
      const std::size_t first = next_.fetch_add(length);
      const std::size_t end = end_.load();
      if (first >= end) return;
      const std::size_t last = std::min(first + length, end);
      const auto start = Clock::now();
      try {
        slice(first, last);
        done_ += last - first;
      } catch (const Stopped&) {
        return;
      } catch (...) {
        fail(first);
        return;
      }
      const double share = std::chrono::duration<double>(Clock::now() - start) / slice_time;
      const double wanted = static_cast<double>(last - first) / std::max(share, 1e-6);
      length = static_cast<std::size_t>(std::clamp(wanted, 1.0, 4096.0));
      if (length > 16) length -= length % 16;  // engines take sixteen configurations at a time
      between();
    }
  }
  /// Lets no further slice begin; rethrow() throws the exception then, even if the work did not pass it on.
  void stop(const std::exception_ptr& why) {
    const std::lock_guard lock(mutex_);
    error_at_ = 0;
    error_ = why;
    end_ = 0;
  }
  bool stopped() const { return end_.load() == 0; }
  std::size_t done() const { return done_; }
  void rethrow() {
    if (error_) std::rethrow_exception(error_);
  }

 private:
  void fail(std::size_t first) {
    const std::lock_guard lock(mutex_);
    if (first >= error_at_) return;
    error_at_ = first;
    error_ = std::current_exception();
    std::size_t end = end_.load();
    while (first < end && !end_.compare_exchange_weak(end, first)) {
    }
  }

  std::atomic<std::size_t> next_{0}, done_{0};
  std::atomic<std::size_t> end_;  // items from here on are not wanted
  std::mutex mutex_;
  std::size_t error_at_ = std::numeric_limits<std::size_t>::max();
  std::exception_ptr error_;
};

/// Looks for signals and reports progress from time to time. Used by the calling thread, without the lock.
class Watch {
 public:
  Watch(const py::object& progress, std::size_t total) : progress_(progress), total_(total) {}
  /// Throws error_already_set for a signal, or if the progress callback throws.
  void look(std::size_t done) {
    const auto now = Clock::now();
    if (now < next_signal_) return;
    next_signal_ = now + signal_time;
    const py::gil_scoped_acquire lock;
    if (PyErr_CheckSignals() != 0) throw py::error_already_set();
    if (now < next_report_) return;
    next_report_ = now + progress_time;
    report_progress(progress_, done, total_);
  }

 private:
  const py::object& progress_;
  std::size_t total_;
  Clock::time_point next_signal_ = Clock::now() + signal_time, next_report_ = Clock::now() + progress_time;
};

/// What poll() does in this thread. `watch` is null in threads other than the calling one.
struct Polled {
  SharedWork* shared = nullptr;
  Watch* watch = nullptr;
};
thread_local Polled polled;

/// Sets `polled` during its lifetime.
class Polling {
 public:
  explicit Polling(Polled now) : before_(std::exchange(polled, now)) {}
  Polling(const Polling&) = delete;
  Polling& operator=(const Polling&) = delete;
  ~Polling() { polled = before_; }

 private:
  Polled before_;
};

void run_on_threads(SharedWork& shared, unsigned threads, Watch& watch, const std::function<Slice()>& make_work) {
  std::mutex mutex;
  std::condition_variable ended;
  std::size_t running = threads - 1;
  std::vector<std::thread> others;
  try {
    for (unsigned k = 1; k < threads; ++k)
      others.emplace_back([&] {
        try {
          const Polling polling({&shared, nullptr});
          shared.work(make_work(), [] {});
        } catch (...) {  // no memory for a worker: the other threads do its work
        }
        const std::lock_guard lock(mutex);
        --running;
        ended.notify_one();
      });
    {
      const Polling polling({&shared, &watch});
      shared.work(make_work(), [&] { watch.look(shared.done()); });
    }
    std::unique_lock lock(mutex);
    while (!ended.wait_for(lock, signal_time, [&] { return running == 0; })) {
      lock.unlock();
      watch.look(shared.done());
      lock.lock();
    }
  } catch (...) {
    shared.stop(std::current_exception());
  }
  for (std::thread& other : others) other.join();
}

}  // namespace

void poll() {
  if (polled.watch != nullptr) {
    try {
      polled.watch->look(polled.shared->done());
    } catch (...) {
      polled.shared->stop(std::current_exception());
      throw;
    }
  }
  if (polled.shared != nullptr && polled.shared->stopped()) throw Stopped();
}

void check_progress(const py::object& progress) {
  if (!progress.is_none() && PyCallable_Check(progress.ptr()) == 0 && !py::hasattr(progress, "update"))
    throw py::type_error("progress: expected a callable with (done, total), or a progress bar with update()");
}

void report_progress(const py::object& progress, std::size_t done, std::size_t total) {
  if (progress.is_none()) return;
  if (PyCallable_Check(progress.ptr()) != 0)
    progress(done, total);
  else
    progress.attr("update")(py::int_(done) - py::int_(progress.attr("n")));
}

void run_slices(std::size_t count, unsigned threads, const py::object& progress,
                const std::function<Slice()>& make_work) {
  check_progress(progress);
  if (count > 0) {
    const py::gil_scoped_release unlocked;
    SharedWork shared(count);
    Watch watch(progress, count);
    const auto most = static_cast<unsigned>(std::min<std::size_t>(threads, (count + 15) / 16));
    run_on_threads(shared, most, watch, make_work);
    shared.rethrow();
  }
  report_progress(progress, count, count);
}

unsigned as_threads(const py::object& given, unsigned standard) {
  if (given.is_none()) return standard;
  if (!PyIndex_Check(given.ptr()) || PyBool_Check(given.ptr()))
    throw py::type_error("threads: expected an integer or None");
  const py::int_ number(given);
  if (number < py::int_(1) || number > py::int_(1024))
    throw py::value_error("threads: " + py::repr(number).cast<std::string>() + ", expected 1 to 1024");
  return number.cast<unsigned>();
}

}  // namespace hinge::python
