// SPDX-License-Identifier: BSD-3-Clause
// Straight paths of a checker: proved or sampled.
#include <pybind11/pybind11.h>

#include "checker_handle.hpp"
#include "path_rows.hpp"
#include "run_aside.hpp"
#include "run_slices.hpp"

namespace hinge::python {

namespace py = pybind11;
using namespace hinge::molecular;

namespace {

/// resolution: 0 proves the verdict; otherwise states at most this far apart are tested.
py::object certify(CheckerHandle& self, const py::object& from, const py::object& to, double smallest_step,
                   double resolution, const py::object& threads, const py::object& progress) {
  const Paths paths(from, to, self.dof());
  std::vector<PathRow> rows(paths.count);
  const auto checkers = run_aside([of = self.checker()] {
    auto pool = std::make_shared<WorkerPool<PathChecker>>(PathChecker(of));
    pool->make_one();
    return pool;
  });
  run_slices(*checkers, paths.count, as_threads(threads, self.threads), progress,
             [&](PathChecker& checker, std::size_t first, std::size_t last) {
               for (std::size_t k = first; k < last; ++k)
                 rows[k] =
                     path_row(resolution > 0.0 ? checker.sample(paths.start(k), paths.end(k), resolution, poll)
                                               : checker.certify(paths.start(k), paths.end(k), smallest_step, poll));
             });
  return to_array(std::move(rows));
}

}  // namespace

void add_paths(CheckerClass& checker) {
  checker.def("_certify", &certify, py::arg("a"), py::arg("b"), py::arg("smallest_step"), py::arg("resolution"),
              py::arg("threads"), py::arg("progress"));
}

}  // namespace hinge::python
