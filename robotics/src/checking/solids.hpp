// SPDX-License-Identifier: BSD-3-Clause
// Solids: the solid shapes of a robot as closed surfaces, and the mesh components that may lie inside one.
#pragma once

#include <cstddef>
#include <memory>
#include <mutex>
#include <span>
#include <vector>

#include "hinge/core/id.hpp"
#include "hinge/core/pose.hpp"
#include "hinge/core/vec3.hpp"
#include "hinge/model/model.hpp"
#include "hinge/primitive/triangle.hpp"

namespace hinge::robotics {

/// A solid: triangles `first` to `first + count - 1` of the model are its closed surface.
struct Solid {
  LinkId link{};
  std::size_t first = 0;
  std::size_t count = 0;
  Pose frame{};              ///< centre and axes of a bounding box, link frame
  Vec3 half = Vec3::Zero();  ///< half edge lengths of this box, m
  double radius = 0.0;       ///< m, of the ball around this box
};

/// A connected component of a link's mesh (triangles that share vertices). If its surface and that of a solid do not
/// touch, it is inside the solid if and only if one of its vertices is.
struct SolidPart {
  PrimitiveId triangle{};     ///< its first triangle
  Vec3 point = Vec3::Zero();  ///< vertex a of this triangle, link frame
  double diameter = 0.0;      ///< m, a lower bound
};

/// Returns false if the component is certainly too large for the solid.
inline bool may_hold(const Solid& solid, const SolidPart& part) noexcept {
  constexpr double slack = 1.0 + 1e-6;
  return !(part.diameter > 2.0 * solid.radius * slack);
}

/// A ball in a link's frame, m.
struct BoundingBall {
  Vec3 centre = Vec3::Zero();
  double radius = 0.0;
};

/// The solids of one robot. Shared by all its checkers; thread-safe.
class Solids {
 public:
  Solids(Model<Triangle> model, std::vector<Solid> solids);

  std::span<const Solid> all() const noexcept { return solids_; }
  std::span<const Solid> of(LinkId link) const noexcept {
    return std::span(solids_).subspan(first_solid_[index(link)],
                                      first_solid_[index(link) + 1] - first_solid_[index(link)]);
  }
  /// Returns the components of a link. Computed at the first call.
  std::span<const SolidPart> parts(LinkId link) const;
  /// Returns a ball around the points of all components, link frame. For a link with many triangles: around all
  /// vertices.
  BoundingBall points(LinkId link) const;
  /// Returns false only if no component of the link fits into the solid.
  bool may_hold_any(const Solid& solid, LinkId link) const;

 private:
  bool has_many_triangles(LinkId link) const noexcept;
  std::span<const Triangle> triangles(LinkId link) const noexcept {
    return model_.primitives().subspan(first_[index(link)], first_[index(link) + 1] - first_[index(link)]);
  }

  Model<Triangle> model_;
  std::vector<Solid> solids_;             // sorted by link
  std::vector<std::size_t> first_;        // by link: index of its first triangle
  std::vector<std::size_t> first_solid_;  // by link: index of its first solid
  std::unique_ptr<std::once_flag[]> asked_;
  mutable std::vector<std::vector<SolidPart>> parts_;
};

}  // namespace hinge::robotics
