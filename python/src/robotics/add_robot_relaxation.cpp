// SPDX-License-Identifier: BSD-3-Clause
// Relaxation of a robot's configurations.
#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>

#include <algorithm>
#include <cstdint>
#include <vector>

#include "hinge/robotics/relax.hpp"
#include "robot_checker_handle.hpp"

namespace hinge::python {

namespace py = pybind11;
using namespace hinge::robotics;

namespace {

/// Relaxed configurations, shape (n, dof), and three arrays of shape (n,): is_free, distance, tries.
py::tuple relaxed(RobotCheckerHandle& self, const py::object& values, std::uint64_t tries, std::uint64_t seed,
                  const py::object& threads, const py::object& progress) {
  const Configurations q = as_configurations(values, "q", self.dof());
  RelaxOptions options;
  options.most_tries = tries;
  options.seed = seed;
  std::vector<double> rows(q.count * q.dof), distances(q.count);
  std::vector<std::uint8_t> is_free(q.count);
  std::vector<std::int64_t> tested(q.count);
  run_robot(self, q.count, threads, progress, [&](RobotWorker& worker, Environment* bodies, std::size_t k) {
    worker.update(q, k);  // names the configuration in its error
    const Relaxation found = relax(worker.checker, bodies, q[k], options, [] {
      poll();
      return false;
    });
    std::copy(found.q.begin(), found.q.end(), rows.data() + k * q.dof);
    is_free[k] = found.is_free ? 1 : 0;
    distances[k] = found.distance;
    tested[k] = static_cast<std::int64_t>(found.tries);
  });
  return py::make_tuple(to_array(std::move(rows), {static_cast<py::ssize_t>(q.count), static_cast<py::ssize_t>(q.dof)}),
                        to_booleans(std::move(is_free)), to_array(std::move(distances)), to_array(std::move(tested)));
}

}  // namespace

void add_robot_relaxation(RobotCheckerClass& checker) {
  checker.def("_relax", &relaxed, py::arg("q"), py::arg("tries"), py::arg("seed"), py::arg("threads"),
              py::arg("progress"));
}

}  // namespace hinge::python
