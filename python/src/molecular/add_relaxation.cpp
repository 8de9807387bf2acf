// SPDX-License-Identifier: BSD-3-Clause
// Steric energies with gradients, and relaxation, of a checker.
#include <pybind11/pybind11.h>

#include <algorithm>
#include <vector>

#include "arrays.hpp"
#include "checker_handle.hpp"
#include "hinge/molecular/relax.hpp"
#include "run_slices.hpp"

namespace hinge::python {

namespace py = pybind11;
using namespace hinge::molecular;

namespace {

/// Energies, shape (n,), and gradients, shape (n, dof), for q of shape (dof,) or (n, dof).
py::tuple steric(CheckerHandle& self, const py::object& values, const py::object& given_softness,
                 const py::object& threads, const py::object& progress) {
  const double softness = as_length(given_softness, "softness", "angstrom");
  const Configurations q = as_configurations(values, "q", self.dof());
  std::vector<double> energies(q.count), gradients(q.count * q.dof);
  run_slices(self.pool, q.count, as_threads(threads, self.threads), progress,
             [&](Checker& checker, std::size_t first, std::size_t last) {
               for (std::size_t k = first; k < last; ++k) {
                 const Steric found = checker.steric(q[k], softness);
                 energies[k] = found.energy;
                 std::copy(found.gradient.begin(), found.gradient.end(), gradients.data() + k * q.dof);
               }
             });
  return py::make_tuple(
      to_array(std::move(energies)),
      to_array(std::move(gradients), {static_cast<py::ssize_t>(q.count), static_cast<py::ssize_t>(q.dof)}));
}

/// Relaxed configurations, shape (n, dof), and six arrays of shape (n,): collisions before and after, energies before
/// and after, restarts.
py::tuple relaxed(CheckerHandle& self, const py::object& values, std::uint64_t tries, std::uint64_t seed,
                  const py::object& threads, const py::object& progress) {
  const Configurations q = as_configurations(values, "q", self.dof());
  const RelaxOptions options{.closures = self.kept.closures, .most_restarts = tries, .seed = seed};
  std::vector<double> rows(q.count * q.dof), energies_before(q.count), energies(q.count);
  std::vector<std::int64_t> before(q.count), after(q.count), restarts(q.count);
  run_slices(self.pool, q.count, as_threads(threads, self.threads), progress,
             [&](Checker& checker, std::size_t first, std::size_t last) {
               for (std::size_t k = first; k < last; ++k) {
                 const Relaxation found = relax(checker, q[k], options, [] {
                   poll();
                   return false;
                 });
                 std::copy(found.q.begin(), found.q.end(), rows.data() + k * q.dof);
                 before[k] = static_cast<std::int64_t>(found.collisions_before);
                 after[k] = static_cast<std::int64_t>(found.collisions);
                 energies_before[k] = found.energy_before;
                 energies[k] = found.energy;
                 restarts[k] = static_cast<std::int64_t>(found.restarts);
               }
             });
  return py::make_tuple(to_array(std::move(rows), {static_cast<py::ssize_t>(q.count), static_cast<py::ssize_t>(q.dof)}),
                        to_array(std::move(before)), to_array(std::move(after)), to_array(std::move(energies_before)),
                        to_array(std::move(energies)), to_array(std::move(restarts)));
}

}  // namespace

void add_relaxation(CheckerClass& checker) {
  checker.def("_steric", &steric, py::arg("q"), py::arg("softness"), py::arg("threads"), py::arg("progress"))
      .def("_relax", &relaxed, py::arg("q"), py::arg("tries"), py::arg("seed"), py::arg("threads"),
           py::arg("progress"));
}

}  // namespace hinge::python
