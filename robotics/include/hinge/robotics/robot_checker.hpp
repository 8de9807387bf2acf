// SPDX-License-Identifier: BSD-3-Clause
// RobotChecker: collision and distance queries of a robot against itself, an environment or another robot.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "hinge/batch/sphere_batch.hpp"
#include "hinge/bounds/aabb.hpp"
#include "hinge/core/api.hpp"
#include "hinge/core/id.hpp"
#include "hinge/core/pose.hpp"
#include "hinge/detail/kinematics/forward_kinematics.hpp"
#include "hinge/policy/collector.hpp"
#include "hinge/primitive/triangle.hpp"
#include "hinge/query/link_pair_hits.hpp"
#include "hinge/query/mode.hpp"
#include "hinge/robotics/any_hierarchy.hpp"
#include "hinge/robotics/clearance.hpp"
#include "hinge/robotics/contact.hpp"
#include "hinge/robotics/containment.hpp"
#include "hinge/robotics/link_margins.hpp"
#include "hinge/robotics/link_pairs.hpp"
#include "hinge/robotics/robot.hpp"
#include "hinge/robotics/tested_pairs.hpp"

namespace hinge::robotics {

class Environment;
class SolidPairs;
struct Inside;

using hinge::Mode;

/// Options of RobotChecker.
struct CheckOptions {
  std::string engine = "simd";  ///< "simd", "lazy" (the paper's engine) or "brute"
};

/// The answer of RobotChecker::check(). `pairs` is sorted. Mode all: pairs of links that collide; mode within: pairs
/// closer than the margin; modes any and closest: empty.
struct Verdict {
  bool collides = false;                ///< true if any tested pair collides
  std::vector<LinkContact> pairs;       ///< pairs that the mode lists
  std::vector<ClosestLinks> distances;  ///< mode within: closest points of the pairs, in the same order
  std::optional<ClosestLinks> closest;  ///< mode closest: the closest pair; otherwise empty
};

/// `inner`, or some of its connected components, lies inside the closed mesh of `outer`.
struct LinkContainment {
  LinkId outer{};     ///< the link that contains the other
  LinkId inner{};     ///< the link inside
  bool whole = true;  ///< true: all connected components of inner
};

/// A link and a body, one inside the closed mesh of the other. If `held` is set, the body attached to `link` replaces
/// it.
struct BodyContainment {
  LinkId link{};                 ///< the link, or the link that holds `held`
  std::optional<BodyId> held{};  ///< the attached body; empty: the link itself
  BodyId body{};                 ///< the other side
  bool body_is_outer = true;     ///< true: the body contains the link (or held body)
  bool whole = true;             ///< true: all connected components of the inner one
};

/// A link whose mesh is open. Containment in it is undefined.
struct OpenLink {
  LinkId link{};  ///< the link
  OpenEdge edge;  ///< in the link's frame, m; triangle index from the link's first triangle
};

/// Queries of a robot at one configuration. Meshes are surfaces. Boxes, spheres, cylinders, capsules and solid meshes
/// (see MeshShape) are solid: a link wholly inside one collides, at distance 0. Links are those of the description,
/// links on fixed joints included. Lengths in m, angles in rad, poses and points in the world frame. Initially every
/// independent joint is 0 and the base is the identity. One per thread; copies share constant data.
class HINGE_API RobotChecker {
 public:
  /// Throws ModelError if the robot is null, the engine is unknown, or pairs or margins were made for another robot.
  RobotChecker(std::shared_ptr<const Robot> robot, LinkPairs tested, LinkMargins margins,
               const CheckOptions& options = {});

  /// Returns the robot.
  const Robot& robot() const noexcept { return *robot_; }
  /// Returns the robot as the shared pointer that Environment::attach() and allow() take.
  const std::shared_ptr<const Robot>& shared_robot() const noexcept { return robot_; }
  /// Returns the pairs of links that are tested.
  const LinkPairs& tested() const noexcept { return filter_.tested(); }
  /// Returns radii and clearances.
  const LinkMargins& margins() const noexcept { return margins_; }
  /// Returns the name of the engine.
  const std::string& engine() const noexcept { return engine_; }

  // --- State. Errors are ConfigurationError and name the joint or the base; the previous state is kept then. ---

  /// Sets the configuration: one value per independent joint, rad or m. Limits are not checked. Throws if the length is
  /// wrong, a value is not finite, or a joint value exceeds 1e300.
  void update(std::span<const double> independent);
  /// Sets the world pose of the root link. The first call rebuilds the engine with a root link that is free in the
  /// world. From then on update() computes all link poses, so small steps cost as much as large ones. Throws if the
  /// pose is not rigid.
  void set_base(const Pose& base);
  /// Returns the world pose of the root link.
  const Pose& base() const noexcept { return base_; }
  /// Returns the world pose of a link's frame. Throws ModelError if the robot does not have the link.
  Pose link_pose(LinkId link);

