// SPDX-License-Identifier: BSD-3-Clause
// FrameSource: coordinates as an argument, from an array or from a trajectory.
#pragma once

#include <pybind11/pybind11.h>

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include "arrays.hpp"
#include "hinge/core/vec3.hpp"
#include "hinge/molecular/trajectory.hpp"
#include "molecule_handle.hpp"

namespace hinge::python {

/// A trajectory as Python holds it. Its molecule lives as long as it.
struct TrajectoryHandle {
  using MadeByInit = void;
  std::string path;
  MoleculeHandle molecule;
  std::shared_ptr<const molecular::Trajectory> frames;  ///< null: closed

  /// Throws ValueError if it is closed.
  const molecular::Trajectory& opened() const;
};

/// Frames of a molecule's atoms. Threads may read frames at the same time.
class FrameSource {
 public:
  /// value: an array of shape (n, n_atoms, 3) or (n_atoms, 3), angstrom, or a Trajectory. decimals: round coordinates
  /// to this number of decimals; None: use them as they are. Throws TypeError and ValueError, which name the argument.
  FrameSource(pybind11::handle value, const char* name, const MoleculeHandle& molecule,
              const pybind11::object& decimals);

  std::size_t size() const noexcept { return count_; }
  /// True if the argument is one frame, of shape (n_atoms, 3).
  bool one() const noexcept { return one_; }
  /// Returns frame k < size(), angstrom. `memory` may hold it. Throws LoadError for a damaged file.
  std::span<const Vec3> frame(std::size_t k, std::vector<Vec3>& memory) const;

 private:
  Doubles array_;
  std::shared_ptr<const molecular::Trajectory> file_;
  std::shared_ptr<const molecular::Molecule> molecule_;  // the file refers to its structure
  std::optional<double> grid_;                           // 10^decimals
  std::size_t count_ = 0, atoms_ = 0;
  bool one_ = false;
};

}  // namespace hinge::python
