// SPDX-License-Identifier: BSD-3-Clause
// Environment: bodies around a robot, each with a shape of its own, that come and go, move, or hang on a robot's link.
#pragma once

#include <cstddef>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "hinge/bounds/aabb.hpp"
#include "hinge/core/id.hpp"
#include "hinge/core/pose.hpp"
#include "hinge/robotics/any_hierarchy.hpp"
#include "hinge/robotics/contact.hpp"
#include "hinge/robotics/containment.hpp"
#include "hinge/robotics/robot.hpp"
#include "hinge/robotics/shape.hpp"
#include "hinge/robotics/tessellate.hpp"

namespace hinge::robotics {

/// Metres, world frame. Adding, moving or attaching a body touches no other body and no robot. One per thread; copies
/// share the meshes and what was built from them. A body that does not exist (any more): ModelError, by every function.
class Environment {
 public:
  /// clearance: bodies have to stay that far from robots and from bodies held, finite, >= 0. engine: that of the robots
  /// that will ask, "simd", "lazy" or "brute". Else ModelError.
  explicit Environment(double clearance = 0.0, std::string engine = "simd");

  /// The shape is in the body's own frame. Boxes, spheres, cylinders, capsules and solid meshes are solid, as those of
  /// links are. ModelError, naming the body: what tessellate() refuses, a solid mesh that is open, a pose that is not
  /// rigid. The name is for messages and reports, may be empty, and need not be unique.
  BodyId add(const Shape& shape, const Pose& pose = {}, std::string name = {}, const Tessellation& tessellation = {});
  BodyId add(std::shared_ptr<const TriangleMesh> mesh, const Pose& pose = {}, std::string name = {}) {
    return add(Shape(MeshShape{std::move(mesh)}), pose, std::move(name));
  }
  /// These links of the robot may touch the body from now on: the base that stands on it, say. ModelError: a link the
  /// robot does not have.
  void allow(BodyId body, const std::shared_ptr<const Robot>& robot, const std::vector<LinkId>& links);
  void remove(BodyId body);

  /// ConfigurationError, naming the body: not a rigid placement, or the body hangs on a link. The old pose is kept.
  void set_pose(BodyId body, const Pose& pose);
  /// Of a body that hangs on a link: the pose it had in the last query.
  const Pose& pose(BodyId body) const { return at(body).pose; }

  /// From the next query of this robot on the body is at link pose * in_link. It may touch the links named; those of
  /// the link's rigid group when none are given. Two robots need a Robot each, even if of one kind. ModelError: a link
  /// the robot does not have. ConfigurationError: in_link not rigid. Attaching again replaces what was before.
  void attach(BodyId body, std::shared_ptr<const Robot> robot, LinkId link, const Pose& in_link,
              std::optional<std::vector<LinkId>> may_touch = {});
  /// The body stays where the last query saw it.
  void detach(BodyId body);
  /// The link a body hangs on.
  std::optional<LinkId> attached_to(BodyId body) const;

  double clearance() const noexcept { return clearance_; }
  const std::string& engine() const noexcept { return engine_; }
  std::size_t size() const noexcept;
  /// In the order they were added.
  std::vector<BodyId> bodies() const;
  const std::string& name(BodyId body) const { return at(body).name; }
  std::size_t triangle_count(BodyId body) const { return at(body).shape->model().size(); }
  /// What keeps the body's mesh from being closed (body's frame); none: nothing does.
  std::optional<OpenEdge> open_edge(BodyId body) const;

 private:
  friend class RobotChecker;
  friend class PathChecker;
  struct Attachment {
    std::shared_ptr<const Robot> robot;
    LinkId link{};
    Pose in_link{};
    std::vector<bool> may_touch;  // by link
    GroupId group{};              // of the link
  };
  struct Allowed {
    std::shared_ptr<const Robot> robot;
    std::vector<bool> may_touch;  // by link
  };
  struct Topology {
    std::optional<OpenEdge> open;
    std::vector<std::size_t> parts;
  };
  struct Body {
    std::string name;
    std::shared_ptr<const Robot> shape;  // a root without geometry, and one link that is free against it
    AnyHierarchy hierarchy;
    Pose pose{};
    Aabb local{};  // around the shape, in the body's frame
    Aabb box{};    // around the placed shape
    std::optional<Attachment> attachment{};
    std::vector<Allowed> allowed{};                      // by robot
    mutable std::shared_ptr<const Topology> topology{};  // found when first asked for
  };
  Body& at(BodyId body);
  const Body& at(BodyId body) const;
  /// The link of a body's shape that has the triangles.
  static constexpr LinkId body_link{2};
  /// Does the body hang on this robot?
  static bool held_by(const Body& body, const Robot* robot) noexcept {
    return body.attachment && body.attachment->robot.get() == robot;
  }
  /// By link of the robot: may it touch the body? Empty: none may.
  static std::vector<bool> may_touch(const Body& body, const Robot& robot);
  static void place(Body& body, const Pose& pose);
  static const Topology& topology(const Body& body);

  double clearance_;
  std::string engine_;
  std::vector<std::optional<Body>> bodies_;  // by BodyId
};

}  // namespace hinge::robotics
