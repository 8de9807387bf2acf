// SPDX-License-Identifier: BSD-3-Clause
// A primitive of your own in a complete program.
#include <hinge/hierarchy.hpp>
#include <hinge/policy/different_links.hpp>

struct Ball {  // a plain value in its link's frame, metres
  Eigen::Vector3d center;
  double radius;
  Ball placed(const hinge::Pose& x) const noexcept { return {x * center, radius}; }
  hinge::Aabb bounds() const noexcept { return hinge::Aabb(center).inflated(radius); }
  friend double squared_distance(const Ball& a, const Ball& b) noexcept {
    const double d = (a.center - b.center).norm() - (a.radius + b.radius);
    return d > 0 ? d * d : 0.0;
  }
};
static_assert(hinge::Primitive<Ball>);

int main() {
  hinge::ModelBuilder<Ball> build;
  hinge::Pose elbow{hinge::Mat3::Identity(), {0.5, 0, 0}};
  auto upper = build.add_link(hinge::world, hinge::Revolute{}, {{{0, 0, 0}, 0.1}, {{0.4, 0, 0}, 0.1}});
  build.add_link(upper, hinge::Revolute{{0, 0, 1}, {0, 0, 0}, elbow, "elbow"}, {{{0.4, 0, 0}, 0.1}});
  const auto model = build.finish();
  hinge::Hierarchy arm(model, hinge::DifferentLinks({model.links().begin(), model.links().end()}),
                       hinge::UniformClearance{0.05});
  arm.update({0.0, 3.0});  // rad
  return arm.self_collides() && arm.self_closest()->first == hinge::PrimitiveId{0} ? 0 : 1;
}