  // --- Queries at the current state ---

  /// Learns from the current state which pairs of links the yes/no queries test first (see
  /// Hierarchy::calibrate_pair_order). collides() calls it at some states. Call it at typical states if the first
  /// queries are at others. Answers do not change.
  void calibrate_pair_order();
  /// Returns true if any tested pair of links collides. Stops at the first hit. Every sixteenth of the first 256 calls
  /// also calibrates the order of pairs.
  bool collides();
  /// Returns the pairs of links that collide, sorted.
  std::vector<LinkContact> colliding_links() { return within(0.0); }
  /// Returns the pairs of links with d - M < margin (m), sorted. Throws ConfigurationError if margin is negative or not
  /// finite.
  std::vector<LinkContact> within(double margin);
  /// Returns every pair of triangles that collides, sorted. A link inside a solid without touching its surface has
  /// none.
  std::vector<Hit> triangle_pairs();
  /// Returns the pairs of links of within(margin), each with its smallest d - M and its closest points (world frame).
  /// Far from the world origin, for example behind a long slide, distances are computed in the frame of one of the two
  /// links, to keep their accuracy. The points keep the accuracy of world coordinates.
  std::vector<ClosestLinks> distances(double margin);
  /// Returns the pair with the smallest d - M, computed like distances(), or nothing if no pair is tested.
  std::optional<ClosestLinks> closest();

  /// Returns the pairs of distances(influence) as clearances with normals, and with depths where there are any. Throws
  /// as distances().
  std::vector<LinkClearance> clearances(double influence);
  /// Returns the derivatives of the distances by the independent joints at the current state: row k is
  /// normal . (J2(point2) - J1(point1)) of rows[k], with mimic joints added to the joint that they follow. Where
  /// several pairs of points are equally close, the distance has a kink and this is the derivative of one side. Rows
  /// without a direction are 0. rows: from clearances() at this state. Throws ModelError if the robot does not have a
  /// link.
  ClearanceJacobian jacobian(std::span<const LinkClearance> rows);

  /// Calls update() and the queries of `mode`.
  Verdict check(std::span<const double> independent, const Mode& mode);
  /// Returns one verdict per configuration: 1 if it collides, otherwise 0, as collides() after update().
  /// configurations: one after the other, one value per independent joint; the last one becomes the state. A robot made
  /// of spheres, without clearance and with a fixed base, is tested sixteen configurations at a time by the SIMD engine
  /// (see SphereBatch). Throws ConfigurationError if the number of values is wrong, or as update(), naming the
  /// configuration.
  std::vector<std::uint8_t> check_batch(std::span<const double> configurations);

  // --- Against an environment. Bodies attached to this robot follow it and are tested against its links and the other
  // bodies. Between links and bodies the clearance is the larger of the environment's and margins().clearance();
  // between bodies it is the environment's. All functions throw ModelError if the environment uses another engine. ---

  /// The same as calibrate_pair_order() for collides(environment): the order of links, for all bodies.
  void calibrate_pair_order(Environment& environment);
  /// Returns true if any link or held body collides with a body.
  bool collides(Environment& environment);
  /// Returns the colliding pairs of link and body, then of held body and body, each sorted.
  std::vector<BodyContact> collisions(Environment& environment) { return within(environment, 0.0); }
  /// Returns the pairs with d - M < margin (m), in the order of collisions(). Throws ConfigurationError as
  /// within(margin).
  std::vector<BodyContact> within(Environment& environment, double margin);
  /// Returns the pairs of within(environment, margin) with their smallest d - M and closest points (world frame).
  std::vector<ClosestBody> distances(Environment& environment, double margin);
  /// Returns the pairs of distances(environment, influence) as clearances; see clearances(influence).
  std::vector<BodyClearance> clearances(Environment& environment, double influence);
  /// Returns the derivatives of these distances by the independent joints; see the function for links above.
  ClearanceJacobian jacobian(std::span<const BodyClearance> rows);
  /// Returns the pair with the smallest d - M, or nothing if no pair is tested.
  std::optional<ClosestBody> closest(Environment& environment);

  // --- Against another robot, each at its base. link1 belongs to this robot, link2 to the other. All pairs of links
  // are tested. The clearance is the larger of the two margins().clearance(). Throws ModelError if the other uses
  // another engine or is this checker itself. ---

