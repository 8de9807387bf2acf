// SPDX-License-Identifier: BSD-3-Clause
// Makes the program robocd_fcl: robocd whose dial --extremes also shows the decisions of FCL. Replaces
// robotics/apps/extremes_peer.cpp.
#include <array>
#include <cstddef>
#include <functional>
#include <memory>
#include <utility>
#include <vector>

#include "../../robotics/apps/extremes_peer.hpp"
#include "hinge/core/id.hpp"
#include "hinge/core/vec3.hpp"
#include "hinge/primitive/triangle.hpp"
#include "oracle/placement.hpp"
#include "peers/fcl_links.hpp"

namespace robocd {
namespace {

using namespace hinge::robotics;
using hinge::bench::FclLink;
using hinge::bench::FclLinks;

std::array<double, 3> coordinates(const hinge::Vec3& x) { return {x[0], x[1], x[2]}; }

std::function<bool(RobotChecker&)> make(const RobotChecker& checker) {
  if (checker.margins().clearance() != 0.0) return {};
  const auto& model = checker.robot().model();
  std::vector<FclLink> shapes(checker.robot().link_count());
  for (std::size_t i = 0; i < model.size(); ++i) {
    FclLink& link = shapes[hinge::index(model.links()[i])];
    const hinge::Triangle& t = model.primitives()[i];
    const double radius = checker.margins().radius(hinge::id<hinge::PrimitiveId>(i));
    const bool is_segment = t.a == t.b || t.b == t.c || t.c == t.a;
    if (radius > 0.0 && !is_segment) return {};
    if (radius > 0.0)
      link.capsules.push_back({coordinates(t.a), coordinates(t.a == t.b ? t.c : t.b), radius});
    else
      link.triangles.push_back(hinge::oracle::corners(t));
  }
  hinge::oracle::Pairs tested;
  for (const auto& [a, b] : checker.tested().list()) tested.emplace_back(hinge::index(a), hinge::index(b));
  const auto links = std::make_shared<const FclLinks>(shapes, std::move(tested));
  return [links, poses = std::vector<hinge::oracle::Placement>(shapes.size())](RobotChecker& at) mutable {
    for (std::size_t l = 0; l < poses.size(); ++l)
      poses[l] = hinge::oracle::placement(at.link_pose(hinge::id<hinge::LinkId>(l)));
    return links->collide(poses);
  };
}

}  // namespace

const ExtremesPeer* extremes_peer() {
  static constexpr ExtremesPeer peer{"FCL", make};
  return &peer;
}

}  // namespace robocd
