// SPDX-License-Identifier: BSD-3-Clause
// FCL asked about robots and their surroundings, as its users do it, behind plain arrays: an oracle and a peer.
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

/// Nine numbers per triangle: three corners.
using Mesh = std::vector<std::array<double, 9>>;

/// Debian's library, or the same headers compiled for the machine at hand.
enum class FclBuild : std::uint8_t { debian, native };
/// A loop over the pairs, or DynamicAABBTreeCollisionManager, its update included. In a search for the minimum distance
/// FCL's own callback hands one DistanceResult from pair to pair, whose bound stops traversals early; `unshared` is the
/// manager without that, as many a program has it.
enum class FclManner : std::uint8_t { loop, manager, unshared };

/// What building takes: filled with triangles beforehand, one BVHModel<OBBRSS<double>> per mesh.
template <FclBuild>
class FclTrees {
 public:
  explicit FclTrees(std::span<const Mesh> meshes);
  FclTrees(FclTrees&&) noexcept;
  ~FclTrees();
  /// Once.
  void build();

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

/// Meshes that stand still: as one BVH of all triangles for the loop, as one BVH each for the manager.
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

/// A mesh per link (empty ones are passed over) and the pairs of links that count. Contacts are not computed: each pair
/// is asked whether there is one.
template <FclBuild build>
class FclRobot {
 public:
  FclRobot(std::span<const Mesh> links, const Pairs& tested);
  FclRobot(FclRobot&&) noexcept;
  ~FclRobot();

  /// World placements of every link, by posture; converted to FCL's here.
  void set_postures(std::span<const std::vector<Placement>> postures);
  /// The posture to ask about next. Objects and manager are brought up to date by the queries.
  void take(std::size_t posture) noexcept;

  bool any(FclManner manner);
  /// Colliding pairs of links i < j, in the order FCL finds them.
  void all(FclManner manner, Pairs& pairs);
  /// Smallest distance of tested pairs, 0 as soon as one collides.
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

/// Shapes of FCL, through libccd. Capsules, boxes and cylinders are centred on their frame; capsules and cylinders lie
/// along z, and a capsule's length is that of its segment.
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

/// Shapes are solid to it.
using FclShape = std::variant<FclSphere, FclCapsule, FclBox, FclCylinder>;
bool collide(const FclShape& a, const Placement& at_a, const FclShape& b, const Placement& at_b);

}  // namespace hinge::oracle
