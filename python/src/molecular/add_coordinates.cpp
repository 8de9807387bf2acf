// SPDX-License-Identifier: BSD-3-Clause
// Answers of a checker for given coordinates: arrays or trajectories.
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include "arrays.hpp"
#include "checker_handle.hpp"
#include "frame_source.hpp"
#include "hinge/molecular/bond_gauge.hpp"
#include "run_slices.hpp"

namespace hinge::python {

namespace py = pybind11;
using namespace hinge::molecular;

namespace {

/// Calls use(k, verdict) for every frame, in any order and on any thread.
template <class Use>
void check_frames(CheckerHandle& self, const FrameSource& frames, const Mode& mode, const py::object& threads,
                  const py::object& progress, const Use& use) {
  run_slices(self.pool, frames.size(), as_threads(threads, self.threads), progress,
             [&](Checker& checker, std::size_t first, std::size_t last) {
               std::vector<Vec3> memory;
               for (std::size_t k = first; k < last; ++k)
                 use(k, checker.check_coordinates(frames.frame(k, memory), mode));
             });
}

py::object collides_coordinates(CheckerHandle& self, const py::object& x, const py::object& decimals,
                                const py::object& threads, const py::object& progress) {
  const FrameSource frames(x, "x", self.molecule, decimals);
  std::vector<std::uint8_t> verdicts(frames.size());
  check_frames(self, frames, Mode{Mode::Kind::any}, threads, progress,
               [&](std::size_t k, const Verdict& verdict) { verdicts[k] = verdict.collides ? 1 : 0; });
  if (frames.one()) return py::bool_(verdicts[0] != 0);
  return to_booleans(std::move(verdicts));
}

py::object list_pairs(CheckerHandle& self, const FrameSource& frames, const Mode& mode, const py::object& threads,
                      const py::object& progress) {
  std::vector<std::vector<PairRow>> rows(frames.size());
  check_frames(self, frames, mode, threads, progress, [&](std::size_t k, const Verdict& verdict) {
    for (const Contact& contact : verdict.pairs) rows[k].push_back(pair_row(static_cast<std::int64_t>(k), contact));
    if (verdict.closest) rows[k].push_back(pair_row(static_cast<std::int64_t>(k), *verdict.closest));
  });
  return to_array(joined(rows));
}

py::object pairs_coordinates(CheckerHandle& self, const py::object& x, const py::object& within,
                             const py::object& decimals, const py::object& threads, const py::object& progress) {
  const Mode mode = as_mode(within);
  const FrameSource frames(x, "x", self.molecule, decimals);
  return list_pairs(self, frames, mode, threads, progress);
}

py::object closest_coordinates(CheckerHandle& self, const py::object& x, const py::object& decimals,
                               const py::object& threads, const py::object& progress) {
  const FrameSource frames(x, "x", self.molecule, decimals);
  return list_pairs(self, frames, Mode{Mode::Kind::closest}, threads, progress);
}

constexpr const char* collides_coordinates_doc =
    "collides_coordinates(self, x, *, decimals=None, threads=None, progress=None)\n--\n\n"
    "Tell which coordinates collide. Every admitted pair is tested, independent of the selection.\n\n"
    "x: shape (n, n_atoms, 3), or (n_atoms, 3) for one frame, angstrom; or a Trajectory of the molecule. Float64\n"
    "arrays in C order are not copied. decimals: round to so many decimals first. Coordinates with at most three\n"
    "decimals, as in files, are compared in exact decimals; decimals=3 restores them from 32-bit floats, as\n"
    "MDAnalysis holds them. Returns booleans of shape (n,), or one bool.";
constexpr const char* pairs_coordinates_doc =
    "pairs_coordinates(self, x, *, within=0.0, decimals=None, threads=None, progress=None)\n--\n\n"
    "Return the pairs of atoms that collide, or with d < threshold + within (angstrom), as pairs() does.\n\n"
    "x, decimals: as in collides_coordinates(). `conformation` is the frame.";
constexpr const char* closest_coordinates_doc =
    "closest_coordinates(self, x, *, decimals=None, threads=None, progress=None)\n--\n\n"
    "Return the pair of least distance - threshold of each frame, as rows of pairs().\n\n"
    "x, decimals: as in collides_coordinates().";

}  // namespace

void add_coordinates(CheckerClass& checker) {
  checker
      .def("collides_coordinates", &collides_coordinates, py::arg("x"), py::kw_only(), py::arg("decimals") = py::none(),
           py::arg("threads") = py::none(), py::arg("progress") = py::none(), collides_coordinates_doc)
      .def("pairs_coordinates", &pairs_coordinates, py::arg("x"), py::kw_only(), py::arg("within") = 0.0,
           py::arg("decimals") = py::none(), py::arg("threads") = py::none(), py::arg("progress") = py::none(),
           pairs_coordinates_doc)
      .def("closest_coordinates", &closest_coordinates, py::arg("x"), py::kw_only(), py::arg("decimals") = py::none(),
           py::arg("threads") = py::none(), py::arg("progress") = py::none(), closest_coordinates_doc);
}

}  // namespace hinge::python
