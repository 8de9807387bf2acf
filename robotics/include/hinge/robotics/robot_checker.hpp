// SPDX-License-Identifier: BSD-3-Clause
// RobotChecker: a robot, the pairs of links to test and their margins put together, the engine chosen at run time.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "hinge/bounds/aabb.hpp"
#include "hinge/core/id.hpp"
#include "hinge/core/pose.hpp"
#include "hinge/detail/kinematics/pose_source.hpp"
#include "hinge/policy/collector.hpp"
#include "hinge/primitive/triangle.hpp"
#include "hinge/query/link_pair_hits.hpp"
#include "hinge/robotics/any_hierarchy.hpp"
#include "hinge/robotics/contact.hpp"
#include "hinge/robotics/containment.hpp"
#include "hinge/robotics/link_margins.hpp"
#include "hinge/robotics/link_pairs.hpp"
#include "hinge/robotics/robot.hpp"
#include "hinge/robotics/tested_pairs.hpp"
#include "hinge_tools/mode.hpp"

namespace hinge::robotics {

class Environment;
class SolidPairs;
struct Inside;

using hinge::Mode;

struct CheckOptions {
  std::string engine = "simd";  ///< "simd", "lazy" (the paper's) or "brute"
};

/// The answer for one configuration. `pairs` holds the pairs of links that the mode lists, sorted (all: colliding;
/// within: closer than the margin; any: none, it stops at the first), `closest` only in mode closest.
struct Verdict {
  bool collides = false;
  std::vector<LinkContact> pairs;
  std::vector<ClosestLinks> distances;  ///< within: the closest points of each of the pairs, in the same order
  std::optional<ClosestLinks> closest;
};

/// `inner`, or parts of it, inside the closed mesh of `outer`.
struct LinkContainment {
  LinkId outer{};
  LinkId inner{};
  bool whole = true;  ///< all parts of inner
};

/// A link and a body, one inside the closed mesh of the other; with `held` a body that hangs on `link` instead of it.
struct BodyContainment {
  LinkId link{};
  std::optional<BodyId> held{};
  BodyId body{};
  bool body_is_outer = true;
  bool whole = true;  ///< all parts of the inner one
};

/// A link whose mesh is open: nothing can be said to be inside it.
struct OpenLink {
  LinkId link{};
  OpenEdge edge;  ///< in the link's frame, m; triangles counted from the link's first
};

/// Robot queries at one configuration. Meshes are surfaces; boxes, spheres, cylinders, capsules and solid meshes (see
/// MeshShape) are solid: a link that lies wholly inside one collides, at distance 0. One per thread; copies share
/// everything constant. Links are the original ones, those on fixed joints included. Lengths in m, angles in rad.
/// Starts with every independent joint at 0.
class RobotChecker {
 public:
  /// ModelError: no robot, unknown engine, pairs or margins made for another robot.
  RobotChecker(std::shared_ptr<const Robot> robot, LinkPairs tested, LinkMargins margins,
               const CheckOptions& options = {});

  const Robot& robot() const noexcept { return *robot_; }
  const std::shared_ptr<const Robot>& shared_robot() const noexcept { return robot_; }
  const LinkPairs& tested() const noexcept { return filter_.tested(); }
  const LinkMargins& margins() const noexcept { return margins_; }
  const std::string& engine() const noexcept { return engine_; }

  // --- state; ConfigurationError names the joint (or base) at fault, and the previous state is kept ---

  /// One value per independent joint; limits are not looked at.
  void update(std::span<const double> independent);
  /// World pose of the root link, the identity at first. The first call rebuilds the engine, once, with the root link
  /// free in the world; from then on update() places every link anew, so that small steps cost what large ones do.
  void set_base(const Pose& base);
  const Pose& base() const noexcept { return base_; }
  /// World pose of a link's frame. ModelError: a link the robot does not have.
  Pose link_pose(LinkId link);

  // --- queries at the current state ---

  /// Learns from the current state which pairs of links yes/no queries try first (Hierarchy::calibrate_pair_order): to
  /// be called at some hundred states like those to come. Answers stay the same.
  void calibrate_pair_order();
  bool collides();
  /// Pairs of links that collide, sorted.
  std::vector<LinkContact> colliding_links() { return within(0.0); }
  /// Pairs of links with d - M < margin, sorted. ConfigurationError: margin not finite or below 0.
  std::vector<LinkContact> within(double margin);
  /// Every pair of triangles that collides, sorted. What lies inside a solid has none.
  std::vector<Hit> triangle_pairs();
  /// The same pairs of links, each with its smallest d - M and its closest points, which are points of the world. Far
  /// from the world's origin (behind a long slide, say) distances are computed in the frame of one of the two links, so
  /// that they keep their digits; the points have those of the world's coordinates.
  std::vector<ClosestLinks> distances(double margin);
  /// The pair with the smallest d - M, computed alike; none when no pair is tested.
  std::optional<ClosestLinks> closest();

