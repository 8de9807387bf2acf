// SPDX-License-Identifier: BSD-3-Clause
// Clearances of links and bodies, with the derivatives of the distances.
#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>

#include <span>
#include <vector>

#include "robot_checker_handle.hpp"

namespace hinge::python {

namespace py = pybind11;
using namespace hinge::robotics;

namespace {

/// A row of the structured array of clearances.
struct ClearanceRow {
  std::int64_t configuration;
  std::int32_t first, second;
  double distance, gap;
  double point1[3], point2[3], normal[3];
  bool is_signed;
  Padding<7> padding{};
};

ClearanceRow clearance_row(std::size_t configuration, std::int32_t first, std::int32_t second, const Clearance& c) {
  ClearanceRow row{static_cast<std::int64_t>(configuration), first, second, c.distance, c.gap, {}, {}, {}, c.is_signed};
  for (int axis = 0; axis < 3; ++axis) {
    row.point1[axis] = c.point1[axis];
    row.point2[axis] = c.point2[axis];
    row.normal[axis] = c.normal[axis];
  }
  return row;
}

/// The rows of one configuration and their derivatives, one after the other.
struct Found {
  std::vector<ClearanceRow> rows;
  std::vector<double> slopes;

  void add(const ClearanceJacobian& jacobian) {
    slopes.insert(slopes.end(), jacobian.data(), jacobian.data() + jacobian.size());
  }
};

py::tuple clearances(RobotCheckerHandle& self, const py::object& values, const py::object& given,
                     const std::string& against, const py::object& threads, const py::object& progress) {
  const Configurations q = as_configurations(values, "q", self.dof());
  const Against what = as_against(against);
  const double influence = as_length(given, "influence", "m");
  std::vector<Found> found(q.count);
  run_robot(self, q.count, threads, progress, [&](RobotWorker& worker, Environment* bodies, std::size_t k) {
    worker.update(q, k);
    RobotChecker& checker = worker.checker;
    if (what.self) {
      const std::vector<LinkClearance> rows = checker.clearances(influence);
      for (const LinkClearance& c : rows)
        found[k].rows.push_back(clearance_row(k, link_row(c.link1), link_row(c.link2), c));
      found[k].add(checker.jacobian(std::span(rows)));
    }
    if (what.bodies && bodies != nullptr) {
      const std::vector<BodyClearance> rows = checker.clearances(*bodies, influence);
      for (const BodyClearance& c : rows)
        found[k].rows.push_back(clearance_row(k, self.own_row(c), self.body_row(c.body), c));
      found[k].add(checker.jacobian(std::span(rows)));
    }
  });
  std::vector<std::vector<ClearanceRow>> rows;
  std::vector<double> slopes;
  for (Found& one : found) {
    rows.push_back(std::move(one.rows));
    slopes.insert(slopes.end(), one.slopes.begin(), one.slopes.end());
  }
  py::array_t<ClearanceRow> table = joined_rows(rows);
  const std::vector<py::ssize_t> shape{table.size(), static_cast<py::ssize_t>(q.dof)};
  return py::make_tuple(table, to_array(std::move(slopes), shape));
}

constexpr const char* clearances_doc =
    "clearances(self, q, *, influence, against='all', threads=None, progress=None)\n--\n\n"
    "Return the distances of the pairs within `influence`, and their derivatives by q.\n\n"
    "q, against: as in collides(). influence: m, at least 0. Returns (rows, jacobian). rows: a structured array:\n"
    "configuration, first, second (as in pairs()), distance (m; below 0, if is_signed, by the depth to which spheres\n"
    "or capsules overlap), gap (m, distance - clearance), point1, point2 (m, world frame), normal (unit vector in\n"
    "which the distance grows; 0 where meshes meet), is_signed. jacobian: shape (len(rows), dof), m per rad or m per "
    "m.";

}  // namespace

void add_clearances(RobotCheckerClass& checker) {
  PYBIND11_NUMPY_DTYPE(ClearanceRow, configuration, first, second, distance, gap, point1, point2, normal, is_signed);
  checker.def("clearances", &clearances, py::arg("q"), py::kw_only(), py::arg("influence"), py::arg("against") = "all",
              py::arg("threads") = py::none(), py::arg("progress") = py::none(), clearances_doc);
}

}  // namespace hinge::python
