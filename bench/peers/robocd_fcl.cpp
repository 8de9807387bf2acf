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
#include "hinge/core/pose.hpp"
#include "hinge/core/vec3.hpp"
#include "hinge/primitive/triangle.hpp"
#include "peers/fcl_links.hpp"

// This program has no variants for other instruction sets.
extern const char hinge_build_id[];
const char hinge_build_id[] = "robocd_fcl";
extern const char hinge_programs_folder[];
const char hinge_programs_folder[] = "";

namespace robocd {
namespace {

using namespace hinge::robotics;
using hinge::bench::FclLink;
using hinge::bench::FclLinks;
using hinge::bench::FclPose;

std::array<double, 3> coordinates(const hinge::Vec3& x) { return {x[0], x[1], x[2]}; }

FclPose to_fcl(const hinge::Pose& pose) {
  FclPose fcl{};
  for (std::size_t row = 0; row < 3; ++row) {
    const auto r = static_cast<Eigen::Index>(row);
    for (std::size_t c = 0; c < 3; ++c) fcl[3 * row + c] = pose.rotation(r, static_cast<Eigen::Index>(c));
    fcl[9 + row] = pose.translation[r];
  }
  return fcl;
}

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
      link.triangles.push_back({t.a[0], t.a[1], t.a[2], t.b[0], t.b[1], t.b[2], t.c[0], t.c[1], t.c[2]});
  }
  std::vector<std::pair<std::size_t, std::size_t>> tested;
  for (const auto& [a, b] : checker.tested().list()) tested.emplace_back(hinge::index(a), hinge::index(b));
  const auto links = std::make_shared<const FclLinks>(shapes, std::move(tested));
  return [links, poses = std::vector<FclPose>(shapes.size())](RobotChecker& at) mutable {
    for (std::size_t l = 0; l < poses.size(); ++l) poses[l] = to_fcl(at.link_pose(hinge::id<hinge::LinkId>(l)));
    return links->collide(poses);
  };
}

}  // namespace

const ExtremesPeer* extremes_peer() {
  static constexpr ExtremesPeer peer{"FCL", make};
  return &peer;
}

}  // namespace robocd