  /// update() and the queries of a mode.
  Verdict check(std::span<const double> independent, const Mode& mode);

  // --- against an environment. Bodies attached to this robot follow it, and are tested against its links and the other
  // bodies. The clearance is the larger of the environment's and margins().clearance(). ModelError: another engine ---

  /// The same for collides(environment): which links are tried first, whatever the body.
  void calibrate_pair_order(Environment& environment);
  bool collides(Environment& environment);
  /// Pairs of link and body (first links, then held bodies; each sorted).
  std::vector<BodyContact> collisions(Environment& environment) { return within(environment, 0.0); }
  std::vector<BodyContact> within(Environment& environment, double margin);
  std::vector<ClosestBody> distances(Environment& environment, double margin);
  std::optional<ClosestBody> closest(Environment& environment);

  // --- against another robot, each at its base; link1 of this one, link2 of the other. The clearance is the larger of
  // the two margins().clearance(). ModelError: another engine ---

  bool collides(RobotChecker& other);
  std::vector<LinkContact> collisions(RobotChecker& other) { return within(other, 0.0); }
  std::vector<LinkContact> within(RobotChecker& other, double margin);
  std::optional<ClosestLinks> closest(RobotChecker& other);

  // --- what lies wholly inside a closed mesh that is not solid touches nothing, and no query above reports it ---

  /// Among tested pairs whose surfaces are not too close: links inside others, solid or not, sorted by (outer, inner).
  /// Open meshes are never an outer one: see not_closed(). Costs time proportional to the number of triangles.
  std::vector<LinkContainment> contained();
  /// The same between links (and held bodies) and bodies. Open bodies: Environment::open_edge().
  std::vector<BodyContainment> contained(Environment& environment);
  /// Links with geometry whose meshes are not closed, sorted.
  std::span<const OpenLink> not_closed();

 private:
  friend class Environment;
  struct Topology {  // of the meshes, by link, found when first asked for
    std::vector<OpenLink> open;
    std::vector<std::size_t> first;  // triangle in Robot::model()
    std::vector<std::uint8_t> is_closed;
    std::vector<std::vector<std::size_t>> parts;
  };
  void place(AnyHierarchy& hierarchy, const Pose& base, detail::PoseSource& kinematics);
  void find_solid_pairs();
  std::optional<ClosestLinks> closest_surfaces(AnyHierarchy& hierarchy);
  // Coordinates of what was found are so large that its distance has lost digits.
  bool is_far(const ClosestLinks& found) const;
  // Places nearby_ in the frame of the link's rigid group, and says where that is in the world.
  Pose place_nearby(LinkId anchor_link);
  // There: the pairs whose first link this is, as of distances(), a hair beyond the margin too.
  std::vector<ClosestLinks> surfaces_nearby(LinkId link, double margin);
  // Puts what was found there in place of `found`, points in the world, unless verdicts differ.
  static void take_nearby(ClosestLinks& found, const ClosestLinks& closer, const Pose& frame);
  // What lies inside solids; `found` is told until it says true.
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
  std::vector<double> next_;  // scratch: the same to come
  std::vector<Pose> poses_;   // scratch
  Pose base_{};
  std::optional<detail::PoseSource> kinematics_;          // when the base is free: poses relative to the base
  LinkPairHits link_hits_;                                // scratch
  std::shared_ptr<const SolidPairs> solid_pairs_;         // for hierarchy_
  std::vector<std::array<double, 3>> solid_centres_;      // scratch
  std::optional<AnyHierarchy> nearby_;                    // free in the world, placed in the frame of one of its groups
  std::shared_ptr<const std::vector<Aabb>> local_boxes_;  // by link, in its frame, radii included; empty: no geometry
  std::vector<Aabb> link_boxes_;                          // by link, in the world
  bool link_boxes_stand_ = false;                         // link_boxes_ are those of the present state
  std::shared_ptr<const Topology> topology_;
};

}  // namespace hinge::robotics
