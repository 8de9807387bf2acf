// SPDX-License-Identifier: BSD-3-Clause
// Rigid groups of ensembles, fitted torsions, superpositions.
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include <utility>

#include "arrays.hpp"
#include "checker_handle.hpp"
#include "frame_source.hpp"
#include "hinge/molecular/ensemble_groups.hpp"
#include "hinge/molecular/ensemble_spread.hpp"
#include "hinge/molecular/fit_torsions.hpp"
#include "run_aside.hpp"
#include "run_slices.hpp"

namespace hinge::python {

namespace py = pybind11;
using namespace hinge::molecular;

namespace {

py::dict find_groups(const MoleculeHandle& molecule, const py::object& x, const py::object& torsions, double tolerance,
                     const py::object& progress) {
  const FrameSource frames(x, "x", molecule, py::none());
  const std::vector<std::size_t> free = as_indices(torsions, "free", molecule->torsions().size());
  const auto spread = run_aside([=] { return std::make_shared<EnsembleSpread>(*molecule, free); });
  std::vector<Vec3> memory;
  run_slices(frames.size(), 1, progress, [&]() -> Slice {  // one thread: conformations are added in order
    return [&](std::size_t first, std::size_t last) {
      for (std::size_t k = first; k < last; ++k) spread->add(frames.frame(k, memory));
    };
  });
  auto [found, held] = run_aside([=] {
    EnsembleGroups groups = find_ensemble_groups(*spread, tolerance);
    std::vector<HeldPlacement> placements = held_placements(*molecule, groups);
    return std::pair(std::move(groups), std::move(placements));
  });
  py::list segments, spreads;
  for (const EnsembleGroup& group : found.groups) {
    py::list of_group;
    for (const auto& segment : group.segments) of_group.append(to_array(std::vector(segment)));
    segments.append(of_group);
    spreads.append(group.spread);
  }
  std::vector<std::uint32_t> rows;
  for (const HeldPlacement& one : held) {
    rows.insert(rows.end(), one.atoms.begin(), one.atoms.end());
    rows.insert(rows.end(), one.points.begin(), one.points.end());
  }
  py::dict all;
  all["segments"] = segments;
  all["spreads"] = spreads;
  all["torsions"] = to_array(std::vector<std::int64_t>(found.torsions.begin(), found.torsions.end()));
  all["torsion_spreads"] = to_array(std::move(found.turn_spreads));
  all["held"] = to_array(std::move(rows), {static_cast<py::ssize_t>(held.size()), 6});
  return all;
}

py::array_t<double> fit(const CheckerHandle& self, const py::object& x, const py::object& progress) {
  const FrameSource frames(x, "x", self.molecule, py::none());
  const std::size_t dof = self.dof();
  const DofSelection& selection = self.checker().selection();
  if (!self.molecule->placed_parts().empty()) throw ModelError("fit: expected a molecule without placed parts");
  std::vector<double> values(frames.size() * dof);
  run_slices(frames.size(), self.threads, progress, [&]() -> Slice {
    return [&](std::size_t first, std::size_t last) {
      std::vector<Vec3> memory;
      for (std::size_t k = first; k < last; ++k) {
        const std::vector<double> q = fit_torsions(*self.molecule, selection, frames.frame(k, memory));
        std::copy(q.begin(), q.end(), values.begin() + static_cast<std::ptrdiff_t>(k * dof));
      }
    };
  });
  Shape shape{static_cast<py::ssize_t>(frames.size()), static_cast<py::ssize_t>(dof)};
  if (frames.one()) shape.erase(shape.begin());
  return to_array(std::move(values), shape);
}

py::tuple superposed(const py::object& moved, const py::object& onto) {
  const std::vector<Shape> shapes{{any, 3}};
  const Doubles a = as_doubles(moved, "moved", shapes, "x, y, z of every atom, angstrom");
  const Doubles b = as_doubles(onto, "onto", shapes, "x, y, z of every atom, angstrom");
  require_finite(a, "moved");
  require_finite(b, "onto");
  if (a.shape(0) != b.shape(0) || a.shape(0) == 0)
    throw py::value_error("moved and onto: " + std::to_string(a.shape(0)) + " and " + std::to_string(b.shape(0)) +
                          " atoms, expected the same number, at least one");
  const auto count = static_cast<std::size_t>(a.shape(0));
  const py::gil_scoped_release unlocked;
  const Superposition found = superpose(positions_at(a.data(), count), positions_at(b.data(), count));
  const py::gil_scoped_acquire locked;
  return py::make_tuple(found.rmsd, found.farthest, found.atom);
}

}  // namespace

void bind_ensemble(py::module_& module) {
  module.def("_find_groups", &find_groups);
  module.def("_fit", &fit);
  module.def(
      "superpose", &superposed, py::arg("moved"), py::arg("onto"),
      "superpose(moved, onto)\n--\n\nReturn (rmsd, farthest, atom): root mean square distance and largest distance "
      "after the best\nrigid superposition, angstrom, and the atom with the latter.\n\nmoved, onto: shape (n, 3), "
      "angstrom. Raises TypeError and ValueError.");
}

}  // namespace hinge::python
