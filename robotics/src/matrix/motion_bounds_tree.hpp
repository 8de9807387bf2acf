// SPDX-License-Identifier: BSD-3-Clause
// BallTree: a binary tree of balls around a link's triangles, for the search for proofs.
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

/// Binary tree, root first. Lengths in m, link frame.
class BallTree {
 public:
  /// The link must have at least one triangle.
  BallTree(const Robot& robot, LinkId link);

  struct Node {
    Vec3 centre = Vec3::Zero();
    double extent = 0.0;      ///< largest distance of the surface from the centre, radii not included
    double radius = 0.0;      ///< largest radius of the triangles
    std::uint32_t first = 0;  ///< inner node: the children are first and first + 1; leaf: index of its piece
    bool is_leaf = true;
  };
  /// A triangle, or a piece of a large triangle (with rounded corners).
  struct Piece {
    Triangle part;
    PrimitiveId triangle{};
  };

  const Node& node(std::uint32_t n) const noexcept { return nodes_[n]; }
  const Piece& piece(const Node& leaf) const noexcept { return pieces_[leaf.first]; }
  std::size_t size() const noexcept { return nodes_.size(); }
  /// Returns the largest distance of any point, radii included, from the link's origin.
  double reach() const noexcept { return reach_; }

 private:
  void cut(const Piece& piece, double longest);
  void build(std::uint32_t n, std::size_t begin, std::size_t end, std::span<const double> radii);

  std::vector<Piece> pieces_;
  std::vector<Node> nodes_;
  double reach_ = 0.0;
};

}  // namespace hinge::robotics
