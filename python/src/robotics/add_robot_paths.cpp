// SPDX-License-Identifier: BSD-3-Clause
// Straight paths of a robot, alone or among bodies: proved or sampled.
#include <pybind11/pybind11.h>

#include <variant>

#include "hinge/robotics/path_checker.hpp"
#include "path_rows.hpp"
#include "robot_checker_handle.hpp"

namespace hinge::python {

namespace py = pybind11;
using namespace hinge::robotics;

namespace {

/// The answer for one path.
struct RobotPathRow {
  std::int8_t verdict;  ///< PathVerdict
  Padding<7> padding;
  double parameter, half_width;
  std::int32_t first, second;  ///< a pair that collides or is not proved apart; -1: none
  double distance, threshold;
  std::int64_t states;
};

RobotPathRow robot_path_row(const RobotCheckerHandle& self, const RobotPathAnswer& answer) {
  RobotPathRow row{static_cast<std::int8_t>(answer.verdict),
                   {},
                   answer.parameter,
                   answer.half_width,
                   -1,
                   -1,
                   0.0,
                   0.0,
                   static_cast<std::int64_t>(answer.counts.configurations)};
  if (answer.contact) {
    const auto part = [&](const LinkOrBody& side) {
      const auto* link = std::get_if<LinkId>(&side);
      return link != nullptr ? link_row(*link) : self.body_row(std::get<BodyId>(side));
    };
    row.first = part(answer.contact->first);
    row.second = part(answer.contact->second);
    row.distance = answer.contact->distance;
    row.threshold = answer.contact->threshold;
  }
  return row;
}

/// Returns the rows and, of shape (n, dof), the configurations at their parameters (of free paths: the end).
/// resolution: 0 proves the verdict; otherwise states at most this far apart are tested.
py::tuple certify(RobotCheckerHandle& self, const py::object& from, const py::object& to, double smallest_step,
                  double resolution, const py::object& threads, const py::object& progress) {
  const Paths paths(from, to, self.dof());
  const std::size_t count = paths.count, dof = self.dof();
  std::vector<RobotPathRow> rows(count);
  std::vector<double> states(count * dof);
  RobotCall call(self);
  const auto checkers = self.path_checkers(call.shared_pool());
  run_slices(*checkers, count, as_threads(threads, self.threads), progress,
             [&](PathChecker& checker, std::size_t first, std::size_t last) {
               for (std::size_t k = first; k < last; ++k) {
                 const auto start = paths.start(k), end = paths.end(k);
                 const RobotPathAnswer answer = resolution > 0.0 ? checker.sample(start, end, resolution, poll)
                                                                 : checker.certify(start, end, smallest_step, poll);
                 rows[k] = robot_path_row(self, answer);
                 const std::span<const double> state =
                     answer.is_free() ? end : std::span<const double>(answer.configuration);
                 std::copy(state.begin(), state.end(), states.begin() + static_cast<std::ptrdiff_t>(k * dof));
               }
             });
  return py::make_tuple(to_array(std::move(rows)),
                        to_array(std::move(states), {static_cast<py::ssize_t>(count), static_cast<py::ssize_t>(dof)}));
}

}  // namespace

void add_robot_paths(RobotCheckerClass& checker) {
  PYBIND11_NUMPY_DTYPE(RobotPathRow, verdict, parameter, half_width, first, second, distance, threshold, states);
  checker.def("_certify", &certify, py::arg("a"), py::arg("b"), py::arg("smallest_step"), py::arg("resolution"),
              py::arg("threads"), py::arg("progress"));
}

}  // namespace hinge::python
