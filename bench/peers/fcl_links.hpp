// SPDX-License-Identifier: BSD-3-Clause
// FclLinks: the links of a robot as a user of FCL gives them, behind plain arrays, because FCL's types change with
// compiler flags.
#pragma once

#include <array>
#include <memory>
#include <span>
#include <vector>

#include "oracle/fcl_oracle.hpp"
#include "peers/fcl_triangles.hpp"

namespace hinge::bench {

/// The shapes of a link in its frame. All triangles become one mesh.
struct FclLink {
  struct Capsule {  // a sphere if `from` and `to` are equal
    std::array<double, 3> from, to;
    double radius;
  };
  std::vector<FclCorners> triangles;
  std::vector<Capsule> capsules;
};

class FclLinks {
 public:
  FclLinks(std::span<const FclLink> links, oracle::Pairs tested);
  ~FclLinks();
  /// Returns whether a tested pair of links collides, by fcl::collide. poses: one per link.
  bool collide(std::span<const oracle::Placement> poses) const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace hinge::bench
