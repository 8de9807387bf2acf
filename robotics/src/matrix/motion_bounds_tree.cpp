// SPDX-License-Identifier: BSD-3-Clause
// Builds trees of balls over a link for the proof.
#include "matrix/motion_bounds_tree.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "hinge/bounds/aabb.hpp"

namespace hinge::robotics {

BallTree::BallTree(const Robot& robot, LinkId link) {
  const Model<Triangle>& model = robot.model();
  Aabb box;
  for (std::size_t i = 0; i < model.size(); ++i) {
    if (model.links()[i] != link) continue;
    const Triangle& t = model.primitives()[i];
    const double radius = robot.radii().empty() ? 0.0 : robot.radii()[i];
    box.extend(t.bounds());
    for (const Vec3& corner : {t.a, t.b, t.c}) reach_ = std::max(reach_, norm(corner) + radius);
  }
  // Longest edge of a piece relative to the link. The rotation of a link is bounded by one ball per piece, so a long
  // triangle would need a ball as large as the link. Finer pieces only cost memory, because small boxes of joint values
  // rotate them little.
  constexpr double fraction_of_link = 0.125;
  const double longest = fraction_of_link * norm(Vec3(box.upper - box.lower));
  for (std::size_t i = 0; i < model.size(); ++i)
    if (model.links()[i] == link) cut({model.primitives()[i], id<PrimitiveId>(i)}, longest);
  nodes_.reserve(2 * pieces_.size());
  nodes_.emplace_back();
  build(0, 0, pieces_.size(), robot.radii());
}

/// Bisects a triangle at its longest edge until no edge exceeds `longest` (m).
void BallTree::cut(const Piece& piece, double longest) {
  const std::array<Vec3, 3> v = {piece.part.a, piece.part.b, piece.part.c};
  std::size_t k = 0;
  for (std::size_t e = 1; e < 3; ++e)
    if (squared_norm(v[(e + 1) % 3] - v[e]) > squared_norm(v[(k + 1) % 3] - v[k])) k = e;
  const Vec3 &from = v[k], &to = v[(k + 1) % 3], &apex = v[(k + 2) % 3];
  if (!(norm(to - from) > longest)) {
    pieces_.push_back(piece);
    return;
  }
  const Vec3 middle = from + (to - from) * 0.5;
  cut({{from, middle, apex}, piece.triangle}, longest);
  cut({{middle, to, apex}, piece.triangle}, longest);
}

void BallTree::build(std::uint32_t n, std::size_t begin, std::size_t end, std::span<const double> radii) {
  Aabb box;
  for (std::size_t k = begin; k < end; ++k) box.extend(pieces_[k].part.bounds());
  Node node;
  node.centre = {box.middle(0), box.middle(1), box.middle(2)};
  for (std::size_t k = begin; k < end; ++k) {
    const Triangle& t = pieces_[k].part;
    for (const Vec3& corner : {t.a, t.b, t.c}) node.extent = std::max(node.extent, norm(corner - node.centre));
    if (!radii.empty()) node.radius = std::max(node.radius, radii[index(pieces_[k].triangle)]);
  }
  node.is_leaf = end - begin == 1;
  node.first = static_cast<std::uint32_t>(node.is_leaf ? begin : nodes_.size());
  nodes_[n] = node;
  if (node.is_leaf) return;
  nodes_.resize(nodes_.size() + 2);
  const int axis = box.widest_axis();
  const auto middle = [axis](const Piece& p) {
    const Aabb b = p.part.bounds();
    return b.lower[axis] + b.upper[axis];
  };
  const std::size_t half = begin + (end - begin) / 2;
  const auto at = [&](std::size_t k) { return pieces_.begin() + static_cast<std::ptrdiff_t>(k); };
  std::nth_element(at(begin), at(half), at(end), [&](const Piece& a, const Piece& b) {
    return std::pair(middle(a), a.triangle) < std::pair(middle(b), b.triangle);
  });
  build(node.first, begin, half, radii);
  build(node.first + 1, half, end, radii);
}

}  // namespace hinge::robotics
