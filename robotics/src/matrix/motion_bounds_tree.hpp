// SPDX-License-Identifier: BSD-3-Clause
// BallTree: balls around a link's triangles, ever smaller ones; a link's shape as the search for a proof sees it.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "hinge/core/id.hpp"
#include "hinge/core/vec3.hpp"
#include "hinge/primitive/triangle.hpp"
#include "hinge/robotics/robot.hpp"

namespace hinge::robotics {

/// Binary, root first. Lengths in m, link frame.
class BallTree {
 public:
  /// The link has at least one triangle.
  BallTree(const Robot& robot, LinkId link);

  struct Node {
    Vec3 centre = Vec3::Zero();
    double extent = 0.0;      ///< largest distance of the surface (radii left out) from the centre
    double radius = 0.0;      ///< largest radius the triangles are grown by
    std::uint32_t first = 0;  ///< inner: its children are first and first + 1; leaf: its piece
    bool is_leaf = true;
  };
  /// A triangle, or a part of a large one (its corners rounded).
  struct Piece {
    Triangle part;
    PrimitiveId triangle{};
  };

  const Node& node(std::uint32_t n) const noexcept { return nodes_[n]; }
  const Piece& piece(const Node& leaf) const noexcept { return pieces_[leaf.first]; }
  std::size_t size() const noexcept { return nodes_.size(); }
  /// Largest distance of any point, radii included, from the link's origin.
  double reach() const noexcept { return reach_; }

 private:
  void cut(const Piece& piece, double longest);
  void build(std::uint32_t n, std::size_t begin, std::size_t end, std::span<const double> radii);

  std::vector<Piece> pieces_;
  std::vector<Node> nodes_;
  double reach_ = 0.0;
};

}  // namespace hinge::robotics
