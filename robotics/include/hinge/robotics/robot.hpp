// SPDX-License-Identifier: BSD-3-Clause
// Robot: a checked description as an articulated model of triangles, with names, limits and followers.
#pragma once

#include <cstddef>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "hinge/core/id.hpp"
#include "hinge/model/model.hpp"
#include "hinge/primitive/triangle.hpp"
#include "hinge/robotics/robot_description.hpp"
#include "hinge/robotics/tessellate.hpp"

namespace hinge::robotics {

class Solids;

/// Every movable joint, followers included, is a DOF of the model; the root link is fixed in the world. Metres,
/// radians. "Joint k" is position k in description().joints.
class Robot {
 public:
  /// ModelError names link or joint: see check_description.hpp for what is refused.
  explicit Robot(RobotDescription description, const Tessellation& tessellation = {});

  const std::string& name() const noexcept { return description_.name; }
  const RobotDescription& description() const noexcept { return description_; }
  const Tessellation& tessellation() const noexcept { return tessellation_; }
  /// Links parents first, otherwise in the description's order; triangles in the order of their links.
  const Model<Triangle>& model() const noexcept { return *model_; }

  // --- links; LinkId as in model(), 0 is the world and has no name ---

  std::size_t link_count() const noexcept { return link_names_.size(); }
  const std::string& link_name(LinkId link) const noexcept { return link_names_[index(link)]; }
  std::optional<LinkId> find_link(std::string_view name) const noexcept;
  /// Number of triangles; 0: the link takes part in no test.
  std::size_t triangle_count(LinkId link) const noexcept { return triangle_counts_[index(link)]; }
  /// Radius per triangle, m: spheres and capsules are points and segments grown by it. Empty: all 0.
  std::span<const double> radii() const noexcept { return radii_; }
  /// Which triangles enclose a solid: for the library's own use.
  const Solids& solids() const noexcept { return *solids_; }
  /// Triangles of zero area and radius 0, kept as the segments or points they span.
  std::size_t degenerate_count() const noexcept { return degenerate_count_; }

  // --- joints ---

  std::optional<std::size_t> find_joint(std::string_view name) const noexcept;
  std::size_t joint_of(DofId dof) const noexcept { return joint_of_dof_[index(dof)]; }

  /// The movable joints that follow no other, in the description's order.
  std::span<const std::size_t> independent_joints() const noexcept { return independent_; }
  const std::string& independent_name(std::size_t k) const noexcept {
    return description_.joints[independent_[k]].name;
  }
  /// Limits of the independent joints, rad or m; -pi and pi for continuous ones.
  std::span<const double> lower() const noexcept { return lower_; }
  std::span<const double> upper() const noexcept { return upper_; }

  /// A DOF's value is multiplier * value of an independent joint + offset.
  struct Drive {
    std::size_t independent = 0;  ///< position in independent_joints()
    double multiplier = 1.0;
    double offset = 0.0;
  };
  /// By DOF: what followers follow in the end.
  std::span<const Drive> drives() const noexcept { return drives_; }

  /// The model's full configuration (one value per DOF) from values of the independent joints. Limits are not looked
  /// at, neither theirs nor the followers'. ConfigurationError: wrong length, or a value that is not finite.
  std::vector<double> expand(std::span<const double> independent) const;
  /// The same into `full`, which has one place per DOF.
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
