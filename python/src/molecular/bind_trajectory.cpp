// SPDX-License-Identifier: BSD-3-Clause
// Trajectories, and coordinates as arguments.
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "frame_source.hpp"
#include "run_aside.hpp"
#include "run_slices.hpp"

namespace hinge::python {

namespace py = pybind11;
using namespace hinge::molecular;

const Trajectory& TrajectoryHandle::opened() const {
  if (frames == nullptr) throw py::value_error(path + ": the trajectory is closed");
  return *frames;
}

FrameSource::FrameSource(py::handle value, const char* name, const MoleculeHandle& molecule, const py::object& decimals)
    : atoms_(molecule.atom_count()) {
  if (!decimals.is_none()) {
    if (!PyIndex_Check(decimals.ptr())) throw py::type_error("decimals: expected an integer or None");
    const py::int_ digits(decimals);
    if (digits < py::int_(0) || digits > py::int_(9))
      throw py::value_error("decimals: " + py::repr(digits).cast<std::string>() + ", expected 0 to 9 or None");
    grid_ = std::pow(10.0, digits.cast<int>());
  }
  if (py::isinstance<TrajectoryHandle>(value)) {
    const auto& given = value.cast<const TrajectoryHandle&>();
    given.opened();
    if (given.molecule.molecule != molecule.molecule)
      throw py::value_error(std::string(name) + ": a trajectory of another molecule, expected one of the checker's");
    file_ = given.frames;
    molecule_ = given.molecule.molecule;
    count_ = file_->size();
    return;
  }
  const auto rows = static_cast<py::ssize_t>(atoms_);
  const std::vector<Shape> shapes{{any, rows, 3}, {rows, 3}};
  array_ = as_doubles(value, name, shapes, "x, y, z of every atom, angstrom");
  require_finite(array_, name);
  one_ = array_.ndim() == 2;
  count_ = one_ ? 1 : static_cast<std::size_t>(array_.shape(0));
}

std::span<const Vec3> FrameSource::frame(std::size_t k, std::vector<Vec3>& memory) const {
  if (file_ != nullptr) {
    memory = file_->kept(file_->frame(k));
  } else {
    const std::span<const Vec3> given = positions_at(array_.data() + 3 * atoms_ * k, atoms_);
    if (!grid_) return given;
    memory.assign(given.begin(), given.end());
  }
  if (grid_)
    for (Vec3& x : memory)
      for (int c = 0; c < 3; ++c) x[c] = std::nearbyint(x[c] * *grid_) / *grid_;
  return memory;
}

namespace {

Doubles read_frames(const TrajectoryHandle& self, std::size_t first, std::size_t step, std::size_t count,
                    unsigned threads, const py::object& progress) {
  const Trajectory& file = self.opened();
  const std::size_t atoms = self.molecule.atom_count();
  if (count > 0 && first + (count - 1) * step >= file.size())
    throw py::index_error("frame " + std::to_string(first + (count - 1) * step) + ", expected below " +
                          std::to_string(file.size()));
  Doubles out(Shape{static_cast<py::ssize_t>(count), static_cast<py::ssize_t>(atoms), 3});
  double* const data = out.mutable_data();
  const auto frames = self.frames;  // another thread may close the trajectory
  run_slices(count, threads, progress, [&]() -> Slice {
    return [&](std::size_t begin, std::size_t end) {
      for (std::size_t k = begin; k < end; ++k) {
        const std::vector<Vec3> frame = frames->kept(frames->frame(first + k * step));
        std::copy_n(numbers(frame.data()), 3 * atoms, data + 3 * atoms * k);
      }
    };
  });
  return out;
}

}  // namespace

void bind_trajectory(py::module_& module) {
  py::class_<TrajectoryHandle>(module, "TrajectoryBase", "A trajectory; see Trajectory.")
      .def(py::init([](const MoleculeHandle& molecule, const std::string& path, bool may_have_more) {
        return run_aside([=] {
          auto frames = std::make_shared<Trajectory>(path, molecule.structure(), molecule.read, may_have_more);
          return TrajectoryHandle{path, molecule, std::move(frames)};
        });
      }))
      .def("__len__", [](const TrajectoryHandle& self) { return self.opened().size(); })
      .def(
          "close", [](TrajectoryHandle& self) { self.frames.reset(); },
          "close(self)\n--\n\nClose the file. Later calls raise ValueError.")
      .def_property_readonly(
          "closed", [](const TrajectoryHandle& self) { return self.frames == nullptr; }, "True after close().")
      .def_property_readonly(
          "path", [](const TrajectoryHandle& self) { return self.path; }, "The file's path.")
      .def_property_readonly(
          "notes", [](const TrajectoryHandle& self) { return self.opened().notes(); },
          "Warnings about the file, one sentence each.")
      .def(
          "number",
          [](const TrajectoryHandle& self, std::size_t k) {
            if (k >= self.opened().size())
              throw py::index_error("frame " + std::to_string(k) + ", expected below " +
                                    std::to_string(self.opened().size()));
            return self.opened().number(k);
          },
          py::arg("k"), "number(self, k)\n--\n\nReturn the model number of frame k, or k if the format has no numbers.")
      .def("_read", &read_frames);
}

}  // namespace hinge::python
