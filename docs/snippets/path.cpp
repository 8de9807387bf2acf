// SPDX-License-Identifier: BSD-3-Clause
// A path that sampling calls free, proved, and one that sampling calls free although it is not.
#include <hinge/hierarchy.hpp>
#include <hinge/path/certified_path.hpp>
#include <hinge/path/check_sampled.hpp>
#include <hinge/policy/different_links.hpp>
#include <hinge/primitive/sphere.hpp>
#include <vector>

int main() {
  // An arm of 1 m turns in the plane; a post stands just inside its reach. Metres, rad.
  hinge::ModelBuilder<hinge::Sphere> build;
  build.add_primitive(hinge::world, {{1.1, 0, 0}, 0.05});
  build.add_link(hinge::world, hinge::Revolute{}, {{{0, 1, 0}, 0.0501}});
  const auto model = build.finish();
  const hinge::Hierarchy arm(model, hinge::DifferentLinks({model.links().begin(), model.links().end()}),
                             hinge::UniformClearance{0.0});

  const std::vector<double> up{0.0}, beside{-1.4}, beyond{-2.0};
  hinge::CertifiedPath certified(arm);  // takes a copy
  const hinge::PathAnswer free = certified.check(up, beside);
  const hinge::PathAnswer hit = certified.check(up, beyond);

  hinge::Hierarchy asked = arm;
  const double step = 0.0175;  // a degree
  const bool found = !hinge::check_sampled(asked, up, beyond, step).is_free();
  asked.update(hit.configuration);
  const bool proved = free.verdict == hinge::PathVerdict::free;
  return proved && hit.verdict == hinge::PathVerdict::colliding && !found && asked.self_collides() ? 0 : 1;
}
