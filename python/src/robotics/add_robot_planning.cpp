// SPDX-License-Identifier: BSD-3-Clause
// Planned motions of a robot.
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "arrays.hpp"
#include "hinge/robotics/plan.hpp"
#include "robot_checker_handle.hpp"
#include "time_limit.hpp"

namespace hinge::python {

namespace py = pybind11;
using namespace hinge::robotics;

namespace {

/// Waypoints, shape (n, dof), and reached, length, straight, remaining, 0, motions, stopped.
py::tuple planned(RobotCheckerHandle& self, const py::object& start, const py::object& end, std::uint64_t tries,
                  std::uint64_t seed, std::optional<double> seconds) {
  const std::vector<Shape> one{{static_cast<py::ssize_t>(self.dof())}};
  const Doubles from = as_doubles(start, "start", one, "(dof,)"), to = as_doubles(end, "end", one, "(dof,)");
  const TimeLimit limit(seconds);
  PlannedMotion found;
  RobotCall call(self);
  const auto checkers = self.path_checkers(call.shared_pool());
  run_slices(*checkers, 1, 1, py::none(), [&](PathChecker& paths, std::size_t, std::size_t) {
    found = plan(paths, std::span(from.data(), self.dof()), std::span(to.data(), self.dof()),
                 {.most_motions = tries, .seed = seed}, [&] { return limit.has_passed(); });
  });
  return py::make_tuple(to_rows(found.waypoints), found.reached, found.length, found.straight, found.remaining, 0.0,
                        found.motions, found.stopped);
}

}  // namespace

void add_robot_planning(RobotCheckerClass& checker) {
  checker.def("_plan", &planned, py::arg("start"), py::arg("end"), py::arg("tries"), py::arg("seed"),
              py::arg("seconds"));
}

}  // namespace hinge::python