  /// Returns true if any two links of the robots collide.
  bool collides(RobotChecker& other);
  /// Returns the pairs of links that collide, sorted.
  std::vector<LinkContact> collisions(RobotChecker& other) { return within(other, 0.0); }
  /// Returns the pairs of links with d - M < margin (m), sorted. Throws ConfigurationError as within(margin).
  std::vector<LinkContact> within(RobotChecker& other, double margin);
  /// Returns the pair with the smallest d - M, or nothing if a robot has no geometry.
  std::optional<ClosestLinks> closest(RobotChecker& other);

  // --- Containment in closed meshes that are not solid; no query above reports it ---

  /// Returns the tested pairs of links whose surfaces do not collide while one is inside the other, solid or not,
  /// sorted by (outer, inner). Open meshes never count as outer, see not_closed(). O(number of triangles).
  std::vector<LinkContainment> contained();
  /// The same between links (or held bodies) and bodies. For open meshes of bodies see Environment::open_edge().
  std::vector<BodyContainment> contained(Environment& environment);
  /// Returns the links whose meshes are not closed, sorted. The span is valid as long as this checker or a copy of it.
  std::span<const OpenLink> not_closed();

 private:
  friend class Environment;
  struct Topology {  // of the meshes, by link; computed when first needed
    std::vector<OpenLink> open;
    std::vector<std::size_t> first;  // index of the link's first triangle in Robot::model()
    std::vector<std::uint8_t> is_closed;
    std::vector<std::vector<std::size_t>> parts;
  };
  void place(AnyHierarchy& hierarchy, const Pose& base, detail::ForwardKinematics& kinematics);
  void find_solid_pairs();
  // Expands the values of the independent joints into `full`. Throws as update().
  void expand(std::span<const double> independent, std::span<double> full) const;
  // True if spheres_ can answer while the base is fixed.
  bool fits_sphere_batch() const;
  std::optional<ClosestLinks> closest_surfaces(AnyHierarchy& hierarchy);
  // True if the coordinates of the result are so large that its distance has lost digits.
  bool is_far(const ClosestLinks& found) const;
  // Places nearby_ in the frame of the link's rigid group and returns the world pose of this frame.
  Pose place_nearby(LinkId anchor_link);
  // Queries nearby_: the pairs of distances() whose first link is `link`. The margin is slightly enlarged.
  std::vector<ClosestLinks> surfaces_nearby(LinkId link, double margin);
  // Replaces `found` by the result from nearby_, points moved to the world, unless the verdicts differ.
  static void take_nearby(ClosestLinks& found, const ClosestLinks& closer, const Pose& frame);
  // Calls found(...) for each component inside a solid, until it returns true. Returns true in that case.
  template <class Found>
  bool find_insides(const Found& found);
  template <class Found>
  bool find_insides(RobotChecker& other, const Found& found);
  bool any_inside();
  std::vector<LinkContact> surfaces_within(double margin);
  std::span<const Aabb> link_boxes();
  struct BodyPair;
  std::vector<BodyPair> body_pairs(Environment& environment, double margin);
  template <class Found>
  bool find_insides(const BodyPair& pair, const Environment& environment, const Found& found);
  std::vector<BodyContact> surfaces_within(const Environment& environment, const std::vector<BodyPair>& pairs,
                                           double margin);
  template <class Ask>
  auto ask(const BodyPair& pair, const Environment& environment, const Ask& f, double extra = 0.0);
  const Topology& topology();
  std::span<const Triangle> placed(LinkId link);

  std::shared_ptr<const Robot> robot_;
  LinkPairFilter filter_;
  LinkMargins margins_;
  std::string engine_;
  std::optional<AnyHierarchy> hierarchy_;
  std::vector<double> full_;  // one value per DOF of the robot's model
  std::vector<double> next_;  // scratch: the next full_
  std::vector<Pose> poses_;   // scratch
  Pose base_{};
  std::optional<detail::ForwardKinematics> kinematics_;   // set if the base is free: poses relative to the base
  LinkPairHits link_hits_;                                // scratch
  std::shared_ptr<const SolidPairs> solid_pairs_;         // for the groups of hierarchy_
  std::vector<std::array<double, 3>> solid_centres_;      // scratch
  std::optional<AnyHierarchy> nearby_;                    // free in the world; placed in the frame of one of its groups
  std::shared_ptr<const std::vector<Aabb>> local_boxes_;  // by link, link frame, radii included; empty box: no geometry
  std::vector<Aabb> link_boxes_;                          // by link, world frame
  bool link_boxes_stand_ = false;                         // link_boxes_ belong to the current state
  std::shared_ptr<const Topology> topology_;
  std::size_t queries_ = 0;  // number of calls of collides(), up to the number that is needed for the order of pairs
  bool fits_sphere_batch_ = false;
  std::optional<SphereBatch> spheres_;  // made by the first check_batch() that can use it
};

}  // namespace hinge::robotics
