// SPDX-License-Identifier: BSD-3-Clause
// Reading molecules, and their atoms, bonds and torsions as columns.
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include <algorithm>
#include <numbers>
#include <optional>
#include <utility>

#include "arrays.hpp"
#include "hinge/core/error.hpp"
#include "hinge/molecular/bond_exclusions.hpp"
#include "hinge/molecular/bonds.hpp"
#include "hinge/molecular/components.hpp"
#include "hinge/molecular/join_structures.hpp"
#include "hinge/molecular/selection.hpp"
#include "molecule_handle.hpp"
#include "run_aside.hpp"

namespace hinge::python {

namespace py = pybind11;
using namespace hinge::molecular;

Part as_part(const Structure& structure, py::handle value, const char* name, ResidueNames names) {
  if (py::isinstance<py::str>(value)) return find_part(structure, value.cast<std::string>(), names);
  Part part{name, {}};
  for (const std::size_t residue : as_indices(value, name, structure.residues.size()))
    part.residues.push_back(static_cast<std::uint32_t>(residue));
  std::sort(part.residues.begin(), part.residues.end());
  part.residues.erase(std::unique(part.residues.begin(), part.residues.end()), part.residues.end());
  return part;
}

namespace {

/// Options as Python passes them. See hinge.molecular.Molecule.
struct MoleculeArguments {
  std::vector<std::string> paths;
  ReadOptions read;
  std::string loops;
  bool keep_hydrogen_bonds = false;
  py::list place;  // (part, distance, turn)
  py::object held;
};

std::vector<HeldPlacement> as_held(const py::object& value, std::size_t atoms) {
  std::vector<HeldPlacement> held;
  if (value.is_none()) return held;
  const auto rows = py::array_t<std::uint32_t, py::array::c_style | py::array::forcecast>::ensure(value);
  if (!rows || rows.ndim() != 2 || rows.shape(1) != 6)
    throw py::value_error("held: expected an array of shape (n, 6): two atoms and four points per row");
  for (py::ssize_t k = 0; k < rows.shape(0); ++k) {
    const std::uint32_t* row = rows.data() + 6 * k;
    for (int c = 0; c < 6; ++c)
      if (row[c] >= atoms) throw py::index_error("held: atom " + std::to_string(row[c]) + " does not exist");
    held.push_back({{row[0], row[1]}, {row[2], row[3], row[4], row[5]}});
  }
  return held;
}

Structure read_files(const MoleculeArguments& given) {
  return run_aside([paths = given.paths, read = given.read] {
    std::vector<Structure> structures{read_structure(paths.front(), read)};
    ReadOptions whole = read;
    whole.model.reset();
    whole.hetero = true;
    for (std::size_t k = 1; k < paths.size(); ++k) structures.push_back(read_structure(paths[k], whole));
    return join_structures(std::move(structures));
  });
}

std::unique_ptr<MoleculeHandle> make_molecule(const MoleculeArguments& given) {
  Structure structure = read_files(given);
  auto handle = std::make_unique<MoleculeHandle>();
  handle->read = given.read;
  MoleculeOptions options;
  for (const py::handle item : given.place) {
    const auto [part, distance, turn] = item.cast<std::tuple<py::object, double, double>>();
    if (!(distance >= 0.0 && distance <= 1e9) || !(turn >= 0.0 && turn <= std::numbers::pi))
      throw py::value_error("place: range (" + std::to_string(distance) + ", " + std::to_string(turn) +
                            "), expected a distance from 0 to 1e9 angstrom and an angle from 0 to pi rad");
    options.placed.push_back(as_part(structure, part, "place", ResidueNames::only));
    handle->ranges.push_back({distance, turn});
  }
  if (!given.loops.empty()) options.loops = find_loops(structure, given.loops);
  options.keep_hydrogen_bonds = given.keep_hydrogen_bonds;
  options.held = as_held(given.held, structure.atoms.size());
  handle->molecule = run_aside([structure = std::move(structure), options]() mutable {
    return std::make_shared<const Molecule>(std::move(structure), options);
  });
  return handle;
}

/// Atoms as columns, for one structured array.
py::dict atom_columns(const MoleculeHandle& m) {
  const Structure& s = m.structure();
  py::list names, elements, residue_names, chains, altlocs, codes;
  std::vector<std::int32_t> residue_of, numbers_of, serials, records;
  for (const Atom& atom : s.atoms) {
    const Residue& residue = s.residues[atom.residue];
    names.append(atom.name);
    elements.append(atom.element);
    residue_names.append(residue.name);
    chains.append(s.chains[residue.chain].name);
    altlocs.append(atom.altloc == '\0' ? std::string() : std::string(1, atom.altloc));
    codes.append(residue.insertion_code == '\0' ? std::string() : std::string(1, residue.insertion_code));
    residue_of.push_back(static_cast<std::int32_t>(atom.residue));
    numbers_of.push_back(residue.sequence_number);
    serials.push_back(atom.serial);
    records.push_back(static_cast<std::int32_t>(atom.record));
  }
  py::dict columns;
  columns["name"] = names;
  columns["element"] = elements;
  columns["residue"] = to_array(std::move(residue_of));
  columns["residue_name"] = residue_names;
  columns["residue_number"] = to_array(std::move(numbers_of));
  columns["insertion_code"] = codes;
  columns["chain"] = chains;
  columns["altloc"] = altlocs;
  columns["serial"] = to_array(std::move(serials));
  columns["record"] = to_array(std::move(records));
  return columns;
}

py::dict torsion_columns(const MoleculeHandle& m) {
  py::list names, labels;
  std::vector<std::int32_t> residues;
  std::vector<std::uint32_t> atoms;
  std::vector<double> references;
  for (const Torsion& torsion : m->torsions()) {
    names.append(torsion.name);
    labels.append(torsion_label(m.structure(), torsion));
    residues.push_back(static_cast<std::int32_t>(torsion.residue));
    atoms.insert(atoms.end(), torsion.atoms.begin(), torsion.atoms.end());
    references.push_back(torsion.reference);
  }
  const auto count = static_cast<py::ssize_t>(references.size());
  py::dict columns;
  columns["label"] = labels;
  columns["name"] = names;
  columns["residue"] = to_array(std::move(residues));
  columns["atoms"] = to_array(std::move(atoms), {count, 4});
  columns["reference"] = to_array(std::move(references));
  return columns;
}

constexpr const char* origins[] = {"residue_template", "peptide",   "phosphodiester", "disulphide",
                                   "record",           "component", "covalent_radii"};
constexpr const char* orders[] = {"unknown", "single", "multiple", "coordination"};

py::dict bond_columns(const MoleculeHandle& m) {
  std::vector<std::uint32_t> first, second;
  py::list origin, order;
  for (const Bond& bond : m.structure().bonds) {
    first.push_back(bond.first);
    second.push_back(bond.second);
    origin.append(origins[static_cast<std::size_t>(bond.origin)]);
    order.append(orders[static_cast<std::size_t>(bond.order)]);
  }
  py::dict columns;
  columns["i"] = to_array(std::move(first));
  columns["j"] = to_array(std::move(second));
  columns["origin"] = origin;
  columns["order"] = order;
  return columns;
}

std::vector<std::string> notes_of(const MoleculeHandle& m) {
  std::vector<std::string> notes = m.structure().notes;
  notes.insert(notes.end(), m->notes().begin(), m->notes().end());
  return notes;
}

py::array_t<std::int64_t> select(const MoleculeHandle& m, const std::string& words, bool omega, bool of_loops) {
  const auto chosen = of_loops ? select_loop_torsions(*m, words, omega) : select_torsions(*m, words, omega);
  return to_array(std::vector<std::int64_t>(chosen.begin(), chosen.end()));
}

}  // namespace

void bind_molecule(py::module_& module) {
  py::class_<MoleculeHandle>(module, "MoleculeBase", "A molecule; see Molecule.")
      .def(py::init([](std::vector<std::string> paths, std::optional<int> model,
                       const std::optional<std::string>& altloc, bool hetero, bool waters, bool keep_hydrogens,
                       bool geometry, const std::vector<std::string>& components, const std::string& dictionary,
                       std::string loops, bool keep_hydrogen_bonds, py::list place, py::object held) {
        MoleculeArguments given{std::move(paths), {}, std::move(loops), keep_hydrogen_bonds, std::move(place),
                                std::move(held)};
        given.read.model = model;
        if (altloc) given.read.altloc = altloc->at(0);
        given.read.hetero = hetero;
        given.read.waters = waters;
        given.read.keep_hydrogens = keep_hydrogens;
        given.read.bonds = geometry ? BondSearch::geometry : BondSearch::recorded;
        given.read.components.assign(components.begin(), components.end());
        given.read.dictionary = dictionary;
        return make_molecule(given);
      }))
      .def_property_readonly(
          "name", [](const MoleculeHandle& m) { return m.structure().name; }, "Entry id of the file, or its stem.")
      .def_property_readonly("n_atoms", &MoleculeHandle::atom_count, "Number of atoms.")
      .def_property_readonly(
          "n_residues", [](const MoleculeHandle& m) { return m.structure().residues.size(); }, "Number of residues.")
      .def_property_readonly(
          "n_chains", [](const MoleculeHandle& m) { return m.structure().chains.size(); }, "Number of chains.")
      .def_property_readonly(
          "n_models", [](const MoleculeHandle& m) { return m.structure().models.size(); },
          "Number of models that were read.")
      .def_property_readonly(
          "model_numbers", [](const MoleculeHandle& m) { return to_array(std::vector(m.structure().model_numbers)); },
          "Model numbers in the file, shape (n_models,).")
      .def_property_readonly("notes", &notes_of, "Repairs, guesses and warnings, one sentence each.")
      .def_property_readonly(
          "n_closures", [](const MoleculeHandle& m) { return m->closure_atoms().size(); },
          "Number of cycles of torsions that a closure bond closes.")
      .def_property_readonly(
          "has_loops", [](const MoleculeHandle& m) { return !m->loops().empty(); },
          "True if the molecule was read with loops.")
      .def_property_readonly(
          "n_placed", [](const MoleculeHandle& m) { return m->placed_parts().size(); }, "Number of placed parts.")
      .def(
          "model",
          [](const py::object& self, std::size_t k) {
            const auto& m = self.cast<const MoleculeHandle&>();
            const auto& models = m.structure().models;
            if (k >= models.size())
              throw py::index_error("model: " + std::to_string(k) + ", expected an index below " +
                                    std::to_string(models.size()));
            return view_of(numbers(models[k].data()), {static_cast<py::ssize_t>(m.atom_count()), 3}, self);
          },
          py::arg("k"),
          "model(self, k)\n--\n\nReturn the coordinates of model k (an index from 0): a read-only view of shape\n"
          "(n_atoms, 3), angstrom. Raises IndexError.")
      .def(
          "label",
          [](const MoleculeHandle& m, std::size_t atom) {
            if (atom >= m.atom_count())
              throw py::index_error("atom: " + std::to_string(atom) + ", expected an index below " +
                                    std::to_string(m.atom_count()));
            return label(m.structure(), static_cast<std::uint32_t>(atom));
          },
          py::arg("atom"),
          "label(self, atom)\n--\n\nReturn the name of an atom, such as 'A:LYS77:NZ'. Raises IndexError.")
      .def(
          "bond_distance",
          [](const MoleculeHandle& m, std::size_t i, std::size_t j, int limit) {
            if (i >= m.atom_count() || j >= m.atom_count())
              throw py::index_error("atom: expected indices below " + std::to_string(m.atom_count()));
            return bond_distance(m.structure(), static_cast<std::uint32_t>(i), static_cast<std::uint32_t>(j), limit);
          },
          py::arg("i"), py::arg("j"), py::arg("limit") = 16,
          "bond_distance(self, i, j, limit=16)\n--\n\nReturn the number of bonds on the shortest path between atoms i "
          "and j, or -1 if it\nis above limit or there is no path.")
      .def("_atom_columns", &atom_columns)
      .def("_torsion_columns", &torsion_columns)
      .def("_bond_columns", &bond_columns)
      .def("_residue_kinds",
           [](const MoleculeHandle& m) {
             std::vector<std::uint8_t> kinds;
             for (const Residue& residue : m.structure().residues)
               kinds.push_back(static_cast<std::uint8_t>(residue.kind));
             return to_array(std::move(kinds));
           })
      .def("_select", &select, py::arg("words"), py::arg("omega"), py::arg("of_loops"))
      .def("_part_residues", [](const MoleculeHandle& m, const std::string& words) {
        return to_array(std::vector(find_part(m.structure(), words).residues));
      });
  module.def(
      "installed_dictionary", [] { return installed_dictionary().string(); },
      "installed_dictionary()\n--\n\nReturn the folder of this machine's monomer dictionary, or ''.");
}

}  // namespace hinge::python
