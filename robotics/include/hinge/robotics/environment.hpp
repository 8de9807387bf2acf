// SPDX-License-Identifier: BSD-3-Clause
// Environment: bodies around a robot, which can be added, removed, moved, or attached to a link of a robot.
#pragma once

#include <cstddef>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "hinge/bounds/aabb.hpp"
#include "hinge/core/api.hpp"
#include "hinge/core/id.hpp"
#include "hinge/core/pose.hpp"
#include "hinge/robotics/any_hierarchy.hpp"
#include "hinge/robotics/contact.hpp"
#include "hinge/robotics/containment.hpp"
#include "hinge/robotics/robot.hpp"
#include "hinge/robotics/shape.hpp"
#include "hinge/robotics/tessellate.hpp"

namespace hinge::robotics {

/// Bodies around robots, each with its own shape. Lengths in m, poses in the world frame. Adding, moving or attaching a
/// body changes no other body and no robot. One per thread; copies share the meshes and the data built from them. Every
/// function with a BodyId throws ModelError if the body does not exist or was removed.
class HINGE_API Environment {
 public:
  /// clearance: distance (m) that bodies must keep from robots and from held bodies; finite, >= 0. engine: "simd",
  /// "lazy" or "brute", equal to the engine of every robot that queries this environment. Throws ModelError otherwise.
  explicit Environment(double clearance = 0.0, std::string engine = "simd");

  /// Adds a body and returns its id. The shape is given in the body's frame, `pose` places this frame in the world.
  /// Boxes, spheres, cylinders, capsules and solid meshes are solid, as in a robot. The name appears in messages and
  /// reports; it may be empty and need not be unique. Throws ModelError, naming the body, if tessellate() rejects the
  /// shape, a solid mesh is open, or the pose is not rigid.
  BodyId add(const Shape& shape, const Pose& pose = {}, std::string name = {}, const Tessellation& tessellation = {});
  /// The same for a mesh in the body's frame (m), not solid.
  BodyId add(std::shared_ptr<const TriangleMesh> mesh, const Pose& pose = {}, std::string name = {}) {
    return add(Shape(MeshShape{std::move(mesh)}), pose, std::move(name));
  }
  /// Allows these links of the robot to touch the body, for example a base mounted on it. Adds to earlier calls. Throws
  /// ModelError if the robot is null or does not have a link.
  void allow(BodyId body, const std::shared_ptr<const Robot>& robot, const std::vector<LinkId>& links);
  /// Removes a body. Its id stays invalid.
  void remove(BodyId body);

  /// Moves a body to a pose in the world frame. Throws ConfigurationError, naming the body, if the pose is not rigid or
  /// the body is attached to a link; the old pose is kept then.
  void set_pose(BodyId body, const Pose& pose);
  /// Returns the pose in the world frame. An attached body has the pose of the last query by its robot. The reference
  /// is valid until a body is added or this one is removed.
  const Pose& pose(BodyId body) const { return at(body).pose; }

  /// Attaches a body to a link: in later queries of this robot its pose is link pose * in_link. The body may touch the
  /// links in `may_touch`, by default all links of the link's rigid group. Robots are distinguished by address: two
  /// robots of the same kind need two Robot objects. Attaching again replaces the earlier attachment. Throws ModelError
  /// if the robot is null or does not have a link, ConfigurationError if in_link is not rigid.
  void attach(BodyId body, std::shared_ptr<const Robot> robot, LinkId link, const Pose& in_link,
              std::optional<std::vector<LinkId>> may_touch = {});
  /// Detaches a body. It keeps the pose of the last query.
  void detach(BodyId body);
  /// Returns the link to which the body is attached, or nothing.
  std::optional<LinkId> attached_to(BodyId body) const;

  /// Returns the clearance in m.
  double clearance() const noexcept { return clearance_; }
  /// Returns the name of the engine.
  const std::string& engine() const noexcept { return engine_; }
  /// Returns the number of bodies.
  std::size_t size() const noexcept;
  /// Returns the ids of all bodies, in the order of addition.
  std::vector<BodyId> bodies() const;
  /// Returns the name given to add(). The reference is valid until a body is added or this one is removed.
  const std::string& name(BodyId body) const { return at(body).name; }
  /// Returns the number of triangles of the body's tessellated shape.
  std::size_t triangle_count(BodyId body) const { return at(body).shape->model().size(); }
  /// Returns an open edge of the body's mesh (m, body frame), or nothing if the mesh is closed. Computed at the first
  /// call.
  std::optional<OpenEdge> open_edge(BodyId body) const;

 private:
  friend class RobotChecker;
  friend class PathChecker;
  struct Attachment {
    std::shared_ptr<const Robot> robot;
    LinkId link{};
    Pose in_link{};
    std::vector<bool> may_touch;  // by link of the robot
    GroupId group{};              // rigid group of the link
  };
  struct Allowed {
    std::shared_ptr<const Robot> robot;
    std::vector<bool> may_touch;  // by link of the robot
  };
  struct Topology {
    std::optional<OpenEdge> open;
    std::vector<std::size_t> parts;
  };
  struct Body {
    std::string name;
    std::shared_ptr<const Robot> shape;  // a root without geometry, and one link that moves freely against it
    AnyHierarchy hierarchy;
    Pose pose{};
    Aabb local{};  // bounds of the shape in the body's frame
    Aabb box{};    // bounds of the placed shape in the world
    std::optional<Attachment> attachment{};
    std::vector<Allowed> allowed{};                      // one entry per robot
    mutable std::shared_ptr<const Topology> topology{};  // computed when first needed
  };
  Body& at(BodyId body);
  const Body& at(BodyId body) const;
  /// The link of Body::shape that owns the triangles.
  static constexpr LinkId body_link{2};
  /// Returns true if the body is attached to this robot.
  static bool held_by(const Body& body, const Robot* robot) noexcept {
    return body.attachment && body.attachment->robot.get() == robot;
  }
  /// Returns for each link of the robot whether it may touch the body. Empty: no link may.
  static std::vector<bool> may_touch(const Body& body, const Robot& robot);
  static void place(Body& body, const Pose& pose);
  static const Topology& topology(const Body& body);

  double clearance_;
  std::string engine_;
  std::vector<std::optional<Body>> bodies_;  // by BodyId; empty: removed
};

}  // namespace hinge::robotics
