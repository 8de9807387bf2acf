// SPDX-License-Identifier: BSD-3-Clause
// What a checker tells about its rules and its selection.
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include <span>
#include <string>
#include <utility>
#include <vector>

#include "arrays.hpp"
#include "checker_handle.hpp"
#include "hinge/molecular/severity.hpp"

namespace hinge::python {

namespace py = pybind11;
using namespace hinge::molecular;

namespace {

py::array_t<PairRow> listed_hits(std::span<const Hit> hits) {
  std::vector<PairRow> rows;
  for (const Hit& hit : hits) rows.push_back(pair_row(0, Contact{hit, true}));
  return to_array(std::move(rows));
}

/// Index in Molecule.torsions of each degree of freedom; -1 for one that places a part.
py::array_t<std::int64_t> torsion_of_dof(const CheckerHandle& self) {
  std::vector<std::int64_t> torsions;
  for (const DofId dof : self.checker().selection().dofs()) {
    const std::size_t torsion = self.molecule->torsion_of(dof);
    torsions.push_back(torsion == Molecule::no_torsion ? -1 : static_cast<std::int64_t>(torsion));
  }
  return to_array(std::move(torsions));
}

py::array_t<double> overlaps(const CheckerHandle& self, const py::array_t<PairRow>& pairs) {
  std::vector<double> all;
  const auto atoms = static_cast<std::uint32_t>(self.molecule.atom_count());
  for (py::ssize_t k = 0; k < pairs.size(); ++k) {
    const PairRow& row = pairs.data()[k];
    if (row.i >= atoms || row.j >= atoms)
      throw py::index_error("pairs[" + std::to_string(k) + "]: atom outside the molecule");
    const Hit hit{id<PrimitiveId>(row.i), id<PrimitiveId>(row.j), row.distance, row.threshold};
    all.push_back(severity_of(self.checker().thresholds(), hit, row.collides).overlap);
  }
  return to_array(std::move(all));
}

py::array_t<std::uint16_t> types_of(const CheckerHandle& self) {
  std::vector<std::uint16_t> types;
  const auto& matrix = self.checker().thresholds().matrix;
  for (std::size_t atom = 0; atom < self.molecule.atom_count(); ++atom)
    types.push_back(matrix.type(id<PrimitiveId>(atom)));
  return to_array(std::move(types));
}

py::array_t<double> threshold_table(const CheckerHandle& self) {
  const auto& thresholds = self.checker().thresholds();
  const auto count = static_cast<py::ssize_t>(thresholds.type_names.size());
  return to_array(std::vector(thresholds.table), {count, count});
}

py::array_t<std::uint32_t> excluded_pairs(const CheckerHandle& self) {
  std::vector<std::uint32_t> pairs;
  const BondExclusions& exclusions = self.checker().exclusions();
  for (std::size_t i = 0; i < exclusions.size(); ++i)
    for (const PrimitiveId j : exclusions.excluded(id<PrimitiveId>(i)))
      if (index(j) > i)
        pairs.insert(pairs.end(), {static_cast<std::uint32_t>(i), static_cast<std::uint32_t>(index(j))});
  const auto count = static_cast<py::ssize_t>(pairs.size() / 2);
  return to_array(std::move(pairs), {count, 2});
}

}  // namespace

void add_facts(CheckerClass& checker) {
  checker
      .def("overlaps", &overlaps, py::arg("pairs"),
           "overlaps(self, pairs)\n--\n\nReturn the overlap of the radii of each pair, angstrom; negative for atoms "
           "apart.\n\npairs: rows of pairs().")
      .def_property_readonly("dof", &CheckerHandle::dof, "Number of values of a configuration.")
      .def_property_readonly(
          "threads", [](const CheckerHandle& self) { return self.threads; }, "Default number of threads of a call.")
      .def_property_readonly(
          "torsion_of_dof", &torsion_of_dof,
          "Index in Molecule.torsions of each degree of freedom, shape (dof,); -1 for one that places\n"
          "a part.")
      .def_property_readonly(
          "rigid_groups",
          [](const CheckerHandle& self) {
            std::vector<std::uint32_t> groups;
            for (std::uint32_t atom = 0; atom < self.molecule.atom_count(); ++atom)
              groups.push_back(static_cast<std::uint32_t>(index(self.checker().group_of(atom))));
            return to_array(std::move(groups));
          },
          "The rigid group of each atom, shape (n_atoms,); 0 is fixed in the world.")
      .def_property_readonly(
          "n_rigid_groups", [](const CheckerHandle& self) { return self.checker().rigid_groups().size(); },
          "Number of rigid groups, including the world's.")
      .def_property_readonly(
          "reference_collisions",
          [](const CheckerHandle& self) { return listed_hits(self.checker().reference_collisions()); },
          "Pairs that collide in the reference coordinates, as rows of pairs().")
      .def_property_readonly(
          "constant_contacts",
          [](const CheckerHandle& self) { return listed_hits(self.checker().constant_contacts()); },
          "Reference collisions whose distance the selection cannot change, as rows of pairs().")
      .def_property_readonly("types", &types_of, "The type of each atom, shape (n_atoms,); see threshold_table.")
      .def_property_readonly("threshold_table", &threshold_table,
                             "Distance below which two types collide, shape (types, types), angstrom.")
      .def_property_readonly(
          "type_names", [](const CheckerHandle& self) { return self.checker().thresholds().type_names; },
          "Names of the types, such as 'C' or 'H.polar'.")
      .def_property_readonly("excluded_pairs", &excluded_pairs,
                             "Pairs of atoms that are not tested, because they have too few bonds between them or are\n"
                             "exempt: shape (n, 2), i < j.")
      .def_property_readonly(
          "rules", [](const CheckerHandle& self) { return std::string(self.checker().thresholds().rules->name); },
          "Name of the clash rules in use.")
      .def_property_readonly(
          "radii", [](const CheckerHandle& self) { return std::string(self.checker().thresholds().radii); },
          "Name of the radii set in use.")
      .def_property_readonly(
          "rho", [](const CheckerHandle& self) { return self.checker().thresholds().rho; },
          "The factor threshold / sum of radii; None if the rules are not of that kind.")
      .def_property_readonly(
          "min_bonds", [](const CheckerHandle& self) { return self.checker().min_bonds().heavy; },
          "Number of bonds from which a pair of heavy atoms counts.")
      .def_property_readonly(
          "hydrogen_bonds", [](const CheckerHandle& self) { return self.checker().thresholds().hydrogen_bonds; },
          "True if the hydrogen-bond rule is in use.")
      .def_property_readonly(
          "notes", [](const CheckerHandle& self) { return self.kept.notes; },
          "Closures that stay open and why, one sentence each.")
      .def_property_readonly(
          "kept_closures",
          [](const CheckerHandle& self) {
            return to_array(std::vector<std::int64_t>(self.kept.closures.begin(), self.kept.closures.end()));
          },
          "Indices of the closures that samples and walks keep closed, shape (n,).")
      .def_property_readonly(
          "held_torsions",
          [](const CheckerHandle& self) {
            return to_array(std::vector<std::int64_t>(self.kept.held.begin(), self.kept.held.end()));
          },
          "Indices of torsions that cannot move while the closures hold, shape (n,).");
}

}  // namespace hinge::python
