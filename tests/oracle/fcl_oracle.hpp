// SPDX-License-Identifier: BSD-3-Clause
// FCL as an oracle and a peer, behind plain arrays: its types change layout with compiler flags, so they stay in the
// .cpp.
#pragma once

#include <array>
#include <cstddef>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <utility>
#include <vector>

namespace hinge::oracle {

using Position = std::array<double, 3>;
/// Rotation row by row, then translation: x -> R x + t.
using Placement = std::array<double, 12>;
using Pairs = std::vector<std::pair<std::size_t, std::size_t>>;

/// Spheres in FCL's dynamic AABB tree manager, made once and moved.
class FclSpheres {
 public:
  /// admits(i, j) with i < j: is the pair looked at? Called for pairs whose boxes overlap.
  FclSpheres(std::span<const double> radii, std::function<bool(std::size_t, std::size_t)> admits);
  FclSpheres(FclSpheres&&) noexcept;
  ~FclSpheres();

  /// New centres of the spheres listed in `moved`; all positions are given, those of others must not have changed.
  void update(std::span<const Position> positions, std::span<const std::size_t> moved);
  bool any();
  /// Colliding pairs i < j, in the order FCL finds them.
  Pairs all();
  /// Smallest distance between the surfaces of admitted pairs, not meaningful when a pair penetrates.
  std::optional<double> distance();

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

/// Triangle meshes, one BVH each.
class FclMeshes {
 public:
  /// Nine numbers per triangle.
  explicit FclMeshes(const std::vector<std::vector<std::array<double, 9>>>& meshes);
  FclMeshes(FclMeshes&&) noexcept;
  ~FclMeshes();

  bool collide(std::size_t i, const Placement& at_i, std::size_t j, const Placement& at_j) const;
  /// Every intersecting pair of triangles (of i, of j), sorted.
  Pairs contacts(std::size_t i, const Placement& at_i, std::size_t j, const Placement& at_j) const;
  double distance(std::size_t i, const Placement& at_i, std::size_t j, const Placement& at_j) const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace hinge::oracle
