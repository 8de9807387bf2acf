// SPDX-License-Identifier: BSD-3-Clause
// Planned motions of a checker, and conformations fitted to coordinates.
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include <cstdint>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "arrays.hpp"
#include "checker_handle.hpp"
#include "hinge/molecular/fit_coordinates.hpp"
#include "hinge/molecular/plan.hpp"
#include "run_slices.hpp"
#include "time_limit.hpp"

namespace hinge::python {

namespace py = pybind11;
using namespace hinge::molecular;

namespace {

/// atoms: indices, one per row of positions, shape (n, 3).
TargetCoordinates as_target(const CheckerHandle& self, const py::object& positions, const py::object& atoms) {
  TargetCoordinates target;
  for (const std::size_t atom : as_indices(atoms, "atoms", self.molecule.atom_count()))
    target.atoms.push_back(static_cast<std::uint32_t>(atom));
  const auto count = static_cast<py::ssize_t>(target.atoms.size());
  const Doubles x = as_doubles(positions, "x", std::vector<Shape>{{count, 3}}, "(atoms, 3)");
  require_finite(x, "x");
  const auto rows = positions_at(x.data(), target.atoms.size());
  target.positions.assign(rows.begin(), rows.end());
  return target;
}

/// end: a configuration; or a configuration, positions and indices of atoms.
MotionEnd as_end(const CheckerHandle& self, const py::tuple& end, const char* name) {
  const std::vector<Shape> one{{static_cast<py::ssize_t>(self.dof())}};
  const Doubles q = as_doubles(end[0], name, one, "(dof,)");
  MotionEnd made{{q.data(), q.data() + self.dof()}};
  if (end.size() > 1) made.target = as_target(self, end[1], end[2]);
  return made;
}

/// Waypoints, shape (n, dof), and reached, length, straight, remaining, opening, motions, stopped, start_rmsd,
/// end_rmsd.
py::tuple planned(CheckerHandle& self, const py::tuple& start, const py::tuple& end, std::uint64_t tries,
                  std::uint64_t seed, std::optional<double> seconds) {
  const MotionEnd from = as_end(self, start, "start"), to = as_end(self, end, "end");
  const TimeLimit limit(seconds);
  const PlanOptions options{.closures = self.kept.closures, .most_motions = tries, .seed = seed};
  PlannedMotion found;
  run_slices(self.pool, 1, 1, py::none(), [&](Checker& checker, std::size_t, std::size_t) {
    found = plan(checker, from, to, options, [&] { return limit.has_passed(); });
  });
  return py::make_tuple(to_rows(found.waypoints), found.reached, found.length, found.straight, found.remaining,
                        found.open, found.motions, found.stopped, found.start_rmsd, found.end_rmsd);
}

/// The configuration, shape (dof,), and rmsd, farthest, atom, collisions, stopped. atoms: indices, one per position.
py::tuple fitted(CheckerHandle& self, const py::object& positions, const py::object& atoms, bool collision_free,
                 std::optional<double> seconds) {
  const TargetCoordinates target = as_target(self, positions, atoms);
  const TimeLimit limit(seconds);
  CoordinateFit found;
  run_slices(self.pool, 1, 1, py::none(), [&](Checker& checker, std::size_t, std::size_t) {
    found = fit_coordinates(checker, target, {self.kept.closures, collision_free}, [&] { return limit.has_passed(); });
  });
  return py::make_tuple(to_array(std::move(found.q)), found.rmsd, found.farthest, found.atom, found.collisions,
                        found.stopped);
}

/// Indices of the atoms that the other molecule has as well, and their positions there, shape (n, 3).
py::tuple matched(const CheckerHandle& self, const MoleculeHandle& other) {
  const TargetCoordinates target = match_atoms(self.molecule.structure(), other.structure(), "the other molecule");
  std::vector<double> rows;
  rows.reserve(3 * target.positions.size());
  for (const Vec3& at : target.positions) rows.insert(rows.end(), at.data(), at.data() + 3);
  return py::make_tuple(to_array(std::vector<std::uint32_t>(target.atoms)),
                        to_array(std::move(rows), {static_cast<py::ssize_t>(target.atoms.size()), 3}));
}

}  // namespace

void add_planning(CheckerClass& checker) {
  checker
      .def("_plan", &planned, py::arg("start"), py::arg("end"), py::arg("tries"), py::arg("seed"), py::arg("seconds"))
      .def("_fit_coordinates", &fitted, py::arg("x"), py::arg("atoms"), py::arg("collision_free"), py::arg("seconds"))
      .def("_match", &matched, py::arg("other"));
}

}  // namespace hinge::python
