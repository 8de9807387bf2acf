// SPDX-License-Identifier: BSD-3-Clause
// A primitive of your own that the SIMD engine tests sixteen at a time: it only needs a hull.
#include <array>
#include <hinge/hinge.hpp>
#include <vector>

struct SimdBall {  // a plain value in its link's frame, metres
  hinge::Vec3 center;
  double radius;
  SimdBall placed(const hinge::Pose& x) const noexcept { return {x * center, radius}; }
  hinge::Aabb bounds() const noexcept { return hinge::Aabb(center).inflated(radius); }
  friend double squared_distance(const SimdBall& a, const SimdBall& b) noexcept {
    const double d = (a.center - b.center).norm() - (a.radius + b.radius);
    return d > 0 ? d * d : 0.0;
  }
  // All points within `radius` of one point. From this, the engine makes its filter in float.
  static constexpr bool fills_hull = true;
  std::array<hinge::Vec3, 1> hull() const noexcept { return {center}; }
  double hull_radius() const noexcept { return radius; }
};
static_assert(hinge::FillsHull<SimdBall>);

int main() {
  const std::vector<SimdBall> samples{{{0, 0, 0}, 0.1}, {{1, 0, 0}, 0.2}, {{0.2, 0, 0}, 0.1}};
  const std::vector<hinge::Pose> poses{{hinge::rotation_about({0, 0, 1}, 0.7), {1, 2, 3}}};
  if (!hinge::laws::check_primitive<SimdBall>(samples, poses).empty()) return 1;

  hinge::ModelBuilder<SimdBall> build;  // a chain of forty links with three balls each
  hinge::LinkId parent = hinge::world;
  const hinge::Pose next{hinge::Mat3::Identity(), {0.3, 0, 0}};
  for (int k = 0; k < 40; ++k)
    parent = build.add_link(parent, hinge::Revolute{{0, 0, 1}, {0, 0, 0}, next, {}},
                            {{{0, 0, 0}, 0.04}, {{0.1, 0, 0}, 0.04}, {{0.2, 0, 0}, 0.04}});
  const auto model = build.finish();
  const hinge::DifferentLinks filter({model.links().begin(), model.links().end()});
  hinge::Hierarchy chain(model, filter, hinge::UniformClearance{0.0});
  hinge::Hierarchy<SimdBall, hinge::DifferentLinks, hinge::UniformClearance, hinge::Brute> brute(
      model, filter, hinge::UniformClearance{0.0});
  int colliding = 0;
  for (int step = 0; step < 40; ++step) {  // the chain rolls up; its ends meet at 40 joints of 0.157 rad
    const std::vector<double> q(40, 0.005 * step);
    chain.update(q);
    brute.update(q);
    if (chain.self_collides() != brute.self_collides()) return 1;
    colliding += chain.self_collides() ? 1 : 0;
  }
  return colliding > 0 && colliding < 40 ? 0 : 1;
}
