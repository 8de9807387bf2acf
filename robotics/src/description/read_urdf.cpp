// SPDX-License-Identifier: BSD-3-Clause
// Combines outline, urdfdom, meshes and checks; every error names the line of its element.
#include "hinge/robotics/read_urdf.hpp"

#include <algorithm>
#include <cstddef>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <urdf_model/joint.h>
#include <urdf_model/link.h>
#include <urdf_model/model.h>

#include "description/check_description.hpp"
#include "description/find_mesh.hpp"
#include "description/missing_mesh.hpp"
#include "description/outline_urdf.hpp"
#include "description/parse_numbers.hpp"
#include "description/parse_with_urdfdom.hpp"
#include "description/read_file.hpp"
#include "hinge/core/error.hpp"
#include "hinge/robotics/read_mesh.hpp"

namespace hinge::robotics {

namespace {

namespace fs = std::filesystem;

Vec3 vec3(const urdf::Vector3& v) { return {v.x, v.y, v.z}; }

class UrdfReader {
 public:
  UrdfReader(const fs::path& path, const std::string& text, const UrdfOptions& options)
      : path_(path), options_(options), outline_(outline_urdf(path, text)) {}

  RobotDescription read() {
    refuse_if(tree_problem(skeleton()));
    const Parsed parsed = parse_with_urdfdom(outline_.geometry_only);
    if (!parsed.complaint.empty()) refuse(line_of_named(parsed.complaint), parsed.complaint);
    RobotDescription robot;
    robot.name = parsed.model->getName();
    notes_ = outline_.notes;
    for (const OutlinedLink& link : outline_.links)
      robot.links.push_back(read_link(link, *parsed.model->getLink(link.name)));
    for (const OutlinedJoint& joint : outline_.joints)
      robot.joints.push_back(read_joint(joint, *parsed.model->getJoint(joint.name)));
    refuse_if(first_problem(robot));
    robot.notes = std::move(notes_);
    robot.incomplete = std::move(incomplete_);
    robot.floating_base = std::move(floating_base_);
    return robot;
  }

 private:
  [[noreturn]] void refuse(int line, const std::string& what) const { throw LoadError(at(line) + what); }

  std::string at(int line) const { return path_.string() + (line > 0 ? ":" + std::to_string(line) : "") + ": "; }

  void refuse_if(const std::optional<Problem>& problem) const {
    if (problem) refuse(problem->line, problem->what);
  }

  /// Returns names and tree only. They are checked before urdfdom runs, because it reports no lines and accepts some
  /// cycles.
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

  /// Returns the line of the last element that the text names in brackets or quotes, or 0.
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
                                " <collision>, but urdfdom reads " + std::to_string(link.collision_array.size()));
    const std::string who = "link '" + outlined.name + "': ";
    Counted missing, flat;
    for (std::size_t k = 0; k < outlined.collisions.size(); ++k) {
      const OutlinedCollision& collision = outlined.collisions[k];
      if (!link.collision_array[k]->geometry) refuse(collision.line, who + "a <collision> has no geometry");
      try {
        description.geometry.push_back(
            {collision.capsule ? *collision.capsule : read_shape(*link.collision_array[k]->geometry, collision),
             collision.origin});
      } catch (const MissingMesh& error) {
        if (!options_.skip_missing_meshes)
          refuse(collision.line, who + error.what() + "; --missing-meshes skip leaves it out");
        missing.add(collision.line, error.what());
        continue;
      } catch (const LoadError& error) {
        refuse(collision.line, who + error.what());
      }
      const Shape& shape = description.geometry.back().shape;
      const std::string problem = problem_of(shape);
      if (!problem.empty()) refuse(collision.line, who + problem);
      flat.add(collision.line, without_volume(shape));
    }
    const std::string of_all = " of " + std::to_string(outlined.collisions.size()) + " <collision> ";
    if (missing.count > 0) {
      incomplete_.push_back(outlined.name);
      notes_.push_back(at(missing.line) + who + std::to_string(missing.count) + of_all + "left out: " + missing.first);
    }
    if (flat.count > 0)
      notes_.push_back(at(flat.line) + who + std::to_string(flat.count) + of_all +
                       "have no volume and are treated as point, segment or flat solid: " + flat.first);
    return description;
  }

