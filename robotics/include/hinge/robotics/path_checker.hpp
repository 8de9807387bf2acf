// SPDX-License-Identifier: BSD-3-Clause
// PathChecker: straight paths of a robot, among bodies or alone, proved free or looked at, state by state.
#pragma once

#include <memory>
#include <optional>
#include <span>
#include <variant>
#include <vector>

#include "hinge/core/id.hpp"
#include "hinge/engine/simd.hpp"
#include "hinge/path/certified_path.hpp"
#include "hinge/path/path_answer.hpp"
#include "hinge/primitive/triangle.hpp"
#include "hinge/robotics/any_hierarchy.hpp"
#include "hinge/robotics/contact.hpp"
#include "hinge/robotics/link_margins.hpp"
#include "hinge/robotics/robot.hpp"
#include "hinge/robotics/tested_pairs.hpp"

namespace hinge::robotics {

class Environment;
class RobotChecker;
class SolidPairs;

/// Either of two that come too close: a link of the robot or a body.
using LinkOrBody = std::variant<LinkId, BodyId>;

struct PathContact {
  LinkOrBody first, second;
  double distance = 0.0;   ///< of one pair of triangles, radii not taken off, m; 0 where one lies inside the other
  double threshold = 0.0;  ///< radii and clearance, m
};

/// As PathAnswer, in terms of the robot.
struct RobotPathAnswer {
  PathVerdict verdict = PathVerdict::undecided;
  double parameter = 0.0;              ///< colliding: t; undecided: the middle of a stretch that is not
  double half_width = 0.0;             ///< undecided: of that stretch, else 0
  std::vector<double> configuration;   ///< at t, one value per independent joint; empty when the path is free
  std::optional<PathContact> contact;  ///< colliding: two that do; undecided: two of which nothing is proved
  PathCounts counts;

  bool is_free() const noexcept { return verdict == PathVerdict::free; }
};

/// Paths join values of the independent joints, rad or m; followers follow all the way, limits are not looked at. The
/// checker's pairs and margins decide, and with an environment its clearance; bodies stand where they are when this is
/// made, those held follow their link, and the robot stays on its base (a base that is not the identity moves the
/// bodies instead, which rounds). What is solid for RobotChecker is solid here: with no surfaces that meet on the way,
/// what is outside a solid at the start stays outside. Bodies that touch what never moves against them make every path
/// collide. One per thread; copies share everything constant.
class PathChecker {
 public:
  explicit PathChecker(const RobotChecker& checker);
  PathChecker(const RobotChecker& checker, const Environment& environment);

  /// For every state between the two. A stretch, as a share of the path, is not cut any more when it is no longer than
  /// `smallest_step`. ConfigurationError: another number of values, one that is not finite; a step not above 0.
  RobotPathAnswer certify(std::span<const double> from, std::span<const double> to,
                          double smallest_step = smallest_path_step);
  /// At states no joint of which, followers included, is more than `resolution` (rad or m) from that of the next.
  RobotPathAnswer sample(std::span<const double> from, std::span<const double> to, double resolution);

 private:
  struct Scene;
  explicit PathChecker(Scene scene);
  static Scene with_bodies(const RobotChecker& checker, const Environment& environment);
  PathContact contact(const Hit& hit) const;
  template <class Check>
  RobotPathAnswer answer(std::span<const double> from, std::span<const double> to, const Check& check);

  std::shared_ptr<const Robot> robot_;  // with the bodies as further links
  std::vector<LinkOrBody> owners_;      // by link
  std::optional<PathContact> always_;   // a contact that no joint can change
  RobotHierarchy<Simd> hierarchy_;
  std::shared_ptr<const SolidPairs> solid_pairs_;
  CertifiedPath<Triangle, LinkPairFilter, LinkMargins, Simd> certified_;
};

}  // namespace hinge::robotics
