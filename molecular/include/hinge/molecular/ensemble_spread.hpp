// SPDX-License-Identifier: BSD-3-Clause
// EnsembleSpread: how much torsions and distances vary over the conformations of an ensemble.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "hinge/core/api.hpp"
#include "hinge/core/vec3.hpp"
#include "hinge/molecular/molecule.hpp"

namespace hinge::molecular {

/// The bodies that a set of torsions joins. A body is a set of atoms whose relative positions these torsions do not
/// change. The points of a body include the axis atoms of its torsions, which it shares with its neighbours.
class HINGE_API TorsionBodies {
 public:
  /// torsions: indices in Molecule::torsions(). Independent of the molecule after construction.
  TorsionBodies(const Molecule& molecule, std::span<const std::size_t> torsions);

  /// Number of bodies.
  std::size_t size() const noexcept { return size_; }
  /// Returns the body of each atom. Valid for this object's lifetime, as are the other views.
  std::span<const std::uint32_t> of_atom() const noexcept { return of_atom_; }
  /// Returns the two bodies that torsions[k] joins.
  const std::array<std::uint32_t, 2>& joined_by(std::size_t k) const noexcept { return joined_[k]; }
  /// Returns atoms that determine the body's position: the atoms of its axes, and a further one if those are collinear.
  std::span<const std::uint32_t> points(std::size_t body) const noexcept { return points_[body]; }

 private:
  std::size_t size_ = 0;
  std::vector<std::uint32_t> of_atom_;
  std::vector<std::array<std::uint32_t, 2>> joined_;
  std::vector<std::vector<std::uint32_t>> points_;
};

/// Accumulates conformations one by one, without storing them. Memory is 8 bytes per pair of points, independent of the
/// number of conformations. Not thread-safe: add() changes the sums.
class HINGE_API EnsembleSpread {
 public:
  /// torsions: those that may turn, indices in Molecule::torsions(). The molecule must outlive this object. Throws
  /// ModelError if the bodies have more than most_points points.
  EnsembleSpread(const Molecule& molecule, std::span<const std::size_t> torsions);

  static constexpr std::size_t most_points = 8192;  ///< 256 MiB of sums

  /// Adds a conformation. positions: angstrom, one per atom. Throws LoadError if a torsion is undefined there.
  void add(std::span<const Vec3> positions);

  /// Number of conformations added.
  std::size_t conformations() const noexcept { return count_; }
  /// The bodies; valid for this object's lifetime.
  const TorsionBodies& bodies() const noexcept { return bodies_; }
  /// The torsions given to the constructor; valid for this object's lifetime.
  std::span<const std::size_t> torsions() const noexcept { return torsions_; }
  /// Returns the circular standard deviation of torsions()[k], rad: sqrt(-2 ln R), where R is the length of the mean of
  /// the unit vectors (K. Mardia and P. Jupp, Directional Statistics, 2000, eq. 2.3.11). Infinite if R is 0.
  double circular_std(std::size_t k) const noexcept;
  /// Returns the largest standard deviation, angstrom, of the distance between a point of one body and a point of the
  /// other. For first == second: between the body's own points. Needs at least one conformation.
  double distance_spread(std::size_t first, std::size_t second) const noexcept;

 private:
  const Molecule& molecule_;
  std::vector<std::size_t> torsions_;
  TorsionBodies bodies_;
  std::vector<std::uint32_t> points_;                  // atom indices
  std::vector<std::vector<std::uint32_t>> points_of_;  // per body: indices in points_
  std::vector<float> mean_, squares_;                  // of the pair i < j at j (j - 1) / 2 + i (B. Welford, 1962)
  std::vector<double> cosines_, sines_;                // sums, per torsion
  std::size_t count_ = 0;
};

}  // namespace hinge::molecular
