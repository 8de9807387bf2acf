// SPDX-License-Identifier: BSD-3-Clause
// Straight paths of a model from arrays: proved or sampled.
#include <pybind11/pybind11.h>

#include "arrays.hpp"
#include "core_checker.hpp"
#include "path_rows.hpp"
#include "run_aside.hpp"
#include "run_slices.hpp"

namespace hinge::python {

namespace py = pybind11;

namespace {

/// resolution: 0 proves the verdict; otherwise states at most this far apart are tested.
py::object certify(CoreChecker& self, const py::object& from, const py::object& to, double smallest_step,
                   double resolution, const py::object& threads, const py::object& progress) {
  const Paths paths(from, to, self.dof);
  std::vector<PathRow> rows(paths.count);
  const unsigned number = as_threads(threads, self.threads);
  if (resolution > 0.0) {
    run_slices(self.pool, paths.count, number, progress,
               [&](const CoreQueries& queries, std::size_t first, std::size_t last) {
                 for (std::size_t k = first; k < last; ++k)
                   rows[k] = path_row(queries.sample_path(paths.start(k), paths.end(k), resolution, poll));
               });
    return to_array(std::move(rows));
  }
  const auto provers = run_aside([make = self.pool.prototype().make_prover] {
    auto pool = std::make_shared<WorkerPool<PathProver>>(make());
    pool->make_one();
    return pool;
  });
  run_slices(*provers, paths.count, number, progress,
             [&](const PathProver& prover, std::size_t first, std::size_t last) {
               for (std::size_t k = first; k < last; ++k)
                 rows[k] = path_row(prover.check(paths.start(k), paths.end(k), smallest_step, poll));
             });
  return to_array(std::move(rows));
}

}  // namespace

void add_core_paths(CoreCheckerClass& checker) {
  PYBIND11_NUMPY_DTYPE(PathRow, verdict, parameter, half_width, i, j, distance, threshold, states);
  checker.def("_certify", &certify, py::arg("a"), py::arg("b"), py::arg("smallest_step"), py::arg("resolution"),
              py::arg("threads"), py::arg("progress"));
}

}  // namespace hinge::python
