// SPDX-License-Identifier: BSD-3-Clause
// FCL for robots and their surroundings, used as its users do, behind plain arrays: an oracle and a benchmark peer.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <variant>
#include <vector>

#include "oracle/fcl_oracle.hpp"

namespace hinge::oracle {

/// Nine numbers per triangle: its three corners.
using Mesh = std::vector<std::array<double, 9>>;

/// Debian's library, or the same headers compiled for this CPU.
enum class FclBuild : std::uint8_t { debian, native };
/// A loop over the pairs, or DynamicAABBTreeCollisionManager with its update. In a search for the minimum distance,
/// FCL's own callback passes one DistanceResult from pair to pair, and its bound prunes traversals. `unshared` is the
/// manager without this, as in many programs.
enum class FclManner : std::uint8_t { loop, manager, unshared };

/// Measures building: triangles are given in advance, then one BVHModel<OBBRSS<double>> per mesh is built.
template <FclBuild>
class FclTrees {
 public:
  explicit FclTrees(std::span<const Mesh> meshes);
  FclTrees(FclTrees&&) noexcept;
  ~FclTrees();
  /// Builds all trees; call it once.
  void build();

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

/// Meshes at a fixed pose: one BVH of all triangles for the loop, one BVH each for the manager.
template <FclBuild build>
class FclScene {
 public:
  explicit FclScene(std::span<const Mesh> objects);
  FclScene(FclScene&&) noexcept;
  ~FclScene();
  void place(const Placement& at);

  struct Impl;
  Impl& impl() const noexcept { return *impl_; }

 private:
  std::unique_ptr<Impl> impl_;
};

/// One mesh per link (empty meshes are ignored) and the tested pairs of links. Contacts are not computed: only whether
/// a pair collides.
template <FclBuild build>
class FclRobot {
 public:
  FclRobot(std::span<const Mesh> links, const Pairs& tested);
  FclRobot(FclRobot&&) noexcept;
  ~FclRobot();

  /// Sets the world poses of all links, by posture, and converts them to FCL's type.
  void set_postures(std::span<const std::vector<Placement>> postures);
  /// Selects the posture of the next queries. Queries update objects and manager.
  void take(std::size_t posture) noexcept;

  bool any(FclManner manner);
  /// Appends colliding pairs of links i < j, in FCL's order.
  void all(FclManner manner, Pairs& pairs);
  /// Returns the smallest distance of tested pairs; 0 as soon as one collides.
  double distance(FclManner manner);
  bool hits(const FclScene<build>& scene, FclManner manner);

  bool collide(std::size_t i, std::size_t j) const;
  double distance(std::size_t i, std::size_t j) const;
  bool hits(const FclScene<build>& scene, std::size_t link) const;
  double distance(const FclScene<build>& scene, std::size_t link) const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

/// FCL's shapes, tested through libccd. Capsules, boxes and cylinders are centred at their frame's origin. Capsules and
/// cylinders are along z; the length of a capsule is that of its segment.
struct FclSphere {
  double radius;
};
struct FclCapsule {
  double radius, length;
};
struct FclBox {
  std::array<double, 3> size;
};
struct FclCylinder {
  double radius, length;
};
double distance(const FclSphere& a, const Placement& at_a, const FclSphere& b, const Placement& at_b);
double distance(const FclCapsule& a, const Placement& at_a, const FclCapsule& b, const Placement& at_b);
double distance(const FclBox& a, const Placement& at_a, const FclBox& b, const Placement& at_b);

/// FCL treats these shapes as solid.
using FclShape = std::variant<FclSphere, FclCapsule, FclBox, FclCylinder>;
bool collide(const FclShape& a, const Placement& at_a, const FclShape& b, const Placement& at_b);

}  // namespace hinge::oracle
