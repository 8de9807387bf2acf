// SPDX-License-Identifier: BSD-3-Clause
// An arm of two links made of spheres. Does it collide with itself when the elbow turns by 3 rad?
#include <cstdio>

#include "hinge/hinge.hpp"

int main() {
  hinge::ModelBuilder<hinge::Sphere> build;  // lengths in m: centre and radius, in the frame of the link
  const auto upper = build.add_link(hinge::world, hinge::Revolute{}, {{{0, 0, 0}, 0.1}, {{0.4, 0, 0}, 0.1}});
  const hinge::Pose elbow{hinge::Mat3::Identity(), {0.5, 0, 0}};
  build.add_link(upper, hinge::Revolute{{0, 0, 1}, {0, 0, 0}, elbow, "elbow"}, {{{0.4, 0, 0}, 0.1}});
  const auto model = build.finish();

  hinge::Hierarchy arm(model, hinge::DifferentLinks({model.links().begin(), model.links().end()}),
                       hinge::UniformClearance{0.05});
  for (const double angle : {0.0, 3.0}) {
    arm.update({0.0, angle});
    std::printf("elbow at %.0f rad: %s\n", angle, arm.self_collides() ? "collides" : "free");
  }
}
