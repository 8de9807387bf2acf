// SPDX-License-Identifier: BSD-3-Clause
// Two paths that sampling calls free: the first is proved free, the second collides.
#include <hinge/hierarchy.hpp>
#include <hinge/path/certified_path.hpp>
#include <hinge/path/check_sampled.hpp>
#include <hinge/policy/different_links.hpp>
#include <hinge/primitive/sphere.hpp>
#include <vector>

int main() {
  // A 1 m arm rotates in a plane past a post at the edge of its range. Lengths in m, angles in rad.
  hinge::ModelBuilder<hinge::Sphere> build;
  build.add_primitive(hinge::world, {{1.1, 0, 0}, 0.05});
  build.add_link(hinge::world, hinge::Revolute{}, {{{0, 1, 0}, 0.0501}});
  const auto model = build.finish();
  const hinge::Hierarchy arm(model, hinge::DifferentLinks({model.links().begin(), model.links().end()}),
                             hinge::UniformClearance{0.0});

  const std::vector<double> up{0.0}, beside{-1.4}, beyond{-2.0};
  hinge::CertifiedPath certified(arm);  // copies the hierarchy
  const hinge::PathAnswer free = certified.check(up, beside);
  const hinge::PathAnswer hit = certified.check(up, beyond);

  hinge::Hierarchy asked = arm;
  const double step = 0.0175;  // one degree in rad
  const bool found = !hinge::check_sampled(asked, up, beyond, step).is_free();
  asked.update(hit.configuration);
  const bool proved = free.verdict == hinge::PathVerdict::free;
  return proved && hit.verdict == hinge::PathVerdict::colliding && !found && asked.self_collides() ? 0 : 1;
}
