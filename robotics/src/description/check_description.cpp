// SPDX-License-Identifier: BSD-3-Clause
// Implements the checks of a description, in this order: names, tree, joints, mimic joints, geometry.
#include "description/check_description.hpp"

#include <algorithm>
#include <cstddef>
#include <locale>
#include <map>
#include <sstream>
#include <string_view>
#include <variant>
#include <vector>

#include "hinge/core/finite.hpp"

namespace hinge::robotics {

namespace {

using Index = std::map<std::string_view, std::size_t>;
using Found = std::optional<Problem>;

std::string in_quotes(std::string_view name) { return std::string("'").append(name).append("'"); }
std::string of(const LinkDescription& link) { return "link " + in_quotes(link.name); }
std::string of(const JointDescription& joint) { return "joint " + in_quotes(joint.name); }
Problem at(const auto& element, const std::string& what) { return {element.line, of(element) + what}; }

std::string text(double x) {
  std::ostringstream out;
  out.imbue(std::locale::classic());
  out << x;
  return out.str();
}
std::string text(const Vec3& x) { return text(x[0]) + " " + text(x[1]) + " " + text(x[2]); }

template <class Elements>
Found index_names(const Elements& elements, Index& index) {
  for (std::size_t k = 0; k < elements.size(); ++k) {
    const auto& element = elements[k];
    if (element.name.empty()) return at(element, ": has no name");
    const auto [first, is_new] = index.emplace(element.name, k);
    const int line = elements[first->second].line;
    if (!is_new)
      return at(element,
                ": the name is already used" + (line > 0 ? " in line " + std::to_string(line) : std::string()));
  }
  return {};
}

Found check_tree(const RobotDescription& robot, const Index& links) {
  std::vector<const JointDescription*> above(robot.links.size(), nullptr);
  for (const JointDescription& joint : robot.joints) {
    for (const auto& [role, name] : {std::pair("parent", &joint.parent), std::pair("child", &joint.child)})
      if (!links.contains(*name))
        return at(joint, ": its " + std::string(role) + " link " + in_quotes(*name) + " does not exist");
    const JointDescription*& other = above[links.at(joint.child)];
    if (other != nullptr)
      return at(joint, ": its child link " + in_quotes(joint.child) + " is already the child of " + of(*other));
    other = &joint;
  }
  const auto root = std::find(above.begin(), above.end(), nullptr);
  if (root != above.end()) {
    const auto second = std::find(root + 1, above.end(), nullptr);
    if (second != above.end()) {
      const LinkDescription& link = robot.links[static_cast<std::size_t>(second - above.begin())];
      const LinkDescription& first = robot.links[static_cast<std::size_t>(root - above.begin())];
      return Problem{link.line, "links " + in_quotes(first.name) + " and " + in_quotes(link.name) +
                                    " both have no parent; expected one root"};
    }
  }
  // Every link but the root has one parent, so a link that is not below the root is on a cycle or below one. Marked
  // links end the climb, so each link is climbed only once.
  std::vector<bool> from_root(robot.links.size(), false);
  for (std::size_t l = 0; l < robot.links.size(); ++l) {
    std::size_t here = l, steps = 0;
    while (!from_root[here] && above[here] != nullptr && steps++ < robot.links.size())
      here = links.at(above[here]->parent);
    if (!from_root[here] && above[here] != nullptr)
      return at(robot.links[here], ": its joints form a cycle, expected a tree");
    const std::size_t known = here;
    for (here = l; here != known; here = links.at(above[here]->parent)) from_root[here] = true;
    from_root[known] = true;
  }
  return {};
}

Found check_joint(const JointDescription& joint) {
  if (!is_rigid(joint.origin)) return at(joint, ": its origin is not a rigid placement of finite numbers");
  if (joint.type == JointType::fixed) return {};
  const double squared_length = squared_norm(joint.axis);
  if (!is_finite(joint.axis) || !is_finite(squared_length) || !(squared_length > 0.0))
    return at(joint, ": its axis is " + text(joint.axis) + ", expected a finite direction other than 0 0 0");
  if (joint.type == JointType::continuous) return {};
  if (!is_finite(joint.lower) || !is_finite(joint.upper) || !is_finite(joint.upper - joint.lower))
    return at(joint,
              ": its limits are " + text(joint.lower) + " and " + text(joint.upper) + ", expected finite numbers");
  if (joint.lower > joint.upper && !joint.mimic)
    return at(joint, ": its lower limit " + text(joint.lower) + " is above its upper limit " + text(joint.upper));
  return {};
}

Found check_mimics(const RobotDescription& robot) {
  Index joints;
  for (std::size_t k = 0; k < robot.joints.size(); ++k) joints[robot.joints[k].name] = k;
  for (const JointDescription& joint : robot.joints) {
    if (joint.type == JointType::fixed || !joint.mimic) continue;
    if (!is_finite(joint.mimic->multiplier) || !is_finite(joint.mimic->offset))
      return at(joint, ": mimic multiplier " + text(joint.mimic->multiplier) + " and offset " +
                           text(joint.mimic->offset) + ", expected finite numbers");
    const auto leader = joints.find(joint.mimic->joint);
    if (leader == joints.end())
      return at(joint, ": mimics joint " + in_quotes(joint.mimic->joint) + ", which does not exist");
    if (robot.joints[leader->second].type == JointType::fixed)
      return at(joint, ": mimics joint " + in_quotes(joint.mimic->joint) + ", which is fixed");
  }
  for (const JointDescription& joint : robot.joints) {
    if (joint.type == JointType::fixed) continue;
    const JointDescription* here = &joint;
    std::size_t steps = 0;
    while (here->mimic && steps++ < robot.joints.size()) here = &robot.joints[joints.at(here->mimic->joint)];
    if (here->mimic)
      return at(*here, ": mimics joint " + in_quotes(here->mimic->joint) + ", which depends on this joint in turn");
  }
  return {};
}

// A size of 0 is well defined: a point, a segment or a flat solid.
std::string unless_length(const char* what, double size) {
  if (is_length(size) && size >= 0.0) return "";
  const bool large = is_finite(size) && size >= 0.0;
  return std::string(what) + " " + text(size) + ", expected a finite length of at " +
         (large ? "most 2^1000" : "least 0");
}

struct ShapeProblem {
  std::string operator()(const BoxShape& box) const {
    for (int k = 0; k < 3; ++k)
      if (!is_finite(box.size[k]) || !(box.size[k] >= 0.0))
        return "box of size " + text(box.size) + ", expected finite lengths of at least 0";
    return is_length(box.size) ? "" : "box of size " + text(box.size) + ", expected lengths of at most 2^1000";
  }
  std::string operator()(const SphereShape& sphere) const { return unless_length("sphere of radius", sphere.radius); }
  std::string operator()(const CylinderShape& cylinder) const {
    const std::string radius = unless_length("cylinder of radius", cylinder.radius);
    return radius.empty() ? unless_length("cylinder of length", cylinder.length) : radius;
  }
  std::string operator()(const CapsuleShape& capsule) const {
    const std::string radius = unless_length("capsule of radius", capsule.radius);
    return radius.empty() ? unless_length("capsule of length", capsule.length) : radius;
  }
  std::string operator()(const MeshShape& shape) const {
    std::string who = "mesh";
    if (!shape.file.empty()) who.append(" ").append(in_quotes(shape.file.string()));
    for (int k = 0; k < 3; ++k)
      if (!is_finite(shape.scale[k]) || shape.scale[k] == 0.0)
        return who + ": scale " + text(shape.scale) + ", expected finite factors other than 0";
    if (shape.mesh == nullptr || shape.mesh->triangles.empty()) return who + ": has no triangles";
    for (std::size_t t = 0; t < shape.mesh->triangles.size(); ++t) {
      const Triangle& triangle = shape.mesh->triangles[t];
      if (!is_finite(triangle.a) || !is_finite(triangle.b) || !is_finite(triangle.c))
        return who + ": triangle " + std::to_string(t) +
               " has a vertex that is not finite, expected finite coordinates";
      for (const Vec3* vertex : {&triangle.a, &triangle.b, &triangle.c})
        if (!is_length(Vec3(vertex->cwiseProduct(shape.scale))))
          return who + ": scale " + text(shape.scale) + " moves a vertex of triangle " + std::to_string(t) +
                 " beyond 2^1000";
    }
    return "";
  }
  std::string operator()(const PointCloudShape& cloud) const {
    if (cloud.points == nullptr || cloud.points->empty()) return "point cloud without points, expected at least one";
    for (std::size_t k = 0; k < cloud.points->size(); ++k)
      if (!is_length((*cloud.points)[k]))
        return "point cloud: point " + std::to_string(k) + " is " + text((*cloud.points)[k]) +
               ", expected finite coordinates of at most 2^1000";
    return unless_length("point cloud of radius", cloud.radius);
  }
};

/// Describes shapes without volume. Meshes are not examined.
struct WithoutVolume {
  std::string operator()(const BoxShape& box) const {
    return box.size[0] > 0.0 && box.size[1] > 0.0 && box.size[2] > 0.0 ? "" : "box of size " + text(box.size);
  }
  std::string operator()(const SphereShape& sphere) const { return sphere.radius > 0.0 ? "" : "sphere of radius 0"; }
  std::string operator()(const CylinderShape& cylinder) const {
    return cylinder.radius > 0.0 && cylinder.length > 0.0
               ? ""
               : "cylinder of radius " + text(cylinder.radius) + " and length " + text(cylinder.length);
  }
  std::string operator()(const CapsuleShape& capsule) const {
    return capsule.radius > 0.0 ? "" : "capsule of radius 0";
  }
  std::string operator()(const MeshShape&) const { return ""; }
  std::string operator()(const PointCloudShape& cloud) const {
    return cloud.radius > 0.0 ? "" : "point cloud of radius 0";
  }
};

Found check_geometry(const LinkDescription& link) {
  for (const PlacedShape& placed : link.geometry) {
    if (!is_rigid(placed.origin)) return at(link, ": a collision's origin is not a rigid placement of finite numbers");
    const std::string problem = problem_of(placed.shape);
    if (!problem.empty()) return at(link, ": " + problem);
  }
  return {};
}

}  // namespace

std::string problem_of(const Shape& shape) { return std::visit(ShapeProblem{}, shape); }

std::string without_volume(const Shape& shape) { return std::visit(WithoutVolume{}, shape); }

std::optional<Problem> tree_problem(const RobotDescription& robot) {
  if (robot.links.empty()) return Problem{0, "the robot has no links"};
  Index links, joints;
  Found found = index_names(robot.links, links);
  if (!found) found = index_names(robot.joints, joints);
  if (!found) found = check_tree(robot, links);
  return found;
}

std::optional<Problem> first_problem(const RobotDescription& robot) {
  Found found = tree_problem(robot);
  for (const JointDescription& joint : robot.joints)
    if (!found) found = check_joint(joint);
  if (!found) found = check_mimics(robot);
  for (const LinkDescription& link : robot.links)
    if (!found) found = check_geometry(link);
  return found;
}

}  // namespace hinge::robotics
