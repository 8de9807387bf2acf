// SPDX-License-Identifier: BSD-3-Clause
// EnsembleSpread: how much torsions turn, and distances change, from conformation to conformation.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "hinge/core/vec3.hpp"
#include "hinge/molecular/molecule.hpp"

namespace hinge::molecular {

/// The bodies that some torsions join: atoms that no one of these torsions moves against each other. A body also has
/// the axes of the torsions at it, whose atoms it shares with its neighbours.
class TorsionBodies {
 public:
  TorsionBodies(const Molecule& molecule, std::span<const std::size_t> torsions);

  std::size_t size() const noexcept { return size_; }
  /// By atom: its body.
  std::span<const std::uint32_t> of_atom() const noexcept { return of_atom_; }
  /// The two bodies that torsions[k] joins.
  const std::array<std::uint32_t, 2>& joined_by(std::size_t k) const noexcept { return joined_[k]; }
  /// Atoms that say where a body is: those of its axes, and one more where they lie on one line and it has others.
  std::span<const std::uint32_t> points(std::size_t body) const noexcept { return points_[body]; }

 private:
  std::size_t size_ = 0;
  std::vector<std::uint32_t> of_atom_;
  std::vector<std::array<std::uint32_t, 2>> joined_;
  std::vector<std::vector<std::uint32_t>> points_;
};

/// Conformations one by one; memory is 8 bytes for each pair of the bodies' points, however many there are.
class EnsembleSpread {
 public:
  /// torsions: those that may turn, positions in Molecule::torsions(). The molecule must outlive it. ModelError: more
  /// than most_points points.
  EnsembleSpread(const Molecule& molecule, std::span<const std::size_t> torsions);

  static constexpr std::size_t most_points = 8192;  ///< 256 MiB

  /// One more conformation: angstrom, one position per atom. LoadError: a torsion that it leaves undefined.
  void add(std::span<const Vec3> positions);

  std::size_t conformations() const noexcept { return count_; }
  const TorsionBodies& bodies() const noexcept { return bodies_; }
  std::span<const std::size_t> torsions() const noexcept { return torsions_; }
  /// Of torsions[k], rad: the circular standard deviation sqrt(-2 ln R), R the length of the mean of its unit vectors
  /// (K. Mardia and P. Jupp, Directional Statistics, 2000, eq. 2.3.11); infinite where they cancel.
  double circular_std(std::size_t k) const noexcept;
  /// The largest standard deviation, angstrom, of the distance of a point of one body from one of the other. Of a body
  /// to itself: between its own points.
  double distance_spread(std::size_t first, std::size_t second) const noexcept;

 private:
  const Molecule& molecule_;
  std::vector<std::size_t> torsions_;
  TorsionBodies bodies_;
  std::vector<std::uint32_t> points_;                  // atoms
  std::vector<std::vector<std::uint32_t>> points_of_;  // by body: positions in points_
  std::vector<float> mean_, squares_;                  // of the pairs i < j at j (j - 1) / 2 + i (B. Welford, 1962)
  std::vector<double> cosines_, sines_;                // by torsion: sums
  std::size_t count_ = 0;
};

}  // namespace hinge::molecular
