// SPDX-License-Identifier: BSD-3-Clause
// What a project that uses the core does: two unit boxes, one apart and one touching.
#include "hinge/bounds/aabb.hpp"
#include "hinge/version.hpp"

int main() {
  const hinge::Aabb box(hinge::Vec3(0.0, 0.0, 0.0), hinge::Vec3(1.0, 1.0, 1.0));
  const hinge::Aabb touching(hinge::Vec3(1.0, 0.0, 0.0), hinge::Vec3(2.0, 1.0, 1.0));
  const hinge::Aabb apart(hinge::Vec3(3.0, 0.0, 0.0), hinge::Vec3(4.0, 1.0, 1.0));
  return hinge::overlap(box, touching) && !hinge::overlap(box, apart) && hinge::version_major == 0 ? 0 : 1;
}
