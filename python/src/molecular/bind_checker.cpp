// SPDX-License-Identifier: BSD-3-Clause
// Checkers: rules and selection of a molecule, and the answers for configurations.
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include <algorithm>
#include <optional>
#include <utility>

#include "arrays.hpp"
#include "checker_handle.hpp"
#include "run_aside.hpp"
#include "run_slices.hpp"

namespace hinge::python {

namespace py = pybind11;
using namespace hinge::molecular;

std::vector<PairRow> joined(const std::vector<std::vector<PairRow>>& rows) {
  std::size_t count = 0;
  for (const auto& some : rows) count += some.size();
  std::vector<PairRow> all;
  all.reserve(count);
  for (const auto& some : rows) all.insert(all.end(), some.begin(), some.end());
  return all;
}

Mode as_mode(const py::object& within) {
  const double margin = as_length(within, "within", "angstrom");
  return margin == 0.0 ? Mode{Mode::Kind::all} : Mode{Mode::Kind::within, margin};
}

namespace {

const Mode any_pair{Mode::Kind::any};

PairScope as_scope(const Structure& s, const py::list& between, const py::list& inside) {
  std::vector<std::pair<Part, Part>> pairs;
  for (const py::handle item : between) {
    const auto [a, b] = item.cast<std::pair<py::object, py::object>>();
    const auto is_rest = [](const py::object& part) {
      return py::isinstance<py::str>(part) && part.equal(py::str("rest"));
    };
    if (is_rest(a) && is_rest(b)) throw py::value_error("between: ('rest', 'rest'), expected at least one part");
    const Part first = as_part(s, is_rest(a) ? b : a, "between");
    const Part second = is_rest(a) || is_rest(b) ? rest_of(s, first) : as_part(s, b, "between");
    pairs.emplace_back(first, second);
  }
  std::vector<Part> alone;
  for (const py::handle item : inside) alone.push_back(as_part(s, item, "inside"));
  return {s, pairs, alone};
}

std::unique_ptr<CheckerHandle> make_checker(const MoleculeHandle& molecule, const py::object& torsions,
                                            const CheckOptions& options, const std::string& closures,
                                            const std::vector<std::size_t>& open, unsigned threads) {
  std::vector<std::size_t> free = as_indices(torsions, "free", molecule->torsions().size());
  std::sort(free.begin(), free.end());
  free.erase(std::unique(free.begin(), free.end()), free.end());
  for (const std::size_t closure : open)
    if (closure >= molecule->closure_atoms().size())
      throw py::index_error("open_closures: " + std::to_string(closure) + ", expected an index below " +
                            std::to_string(molecule->closure_atoms().size()));
  return run_aside([=] {
    const KeptClosures kept =
        find_kept_closures(*molecule, free, closures == "keep" ? Closures::all : Closures::of_loops, open);
    const Checker checker(molecule.molecule, molecule->select_placed(kept.torsions), options);
    return std::make_unique<CheckerHandle>(molecule, kept, checker, threads);
  });
}

/// Answers "does it collide" for configurations first ... last - 1.
void find_colliding(Checker& checker, const Configurations& q, std::size_t first, std::size_t last,
                    std::uint8_t* verdicts) {
  if (q.dof > 0) {
    try {
      const std::vector<std::uint8_t> found = checker.check_batch(q.slice(first, last));
      std::copy(found.begin(), found.end(), verdicts + first);
    } catch (const ConfigurationError&) {  // it does not name the argument
      require_finite(q.array, q.name);
      throw;
    }
  } else {
    for (std::size_t k = first; k < last; ++k) verdicts[k] = checker.check(q[k], any_pair).collides ? 1 : 0;
  }
}

py::object collides(CheckerHandle& self, const py::object& values, const py::object& threads,
                    const py::object& progress) {
  const Configurations q = as_configurations(values, "q", self.dof());
  if (q.one) {
    as_threads(threads, self.threads);
    std::uint8_t verdict = 0;
    {
      const py::gil_scoped_release unlocked;
      WorkerPool<Checker>::Loan checker(self.pool);
      find_colliding(*checker, q, 0, 1, &verdict);
    }
    return py::bool_(verdict != 0);
  }
  std::vector<std::uint8_t> verdicts(q.count);
  run_slices(self.pool, q.count, as_threads(threads, self.threads), progress,
             [&](Checker& checker, std::size_t first, std::size_t last) {
               find_colliding(checker, q, first, last, verdicts.data());
             });
  return to_booleans(std::move(verdicts));
}

py::object list_pairs(CheckerHandle& self, const py::object& values, const Mode& mode, const py::object& threads,
                      const py::object& progress) {
  const Configurations q = as_configurations(values, "q", self.dof());
  std::vector<std::vector<PairRow>> rows(q.count);
  run_slices(self.pool, q.count, as_threads(threads, self.threads), progress,
             [&](Checker& checker, std::size_t first, std::size_t last) {
               for (std::size_t k = first; k < last; ++k) {
                 const Verdict verdict = checker.check(q[k], mode);
                 for (const Contact& contact : verdict.pairs)
                   rows[k].push_back(pair_row(static_cast<std::int64_t>(k), contact));
                 if (verdict.closest) rows[k].push_back(pair_row(static_cast<std::int64_t>(k), *verdict.closest));
               }
             });
  return to_array(joined(rows));
}

py::object positions(CheckerHandle& self, const py::object& values, const py::object& out, const py::object& threads,
                     const py::object& progress) {
  const Configurations q = as_configurations(values, "q", self.dof());
  const std::size_t atoms = self.molecule.atom_count();
  Shape shape{static_cast<py::ssize_t>(q.count), static_cast<py::ssize_t>(atoms), 3};
  if (q.one) shape.erase(shape.begin());
  py::object result = out;
  if (out.is_none()) {
    result = Doubles(shape);
  } else if (!Doubles::check_(out) || !py::reinterpret_borrow<py::array>(out).writeable()) {
    throw py::type_error("out: expected a writeable array of float64 in C order");
  }
  auto array = py::reinterpret_borrow<Doubles>(result);
  const std::span<const py::ssize_t> given(array.shape(), static_cast<std::size_t>(array.ndim()));
  if (!std::equal(given.begin(), given.end(), shape.begin(), shape.end()))
    throw py::value_error("out: shape " + shape_text(given) + ", expected " + shape_text(shape));
  double* const data = array.mutable_data();
  run_slices(self.pool, q.count, as_threads(threads, self.threads), progress,
             [&](Checker& checker, std::size_t first, std::size_t last) {
               for (std::size_t k = first; k < last; ++k) {
                 checker.check(q[k], any_pair);
                 const std::vector<Vec3> placed = checker.positions();
                 std::copy_n(numbers(placed.data()), 3 * atoms, data + 3 * atoms * k);
               }
             });
  return result;
}

py::array_t<double> closure_residuals(CheckerHandle& self, const py::object& values, const py::object& threads,
                                      const py::object& progress) {
  const Configurations q = as_configurations(values, "q", self.dof());
  const std::size_t closures = self.molecule->closure_atoms().size();
  std::vector<double> residuals(q.count * closures);
  run_slices(self.pool, q.count, as_threads(threads, self.threads), progress,
             [&](Checker& checker, std::size_t first, std::size_t last) {
               for (std::size_t k = first; k < last; ++k) {
                 const Verdict verdict = checker.check(q[k], any_pair);
                 std::copy(verdict.closure_residuals.begin(), verdict.closure_residuals.end(),
                           residuals.begin() + static_cast<std::ptrdiff_t>(k * closures));
               }
             });
  Shape shape{static_cast<py::ssize_t>(q.count), static_cast<py::ssize_t>(closures)};
  if (q.one) shape.erase(shape.begin());
  return to_array(std::move(residuals), shape);
}

constexpr const char* collides_doc =
    "collides(self, q, *, threads=None, progress=None)\n--\n\n"
    "Tell which configurations collide.\n\n"
    "q: shape (n, dof), or (dof,) for one; rad (placed parts: angstrom and rad), relative to the reference.\n"
    "Float64 arrays in C order are not copied. Returns booleans of shape (n,), or one bool. Pairs whose\n"
    "distance the selection cannot change are left out (constant_contacts). Raises TypeError and ValueError.";
constexpr const char* pairs_doc =
    "pairs(self, q, *, within=0.0, threads=None, progress=None)\n--\n\n"
    "Return the pairs of atoms that collide, or with d < threshold + within.\n\n"
    "q: as in collides(). within: angstrom, at least 0. Returns a structured array with one row per pair, sorted by\n"
    "conformation, i and j: conformation (row of q), i, j (atoms), distance and threshold (angstrom), collides.";
constexpr const char* closest_doc =
    "closest(self, q, *, threads=None, progress=None)\n--\n\n"
    "Return the pair of least distance - threshold of each configuration, as rows of pairs().\n\n"
    "q: as in collides(). A pair that collides comes first, if any does. A configuration without tested pairs has no "
    "row.";
constexpr const char* positions_doc =
    "positions(self, q, *, out=None, threads=None, progress=None)\n--\n\n"
    "Return the coordinates of all atoms: shape (n, n_atoms, 3), or (n_atoms, 3) for one configuration; angstrom.\n\n"
    "q: as in collides(). out: a float64 array of that shape in C order, which is filled and returned.";

}  // namespace

void bind_checker(py::module_& module) {
  PYBIND11_NUMPY_DTYPE(PairRow, conformation, i, j, distance, threshold, collides);
  module.attr("pair_dtype") = py::dtype::of<PairRow>();
  CheckerClass checker(module, "CheckerBase", "A checker; see Checker.");
  checker
      .def(py::init([](const MoleculeHandle& molecule, const py::object& torsions, std::string rules,
                       std::optional<std::string> radii, std::optional<double> rho, std::optional<bool> hydrogen_bonds,
                       std::optional<double> allowance, std::optional<int> min_bonds, bool exempt_reference,
                       bool exempt_interfaces, const py::list& between, const py::list& inside, std::string engine,
                       const std::string& closures, const std::vector<std::size_t>& open, const py::object& threads) {
        CheckOptions options;
        options.thresholds = {std::move(radii), rho, hydrogen_bonds, allowance, std::move(rules)};
        options.min_bonds = min_bonds;
        options.exempt_reference = exempt_reference;
        options.exempt_interfaces = exempt_interfaces;
        options.scope = as_scope(molecule.structure(), between, inside);
        options.engine = std::move(engine);
        return make_checker(molecule, torsions, options, closures, open, as_threads(threads, 1));
      }))
      .def("collides", &collides, py::arg("q"), py::kw_only(), py::arg("threads") = py::none(),
           py::arg("progress") = py::none(), collides_doc)
      .def(
          "pairs",
          [](CheckerHandle& self, const py::object& q, const py::object& within, const py::object& threads,
             const py::object& progress) {
            const Mode mode = as_mode(within);
            return list_pairs(self, q, mode, threads, progress);
          },
          py::arg("q"), py::kw_only(), py::arg("within") = 0.0, py::arg("threads") = py::none(),
          py::arg("progress") = py::none(), pairs_doc)
      .def(
          "closest",
          [](CheckerHandle& self, const py::object& q, const py::object& threads, const py::object& progress) {
            return list_pairs(self, q, Mode{Mode::Kind::closest}, threads, progress);
          },
          py::arg("q"), py::kw_only(), py::arg("threads") = py::none(), py::arg("progress") = py::none(), closest_doc)
      .def("positions", &positions, py::arg("q"), py::kw_only(), py::arg("out") = py::none(),
           py::arg("threads") = py::none(), py::arg("progress") = py::none(), positions_doc)
      .def("closure_residuals", &closure_residuals, py::arg("q"), py::kw_only(), py::arg("threads") = py::none(),
           py::arg("progress") = py::none(),
           "closure_residuals(self, q, *, threads=None, progress=None)\n--\n\nReturn how far each closure is from "
           "closed.\n\n"
           "q: as in collides(). Returns shape (n, n_closures), angstrom.");
  add_facts(checker);
  add_coordinates(checker);
  add_sampling(checker);
  add_paths(checker);
  add_relaxation(checker);
  add_planning(checker);
}

}  // namespace hinge::python
