// SPDX-License-Identifier: BSD-3-Clause
// Makes the program biocd_fcl: biocd whose dial --extremes also shows the decisions of FCL. Replaces
// molecular/apps/extremes_peer.cpp.
#include "../../molecular/apps/extremes_peer.hpp"

#include <array>

#include "peers/fcl_triangles.hpp"

namespace biocd {
namespace {

bool collide(const hinge::Vec3& a, const hinge::Vec3& b, double threshold) {
  return hinge::bench::fcl_balls_collide({a[0], a[1], a[2]}, threshold / 2, {b[0], b[1], b[2]}, threshold / 2);
}

}  // namespace

const ExtremesPeer* extremes_peer() {
  static constexpr ExtremesPeer peer{"FCL", collide};
  return &peer;
}

}  // namespace biocd
