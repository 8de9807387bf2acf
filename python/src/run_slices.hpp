// SPDX-License-Identifier: BSD-3-Clause
// run_slices: works on many items with the interpreter's lock released, on several threads, so that Ctrl-C works.
#pragma once

#include <pybind11/pybind11.h>

#include <cstddef>
#include <functional>

#include "worker_pool.hpp"

namespace hinge::python {

/// Work on items first ... last - 1.
using Slice = std::function<void(std::size_t first, std::size_t last)>;

/// Calls work for slices of 0 ... count - 1, each item once. make_work() is called once per thread and returns what
/// this thread calls. A slice takes about 2 ms, or one item. The calling thread holds the interpreter's lock, which is
/// released during the work; between slices it looks for Ctrl-C (KeyboardInterrupt) and reports progress about ten
/// times a second and at the end. progress: None; a callable with (done, total); or an object with `n` and `update(k)`,
/// such as a bar of tqdm. If items fail, the exception of the first one is thrown, for any number of threads, provided
/// that work throws for its first item that fails. threads: at least 1.
void run_slices(std::size_t count, unsigned threads, const pybind11::object& progress,
                const std::function<Slice()>& make_work);

/// The same with a worker of the pool per thread: work(worker, first, last).
template <class Worker, class Work>
void run_slices(WorkerPool<Worker>& pool, std::size_t count, unsigned threads, const pybind11::object& progress,
                const Work& work) {
  using Loan = typename WorkerPool<Worker>::Loan;
  run_slices(count, threads, progress, [&]() -> Slice {
    const auto loan = std::make_shared<Loan>(pool);
    return [loan, &work](std::size_t first, std::size_t last) { work(**loan, first, last); };
  });
}

/// Throws TypeError unless `progress` is what run_slices() takes.
void check_progress(const pybind11::object& progress);
/// Reports how much is done. The interpreter's lock is held.
void report_progress(const pybind11::object& progress, std::size_t done, std::size_t total);

/// For work on one item that may take long: call it often, at least every 10 ms. Inside run_slices(), it does what is
/// done between slices, or throws if the call is to end; elsewhere it does nothing.
void poll();

/// Returns the number of threads of a call: `given`, or `standard` if it is None. Throws TypeError unless it is an
/// integer, ValueError unless it is in 1 ... 1024.
unsigned as_threads(const pybind11::object& given, unsigned standard);

}  // namespace hinge::python
