// SPDX-License-Identifier: BSD-3-Clause
// Robot: a validated description as an articulated model of triangles, with names, limits and mimic joints.
#pragma once

#include <cstddef>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "hinge/core/api.hpp"
#include "hinge/core/id.hpp"
#include "hinge/model/model.hpp"
#include "hinge/primitive/triangle.hpp"
#include "hinge/robotics/robot_description.hpp"
#include "hinge/robotics/tessellate.hpp"

namespace hinge::robotics {

class Solids;

/// A robot as an articulated model. Every movable joint, mimic joints included, is a DOF of the model; the root link is
/// fixed to the world. Lengths in m, angles in rad. A joint index is an index into description().joints. Constant after
/// construction, so any thread may read it. Spans and references are valid as long as the robot.
class HINGE_API Robot {
 public:
  /// Tessellates the shapes and builds the model. Throws ModelError, naming the link or joint, for every fault listed
  /// in check_description.hpp, a solid mesh that is not closed, a chain of mimic joints with factors that are not
  /// finite, and more than 10^6 triangles from tessellation.
  explicit Robot(RobotDescription description, const Tessellation& tessellation = {});

  /// Returns the robot's name.
  const std::string& name() const noexcept { return description_.name; }
  /// Returns the description that the robot was made from.
  const RobotDescription& description() const noexcept { return description_; }
  /// Returns the tessellation that the robot was made with.
  const Tessellation& tessellation() const noexcept { return tessellation_; }
  /// Returns the model. A parent link comes before its children; otherwise links keep the order of their joints in
  /// the description, so a LinkId is not an index into description().links. Triangles have the order of their
  /// links and are in link frames.
  const Model<Triangle>& model() const noexcept { return *model_; }

  // --- Links. LinkId as in model(); link 0 is the world and has no name. ---

  /// Returns the number of links, the world included.
  std::size_t link_count() const noexcept { return link_names_.size(); }
  /// Returns the name of a link below link_count(); "" for the world.
  const std::string& link_name(LinkId link) const noexcept { return link_names_[index(link)]; }
  /// Returns the link with this name, or nothing.
  std::optional<LinkId> find_link(std::string_view name) const noexcept;
  /// Returns the number of triangles. A link with 0 triangles is never tested.
  std::size_t triangle_count(LinkId link) const noexcept { return triangle_counts_[index(link)]; }
  /// Returns one radius (m) per triangle, or an empty span if all are 0. Spheres and capsules are points and segments
  /// inflated by their radius.
  std::span<const double> radii() const noexcept { return radii_; }
  /// Returns the solids of the links. For internal use.
  const Solids& solids() const noexcept { return *solids_; }
  /// Returns the number of triangles with zero area and radius 0. They are kept as segments or points.
  std::size_t degenerate_count() const noexcept { return degenerate_count_; }

  // --- Joints ---

  /// Returns the joint index of the joint with this name, or nothing.
  std::optional<std::size_t> find_joint(std::string_view name) const noexcept;
  /// Returns the joint index of a DOF of the model.
  std::size_t joint_of(DofId dof) const noexcept { return joint_of_dof_[index(dof)]; }

  /// Returns the joint indices of the movable joints that mimic no other joint, in the order of the description.
  std::span<const std::size_t> independent_joints() const noexcept { return independent_; }
  /// Returns the name of independent joint k, k < independent_joints().size().
  const std::string& independent_name(std::size_t k) const noexcept {
    return description_.joints[independent_[k]].name;
  }
  /// Limits of the independent joints, rad or m, independent_joints().size() values; -pi and pi for continuous joints.
  std::span<const double> lower() const noexcept { return lower_; }
  /// Upper limits, as lower().
  std::span<const double> upper() const noexcept { return upper_; }

  /// Relates a DOF to an independent joint: DOF value = multiplier * joint value + offset.
  struct Drive {
    std::size_t independent = 0;  ///< index into independent_joints()
    double multiplier = 1.0;      ///< DOF unit per unit of the independent joint
    double offset = 0.0;          ///< rad or m
  };
  /// Returns one Drive per DOF, with chains of mimic joints resolved.
  std::span<const Drive> drives() const noexcept { return drives_; }

  /// Returns the full configuration (one value per DOF of model()) for values of the independent joints, rad or m.
  /// Limits are not checked. Throws ConfigurationError if the length is wrong or a value is not finite.
  std::vector<double> expand(std::span<const double> independent) const;
  /// The same, written into `full`, which must have one element per DOF.
  void expand(std::span<const double> independent, std::span<double> full) const;

 private:
  void build();
  void find_drives();

  RobotDescription description_;
  Tessellation tessellation_;
  std::vector<std::string> link_names_;
  std::vector<std::size_t> triangle_counts_;
  std::vector<double> radii_;
  std::size_t degenerate_count_ = 0;
  std::vector<std::size_t> joint_of_dof_;
  std::vector<std::size_t> independent_;
  std::vector<double> lower_, upper_;
  std::vector<Drive> drives_;  // by DOF
  std::optional<Model<Triangle>> model_;
  std::shared_ptr<const Solids> solids_;
};

}  // namespace hinge::robotics