  /// Counts faults of one kind and keeps the first.
  struct Counted {
    std::size_t count = 0;
    int line = 0;
    std::string first;

    void add(int at_line, const std::string& what) {
      if (what.empty()) return;
      if (count++ > 0) return;
      line = at_line;
      first = what;
    }
  };

  Shape read_shape(const urdf::Geometry& geometry, const OutlinedCollision& collision) {
    if (!collision.unread.empty())
      throw MissingMesh("shape " + collision.unread + ", expected <box>, <sphere>, <cylinder>, <capsule> or <mesh>");
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
    const fs::path file = find_mesh(mesh.filename, path_.parent_path(), options_);
    std::shared_ptr<const TriangleMesh>& known = meshes_[file.lexically_normal()];
    if (!known) known = std::make_shared<const TriangleMesh>(read_mesh(file, &notes_));
    return MeshShape{known, vec3(mesh.scale), file};
  }

  /// Returns true if every link with geometry is below the joint. Its value then changes no verdict between links.
  bool carries_all_geometry(const OutlinedJoint& joint) const {
    std::multimap<std::string_view, std::string_view> below;
    for (const OutlinedJoint& other : outline_.joints) below.emplace(other.parent, other.child);
    std::set<std::string_view> carried{joint.child};
    std::vector<std::string_view> open{joint.child};
    while (!open.empty()) {
      const auto [first, last] = below.equal_range(open.back());
      open.pop_back();
      for (auto next = first; next != last; ++next)
        if (carried.insert(next->second).second) open.push_back(next->second);
    }
    return std::all_of(outline_.links.begin(), outline_.links.end(), [&](const OutlinedLink& link) {
      return link.collisions.empty() || carried.contains(link.name);
    });
  }

  void fix(const OutlinedJoint& joint, const std::string& type) {
    if (!carries_all_geometry(joint))
      refuse(joint.line, "joint '" + joint.name + "' is " + type +
                             ", expected fixed, revolute, continuous or prismatic (or a joint above all geometry)");
    if (floating_base_.empty()) floating_base_ = joint.name;
    notes_.push_back(at(joint.line) + "joint '" + joint.name + "' is " + type +
                     " and carries all geometry, so it is treated as fixed");
  }

  JointDescription read_joint(const OutlinedJoint& outlined, const urdf::Joint& joint) {
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
      case urdf::Joint::FLOATING: fix(outlined, "floating"); break;
      case urdf::Joint::PLANAR: fix(outlined, "planar"); break;
      default:
        refuse(outlined.line,
               "joint '" + outlined.name + "' has an unknown type, expected fixed, revolute, continuous or prismatic");
    }
    if (joint.limits) {
      description.lower = joint.limits->lower;
      description.upper = joint.limits->upper;
    }
    // Some programs write the largest double for a joint without limits.
    if (description.type == JointType::revolute && description.lower <= -largest_joint_value &&
        description.upper >= largest_joint_value) {
      description.type = JointType::continuous;
      notes_.push_back(at(outlined.line) + "joint '" + outlined.name +
                       "' has limits of 1e15 rad or more, so it is treated as continuous");
    }
    if (joint.mimic) description.mimic = Mimic{joint.mimic->joint_name, joint.mimic->multiplier, joint.mimic->offset};
    return description;
  }

  fs::path path_;
  const UrdfOptions& options_;
  UrdfOutline outline_;
  std::vector<std::string> notes_, incomplete_;
  std::string floating_base_;
  std::map<fs::path, std::shared_ptr<const TriangleMesh>> meshes_;
};

}  // namespace

RobotDescription read_urdf(const fs::path& path, const UrdfOptions& options) {
  return parse_urdf(read_file(path), path, options);
}

RobotDescription parse_urdf(const std::string& text, const fs::path& path, const UrdfOptions& options) {
  return UrdfReader(path, text, options).read();
}

}  // namespace hinge::robotics
