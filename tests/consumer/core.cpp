// SPDX-License-Identifier: BSD-3-Clause
// A program that uses the core: boxes that touch and boxes that do not, and the laws of its own pair filters.
#include "hinge/hinge.hpp"

struct EveryOther : hinge::AdmitAll {
  bool admits(hinge::PrimitiveId i, hinge::PrimitiveId j) const noexcept { return (index(i) + index(j)) % 2 == 1; }
};
struct OneWay : hinge::AdmitAll {
  bool admits(hinge::PrimitiveId i, hinge::PrimitiveId j) const noexcept { return i < j; }
};

int main() {
  if (!hinge::laws::check_pair_filter(EveryOther{}, 10).empty()) return 1;
  if (hinge::laws::check_pair_filter(OneWay{}, 10).empty()) return 1;
  const hinge::Aabb box(hinge::Vec3(0.0, 0.0, 0.0), hinge::Vec3(1.0, 1.0, 1.0));
  const hinge::Aabb touching(hinge::Vec3(1.0, 0.0, 0.0), hinge::Vec3(2.0, 1.0, 1.0));
  const hinge::Aabb apart(hinge::Vec3(3.0, 0.0, 0.0), hinge::Vec3(4.0, 1.0, 1.0));
  return hinge::overlap(box, touching) && !hinge::overlap(box, apart) && hinge::version_major == 0 ? 0 : 1;
}
