// SPDX-License-Identifier: BSD-3-Clause
// Outline, urdfdom, meshes, checks; each fault with the line of its element.
#include "hinge/robotics/read_urdf.hpp"

#include <algorithm>
#include <cstddef>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <utility>

#include <urdf_model/joint.h>
#include <urdf_model/link.h>
#include <urdf_model/model.h>

#include "check_description.hpp"
#include "find_mesh.hpp"
#include "hinge/core/error.hpp"
#include "hinge/robotics/read_mesh.hpp"
#include "outline_urdf.hpp"
#include "parse_with_urdfdom.hpp"

namespace hinge::robotics {

namespace {

namespace fs = std::filesystem;

Vec3 vec3(const urdf::Vector3& v) { return {v.x, v.y, v.z}; }

class UrdfReader {
 public:
  UrdfReader(const fs::path& path, const UrdfOptions& options)
      : path_(path), options_(options), outline_(outline_urdf(path)) {}

  RobotDescription read() {
    refuse_if(tree_problem(skeleton()));
    const Parsed parsed = parse_with_urdfdom(outline_.geometry_only);
    if (!parsed.complaint.empty()) refuse(line_of_named(parsed.complaint), parsed.complaint);
    RobotDescription robot;
    robot.name = parsed.model->getName();
    for (const OutlinedLink& link : outline_.links)
      robot.links.push_back(read_link(link, *parsed.model->getLink(link.name)));
    for (const OutlinedJoint& joint : outline_.joints)
      robot.joints.push_back(read_joint(joint, *parsed.model->getJoint(joint.name)));
    refuse_if(first_problem(robot));
    return robot;
  }

 private:
  [[noreturn]] void refuse(int line, const std::string& what) const {
    throw LoadError(path_.string() + (line > 0 ? ":" + std::to_string(line) : "") + ": " + what);
  }

  void refuse_if(const std::optional<Problem>& problem) const {
    if (problem) refuse(problem->line, problem->what);
  }

  /// Names and tree alone, checked before urdfdom sees them: it knows no lines and takes some circles for trees.
  RobotDescription skeleton() const {
    RobotDescription robot;
    for (const OutlinedLink& link : outline_.links) robot.links.push_back({link.name, {}, link.line});
    for (const OutlinedJoint& joint : outline_.joints) {
      JointDescription& added = robot.joints.emplace_back();
      added.name = joint.name;
      added.parent = joint.parent;
      added.child = joint.child;
      added.line = joint.line;
    }
    return robot;
  }

  /// The line of the last element that the text names in brackets or quotes; 0: it names none.
  int line_of_named(const std::string& text) const {
    const auto named = [&](const std::string& name) {
      return text.find("[" + name + "]") != std::string::npos || text.find("'" + name + "'") != std::string::npos;
    };
    int line = 0;
    for (const OutlinedLink& link : outline_.links)
      if (named(link.name)) line = link.line;
    for (const OutlinedJoint& joint : outline_.joints)
      if (named(joint.name)) line = joint.line;
    return line;
  }

  LinkDescription read_link(const OutlinedLink& outlined, const urdf::Link& link) {
    LinkDescription description{outlined.name, {}, outlined.line};
    if (link.collision_array.size() != outlined.collisions.size())
      refuse(outlined.line, "link '" + outlined.name + "': " + std::to_string(outlined.collisions.size()) +
                                " <collision>, urdfdom understands " + std::to_string(link.collision_array.size()));
    for (std::size_t k = 0; k < outlined.collisions.size(); ++k) {
      const OutlinedCollision& collision = outlined.collisions[k];
      const std::string who = "link '" + outlined.name + "': ";
      if (!link.collision_array[k]->geometry) refuse(collision.line, who + "a <collision> without geometry");
      description.geometry.push_back(
          {collision.capsule ? *collision.capsule : read_shape(*link.collision_array[k]->geometry, collision.line, who),
           collision.origin});
      const std::string problem = problem_of(description.geometry.back().shape);
      if (!problem.empty()) refuse(collision.line, who + problem);
    }
    return description;
  }

  Shape read_shape(const urdf::Geometry& geometry, int line, const std::string& who) {
    switch (geometry.type) {
      case urdf::Geometry::BOX: return BoxShape{vec3(static_cast<const urdf::Box&>(geometry).dim)};
      case urdf::Geometry::SPHERE: return SphereShape{static_cast<const urdf::Sphere&>(geometry).radius};
      case urdf::Geometry::CYLINDER: {
        const auto& cylinder = static_cast<const urdf::Cylinder&>(geometry);
        return CylinderShape{cylinder.radius, cylinder.length};
      }
      case urdf::Geometry::MESH: break;
    }
    const auto& mesh = static_cast<const urdf::Mesh&>(geometry);
    try {
      const fs::path file = find_mesh(mesh.filename, path_.parent_path(), options_);
      std::shared_ptr<const TriangleMesh>& known = meshes_[file.lexically_normal()];
      if (!known) known = std::make_shared<const TriangleMesh>(read_mesh(file));
      return MeshShape{known, vec3(mesh.scale), file};
    } catch (const LoadError& error) {
      refuse(line, who + error.what());
    }
  }

  JointDescription read_joint(const OutlinedJoint& outlined, const urdf::Joint& joint) const {
    JointDescription description;
    description.name = outlined.name;
    description.line = outlined.line;
    description.parent = outlined.parent;
    description.child = outlined.child;
    description.origin = outlined.origin;
    description.axis = vec3(joint.axis);
    switch (joint.type) {
      case urdf::Joint::FIXED: description.type = JointType::fixed; break;
      case urdf::Joint::REVOLUTE: description.type = JointType::revolute; break;
      case urdf::Joint::CONTINUOUS: description.type = JointType::continuous; break;
      case urdf::Joint::PRISMATIC: description.type = JointType::prismatic; break;
      default:
        refuse(outlined.line, "joint '" + outlined.name + "' is " +
                                  (joint.type == urdf::Joint::FLOATING ? "floating" : "planar or of unknown type") +
                                  ", expected fixed, revolute, continuous or prismatic");
    }
    if (joint.limits) {
      description.lower = joint.limits->lower;
      description.upper = joint.limits->upper;
    }
    if (joint.mimic) description.mimic = Mimic{joint.mimic->joint_name, joint.mimic->multiplier, joint.mimic->offset};
    return description;
  }

  fs::path path_;
  const UrdfOptions& options_;
  UrdfOutline outline_;
  std::map<fs::path, std::shared_ptr<const TriangleMesh>> meshes_;
};

}  // namespace

RobotDescription read_urdf(const fs::path& path, const UrdfOptions& options) {
  return UrdfReader(path, options).read();
}

}  // namespace hinge::robotics
