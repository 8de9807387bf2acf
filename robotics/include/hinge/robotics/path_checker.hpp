// SPDX-License-Identifier: BSD-3-Clause
// PathChecker: checks straight paths of a robot, alone or among bodies, by proof or by sampling.
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <variant>
#include <vector>

#include "hinge/core/api.hpp"
#include "hinge/core/id.hpp"
#include "hinge/engine/simd.hpp"
#include "hinge/path/certified_path.hpp"
#include "hinge/path/path_answer.hpp"
#include "hinge/primitive/triangle.hpp"
#include "hinge/robotics/any_hierarchy.hpp"
#include "hinge/robotics/contact.hpp"
#include "hinge/robotics/environment.hpp"
#include "hinge/robotics/link_margins.hpp"
#include "hinge/robotics/robot.hpp"
#include "hinge/robotics/robot_checker.hpp"
#include "hinge/robotics/tested_pairs.hpp"

namespace hinge::robotics {

class SolidPairs;

/// One side of a contact: a link of the robot or a body.
using LinkOrBody = std::variant<LinkId, BodyId>;

/// Two links or bodies that are too close.
struct PathContact {
  LinkOrBody first;   ///< one side; the order has no meaning
  LinkOrBody second;  ///< the other side
  /// Distance (m) of one pair of triangles, radii not subtracted; 0 if one is inside a solid of the other.
  double distance = 0.0;
  double threshold = 0.0;  ///< m, sum of the two radii and the clearance
};

/// The answer for a path: a PathAnswer in terms of the robot.
struct RobotPathAnswer {
  PathVerdict verdict = PathVerdict::undecided;  ///< free, colliding or undecided
  double parameter = 0.0;   ///< colliding: t of the collision; undecided: t in the middle of an undecided segment
  double half_width = 0.0;  ///< undecided: half the length of that segment; otherwise 0
  std::vector<double> configuration;  ///< at `parameter`, one value per independent joint (rad or m); empty if free
  /// Colliding: a pair that collides. Undecided: a pair not proved apart, if known.
  std::optional<PathContact> contact;
  PathCounts counts;  ///< states tested and work done

  /// Returns true if the verdict is free.
  bool is_free() const noexcept { return verdict == PathVerdict::free; }
};

/// Checks straight paths between configurations of the independent joints (rad or m). Mimic joints follow along the
/// whole path; joint limits are not checked. Pairs and margins are those of the RobotChecker; with an environment the
/// larger clearance applies between links and bodies. Bodies keep the poses that they have at construction, held bodies
/// follow their link, and the robot keeps its base. If the base is not the identity, the bodies are moved into its
/// frame, which rounds. Solids are those of RobotChecker: a component outside a solid at the start stays outside while
/// no surfaces touch. If a body collides with a link that never moves against it, every path collides. Both
/// functions call between() before every segment or state; it may throw to end the work. One per thread; copies share
/// constant data.
class HINGE_API PathChecker {
 public:
  /// Checks the robot against itself.
  explicit PathChecker(const RobotChecker& checker);
  /// Checks the robot against itself and against the bodies. Copies what it needs from both arguments. Throws
  /// ModelError if the environment uses another engine than the checker.
  PathChecker(const RobotChecker& checker, const Environment& environment);

  /// Decides for every state between `from` and `to` (independent_joints().size() values each). A segment no longer
  /// than `smallest_step`, a fraction of the path, is not divided further. Throws ConfigurationError if a length is
  /// wrong, a value is not finite, or smallest_step is not above 0.
  RobotPathAnswer certify(std::span<const double> from, std::span<const double> to,
                          double smallest_step = smallest_path_step, const std::function<void()>& between = {});
  /// Tests states along the path. No joint, mimic joints included, changes by more than `resolution` (rad or m) between
  /// neighbouring states. Throws ConfigurationError as certify() does, and if resolution is not finite, not above 0, or
  /// needs more than 2^53 states.
  RobotPathAnswer sample(std::span<const double> from, std::span<const double> to, double resolution,
                         const std::function<void()>& between = {});

  /// Returns true if the configuration is free: RobotChecker's verdict, links and bodies. Throws ConfigurationError if
  /// the length is wrong or a value is not finite.
  bool is_free(std::span<const double> q);

  /// The checker as it was at construction.
  const RobotChecker& checker() const noexcept { return checker_; }
  /// The bodies as they were at construction; null if none were given. Valid as long as this object.
  const Environment* environment() const noexcept { return bodies_ ? &*bodies_ : nullptr; }

 private:
  struct Scene;
  PathChecker(const RobotChecker& checker, std::optional<Environment> bodies, Scene scene);
  static Scene with_bodies(const RobotChecker& checker, const Environment& environment);
  PathContact contact(const Hit& hit) const;
  template <class Check>
  RobotPathAnswer answer(std::span<const double> from, std::span<const double> to, const Check& check);

  RobotChecker checker_;
  std::optional<Environment> bodies_;
  std::shared_ptr<const Robot> robot_;  // the robot, with every body added as a link
  std::vector<LinkOrBody> owners_;      // by link of robot_
  std::optional<PathContact> always_;   // a contact that no joint can change
  RobotHierarchy<Simd> hierarchy_;
  std::shared_ptr<const SolidPairs> solid_pairs_;
  CertifiedPath<Triangle, LinkPairFilter, LinkMargins, Simd> certified_;
};

}  // namespace hinge::robotics
