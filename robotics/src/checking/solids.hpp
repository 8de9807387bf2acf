// SPDX-License-Identifier: BSD-3-Clause
// Solids: the closed surfaces of a robot whose inside counts, and the parts that may come to lie in one.
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

/// Triangles `first` to `first + count - 1` of the model are the closed surface of a solid.
struct Solid {
  LinkId link{};
  std::size_t first = 0;
  std::size_t count = 0;
  Pose frame{};              ///< middle and axes of a box around it, in the link's frame
  Vec3 half = Vec3::Zero();  ///< of that box's edges, m
  double radius = 0.0;       ///< m, of the ball around that box
};

/// Triangles of a link that hang together by their vertices. Where their surface and that of a solid do not meet, they
/// lie inside the solid exactly when one of their vertices does.
struct SolidPart {
  PrimitiveId triangle{};     ///< one of them
  Vec3 point = Vec3::Zero();  ///< its vertex a, link frame
  double diameter = 0.0;      ///< m, a lower bound of the part's
};

/// Could the part fit into the solid?
inline bool may_hold(const Solid& solid, const SolidPart& part) noexcept {
  constexpr double slack = 1.0 + 1e-6;
  return !(part.diameter > 2.0 * solid.radius * slack);
}

struct BoundingBall {
  Vec3 centre = Vec3::Zero();
  double radius = 0.0;
};

/// Of one robot; shared by everything that asks it, from any thread.
class Solids {
 public:
  Solids(Model<Triangle> model, std::vector<Solid> solids);

  std::span<const Solid> all() const noexcept { return solids_; }
  std::span<const Solid> of(LinkId link) const noexcept {
    return std::span(solids_).subspan(first_solid_[index(link)],
                                      first_solid_[index(link) + 1] - first_solid_[index(link)]);
  }
  /// Found when first asked for.
  std::span<const SolidPart> parts(LinkId link) const;
  /// Around the point of each part, link frame; around all vertices where the link has many triangles.
  BoundingBall points(LinkId link) const;
  /// False only when no part of the link fits into the solid.
  bool may_hold_any(const Solid& solid, LinkId link) const;

 private:
  bool has_many_triangles(LinkId link) const noexcept;
  std::span<const Triangle> triangles(LinkId link) const noexcept {
    return model_.primitives().subspan(first_[index(link)], first_[index(link) + 1] - first_[index(link)]);
  }

  Model<Triangle> model_;
  std::vector<Solid> solids_;             // by link
  std::vector<std::size_t> first_;        // by link: its first triangle
  std::vector<std::size_t> first_solid_;  // by link
  std::unique_ptr<std::once_flag[]> asked_;
  mutable std::vector<std::vector<SolidPart>> parts_;
};

}  // namespace hinge::robotics
