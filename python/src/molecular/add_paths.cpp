// SPDX-License-Identifier: BSD-3-Clause
// Straight paths of a checker: proved or sampled.
#include <pybind11/pybind11.h>

#include <algorithm>

#include "arrays.hpp"
#include "checker_handle.hpp"
#include "run_slices.hpp"

namespace hinge::python {

namespace py = pybind11;
using namespace hinge::molecular;

namespace {

/// The answer for one path.
struct PathRow {
  std::int8_t verdict;  ///< PathVerdict
  double parameter, half_width;
  std::int64_t i, j;  ///< a pair that collides or is not proved apart; -1: none
  double distance, threshold;
  std::int64_t states;
};

PathRow path_row(const PathAnswer& answer) {
  PathRow row{static_cast<std::int8_t>(answer.verdict),
              answer.parameter,
              answer.half_width,
              -1,
              -1,
              0.0,
              0.0,
              static_cast<std::int64_t>(answer.counts.configurations)};
  if (answer.hit) {
    row.i = static_cast<std::int64_t>(index(answer.hit->first));
    row.j = static_cast<std::int64_t>(index(answer.hit->second));
    row.distance = answer.hit->distance;
    row.threshold = answer.hit->threshold;
  }
  return row;
}

/// resolution: 0 proves the verdict; otherwise states at most this far apart are tested.
py::object certify(CheckerHandle& self, const py::object& from, const py::object& to, double smallest_step,
                   double resolution, const py::object& threads, const py::object& progress) {
  const Configurations a = as_configurations(from, "a", self.dof()), b = as_configurations(to, "b", self.dof());
  if (a.count != b.count && !a.one && !b.one)
    throw py::value_error("a and b: " + std::to_string(a.count) + " and " + std::to_string(b.count) +
                          " configurations, expected the same number, or one");
  if (!(smallest_step > 0.0 && smallest_step <= 1.0))
    throw py::value_error("smallest_step: expected a share of the path above 0, at most 1");
  const std::size_t count = a.one ? b.count : a.count;
  std::vector<PathRow> rows(count);
  run_slices(count, as_threads(threads, self.threads), progress, [&]() -> Slice {
    const auto checker = std::make_shared<PathChecker>(self.checker());
    return [&, checker](std::size_t first, std::size_t last) {
      for (std::size_t k = first; k < last; ++k) {
        const auto start = a[a.one ? 0 : k], end = b[b.one ? 0 : k];
        rows[k] = path_row(resolution > 0.0 ? checker->sample(start, end, resolution, poll)
                                            : checker->certify(start, end, smallest_step, poll));
      }
    };
  });
  return to_array(std::move(rows));
}

}  // namespace

void add_paths(CheckerClass& checker) {
  PYBIND11_NUMPY_DTYPE(PathRow, verdict, parameter, half_width, i, j, distance, threshold, states);
  checker.def("_certify", &certify, py::arg("a"), py::arg("b"), py::arg("smallest_step"), py::arg("resolution"),
              py::arg("threads"), py::arg("progress"));
}

}  // namespace hinge::python
