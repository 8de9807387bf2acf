// SPDX-License-Identifier: BSD-3-Clause
// Builds the model from the description, parents first, and resolves mimic joints to independent joints.
#include "hinge/robotics/robot.hpp"

#include <algorithm>
#include <cstdint>
#include <map>
#include <utility>

#include "checking/solids.hpp"
#include "description/check_description.hpp"
#include "hinge/bounds/aabb.hpp"
#include "hinge/core/error.hpp"
#include "hinge/core/finite.hpp"
#include "hinge/core/number_text.hpp"
#include "hinge/robotics/containment.hpp"

namespace hinge::robotics {

namespace {

Joint core_joint(const JointDescription& joint) {
  switch (joint.type) {
    case JointType::fixed: return Fixed{joint.origin};
    case JointType::prismatic: return Prismatic{joint.axis, joint.origin, joint.name};
    case JointType::revolute:
    case JointType::continuous: break;
  }
  return Revolute{joint.axis, Vec3::Zero(), joint.origin, joint.name};
}

bool has_no_area(const Triangle& t) { return squared_norm(cross(Vec3(t.b - t.a), Vec3(t.c - t.a))) == 0.0; }

/// Returns true if the inside of the shape collides. Triangles with a radius are solid by themselves.
bool is_solid(const Shape& shape, const Surface& surface) {
  const auto* mesh = std::get_if<MeshShape>(&shape);
  return surface.radius == 0.0 && (mesh == nullptr || mesh->solid);
}

/// Makes a solid with its bounding box. first: index of the surface's first triangle in the model.
Solid solid_of(LinkId link, std::size_t first, const Surface& surface, const Pose& origin) {
  Aabb box;
  for (const Triangle& triangle : surface.triangles) box.extend(triangle.bounds());
  Solid solid{link, first, surface.triangles.size(), origin};
  const Vec3 middle(box.middle(0), box.middle(1), box.middle(2));
  solid.frame.translation = origin * middle;
  for (int k = 0; k < 3; ++k) solid.half[k] = std::max(box.upper[k] - middle[k], middle[k] - box.lower[k]);
  solid.radius = norm(solid.half);
  return solid;
}

/// Returns joint indices such that each joint follows the joint above its parent link. Otherwise the order is kept.
std::vector<std::size_t> parents_first(const RobotDescription& robot, std::string_view root) {
  std::multimap<std::string_view, std::size_t> below;
  for (std::size_t k = 0; k < robot.joints.size(); ++k) below.emplace(robot.joints[k].parent, k);
  // Take the earliest joint whose parent link is already placed.
  std::vector<std::size_t> ready, order;
  const auto open = [&](std::string_view link) {
    const auto [first, last] = below.equal_range(link);
    for (auto it = first; it != last; ++it) {
      ready.push_back(it->second);
      std::push_heap(ready.begin(), ready.end(), std::greater<>{});
    }
  };
  open(root);
  while (!ready.empty()) {
    std::pop_heap(ready.begin(), ready.end(), std::greater<>{});
    order.push_back(ready.back());
    ready.pop_back();
    open(robot.joints[order.back()].child);
  }
  return order;
}

}  // namespace

Robot::Robot(RobotDescription description, const Tessellation& tessellation)
    : description_(std::move(description)), tessellation_(tessellation) {
  if (const auto problem = first_problem(description_)) throw ModelError(problem->what);
  build();
  find_drives();
}

void Robot::build() {
  std::map<std::string_view, const LinkDescription*> links;
  for (const LinkDescription& link : description_.links) links[link.name] = &link;
  std::map<std::string_view, const LinkDescription*> roots = links;
  for (const JointDescription& joint : description_.joints) roots.erase(joint.child);
  const LinkDescription& root = *roots.begin()->second;

  // The limit of a single shape also holds for all shapes, so a small file cannot exhaust the memory.
  constexpr std::size_t most_tessellated = 1'000'000;
  std::size_t tessellated = 0;
  ModelBuilder<Triangle> builder;
  std::size_t triangle_count = 0;
  std::vector<Solid> solids;
  link_names_ = {""};
  triangle_counts_ = {0};
  std::map<std::string_view, LinkId> ids;
  const auto add = [&](LinkId parent, Joint joint, const LinkDescription& link) {
    const LinkId added = builder.add_link(parent, std::move(joint));
    ids[link.name] = added;
    link_names_.push_back(link.name);
    triangle_counts_.push_back(0);
    for (const PlacedShape& placed : link.geometry) {
      const Surface surface = tessellate(placed.shape, tessellation_);
      const bool is_given =
          std::holds_alternative<MeshShape>(placed.shape) || std::holds_alternative<PointCloudShape>(placed.shape);
      if (!is_given) tessellated += surface.triangles.size();
      if (tessellated > most_tessellated)
        throw ModelError("link '" + link.name + "': up to this link the shapes need more than " +
                         std::to_string(most_tessellated) +
                         " triangles; increase the tessellation tolerance or use meshes");
      if (is_solid(placed.shape, surface)) {
        const bool is_mesh = std::holds_alternative<MeshShape>(placed.shape);
        if (const auto open = is_mesh ? open_edge(surface.triangles) : std::nullopt)
          throw ModelError("link '" + link.name + "': a solid mesh is not closed: " + open->text());
        solids.push_back(solid_of(added, triangle_count, surface, placed.origin));
      }
      triangle_count += surface.triangles.size();
      for (const Triangle& triangle : surface.triangles) {
        degenerate_count_ += surface.radius == 0.0 && has_no_area(triangle) ? 1U : 0U;
        builder.add_primitive(added, placed.origin == Pose{} ? triangle : triangle.placed(placed.origin));
      }
      triangle_counts_.back() += surface.triangles.size();
      radii_.insert(radii_.end(), surface.triangles.size(), surface.radius);
    }
  };
  add(world, Fixed{}, root);
  for (const std::size_t k : parents_first(description_, root.name)) {
    const JointDescription& joint = description_.joints[k];
    if (joint.type != JointType::fixed) joint_of_dof_.push_back(k);
    add(ids.at(joint.parent), core_joint(joint), *links.at(joint.child));
  }
  model_ = builder.finish();
  solids_ = std::make_shared<const Solids>(*model_, std::move(solids));
  if (std::all_of(radii_.begin(), radii_.end(), [](double radius) { return radius == 0.0; })) radii_.clear();
}

void Robot::find_drives() {
  constexpr double pi = 3.141592653589793;
  std::map<std::string_view, std::size_t> position;  // of independent joints
  std::map<std::string_view, const JointDescription*> joints;
  for (std::size_t k = 0; k < description_.joints.size(); ++k) {
    const JointDescription& joint = description_.joints[k];
    joints[joint.name] = &joint;
    if (joint.type == JointType::fixed || joint.mimic) continue;
    position[joint.name] = independent_.size();
    independent_.push_back(k);
    const bool continuous = joint.type == JointType::continuous;
    lower_.push_back(continuous ? -pi : joint.lower);
    upper_.push_back(continuous ? pi : joint.upper);
  }
  for (const std::size_t k : joint_of_dof_) {
    Drive drive;
    const JointDescription* joint = &description_.joints[k];
    // q = m (m' q' + o') + o, repeated up the chain.
    for (; joint->mimic; joint = joints.at(joint->mimic->joint)) {
      drive.offset += drive.multiplier * joint->mimic->offset;
      drive.multiplier *= joint->mimic->multiplier;
    }
    drive.independent = position.at(joint->name);
    if (!is_finite(drive.multiplier) || !is_finite(drive.offset))
      throw ModelError("joint '" + description_.joints[k].name +
                       "': its chain of mimic joints gives a multiplier or offset that is not finite");
    drives_.push_back(drive);
  }
}

std::optional<LinkId> Robot::find_link(std::string_view name) const noexcept {
  const auto found = std::find(link_names_.begin() + 1, link_names_.end(), name);
  if (found == link_names_.end()) return {};
  return id<LinkId>(static_cast<std::size_t>(found - link_names_.begin()));
}

std::optional<std::size_t> Robot::find_joint(std::string_view name) const noexcept {
  const auto found = std::find_if(description_.joints.begin(), description_.joints.end(),
                                  [name](const JointDescription& joint) { return joint.name == name; });
  if (found == description_.joints.end()) return {};
  return static_cast<std::size_t>(found - description_.joints.begin());
}

void Robot::expand(std::span<const double> independent, std::span<double> full) const {
  if (independent.size() != independent_.size())
    throw ConfigurationError("configuration has " + std::to_string(independent.size()) + " values, expected " +
                             std::to_string(independent_.size()) + ", one for each independent joint");
  if (full.size() != drives_.size())
    throw ConfigurationError("full configuration has " + std::to_string(full.size()) + " values, expected " +
                             std::to_string(drives_.size()) + ", one for each movable joint");
  for (std::size_t k = 0; k < independent.size(); ++k)
    if (!is_finite(independent[k]))
      throw ConfigurationError("joint '" + independent_name(k) + "' is " + number_text(independent[k]) +
                               ", expected a finite number");
  for (std::size_t d = 0; d < drives_.size(); ++d)
    full[d] = drives_[d].multiplier * independent[drives_[d].independent] + drives_[d].offset;
}

std::vector<double> Robot::expand(std::span<const double> independent) const {
  std::vector<double> full(drives_.size());
  expand(independent, full);
  return full;
}

}  // namespace hinge::robotics
