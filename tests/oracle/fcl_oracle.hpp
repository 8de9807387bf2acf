// SPDX-License-Identifier: BSD-3-Clause
// FCL as an oracle, behind plain arrays. FCL's types stay in the .cpp, because their layout changes with compiler
// flags.
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
/// Rotation by rows, then translation: x -> R x + t.
using Placement = std::array<double, 12>;
using Pairs = std::vector<std::pair<std::size_t, std::size_t>>;

/// Spheres in FCL's dynamic AABB tree manager, built once and then moved.
class FclSpheres {
 public:
  /// admits(i, j) with i < j returns whether a pair is tested. It is called for pairs whose boxes overlap.
  FclSpheres(std::span<const double> radii, std::function<bool(std::size_t, std::size_t)> admits);
  FclSpheres(FclSpheres&&) noexcept;
  ~FclSpheres();

  /// Moves the spheres listed in `moved`. `positions` has all centres; those not listed must be unchanged.
  void update(std::span<const Position> positions, std::span<const std::size_t> moved);
  bool any();
  /// Returns colliding pairs with i < j, in FCL's order.
  Pairs all();
  /// Returns the smallest distance of the surfaces of admitted pairs; not meaningful if a pair penetrates.
  std::optional<double> distance();

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

/// Triangle meshes, one BVH each.
class FclMeshes {
 public:
  /// meshes: nine numbers per triangle, its three corners.
  explicit FclMeshes(const std::vector<std::vector<std::array<double, 9>>>& meshes);
  FclMeshes(FclMeshes&&) noexcept;
  ~FclMeshes();

  bool collide(std::size_t i, const Placement& at_i, std::size_t j, const Placement& at_j) const;
  /// Returns all intersecting pairs of triangles (of i, of j), sorted.
  Pairs contacts(std::size_t i, const Placement& at_i, std::size_t j, const Placement& at_j) const;
  double distance(std::size_t i, const Placement& at_i, std::size_t j, const Placement& at_j) const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace hinge::oracle
