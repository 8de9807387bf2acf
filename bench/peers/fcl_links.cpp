// SPDX-License-Identifier: BSD-3-Clause
// Implements FclLinks.
#include "peers/fcl_links.hpp"

#include <fcl/geometry/bvh/BVH_model.h>
#include <fcl/geometry/shape/capsule.h>
#include <fcl/geometry/shape/sphere.h>
#include <fcl/math/bv/OBBRSS.h>
#include <fcl/narrowphase/collision.h>

#include "oracle/fcl_transform.hpp"

namespace hinge::bench {
namespace {

using Mesh = fcl::BVHModel<fcl::OBBRSS<double>>;

fcl::Vector3d point(const std::array<double, 3>& x) { return {x[0], x[1], x[2]}; }

/// A shape in the frame of its link.
struct Part {
  std::shared_ptr<fcl::CollisionGeometryd> shape;
  fcl::Transform3d at = fcl::Transform3d::Identity();
};

Part part(const FclLink::Capsule& capsule) {
  const fcl::Vector3d from = point(capsule.from), along = point(capsule.to) - from;
  Part made;
  made.at.translation() = from + along / 2;
  if (along.norm() == 0.0) {
    made.shape = std::make_shared<fcl::Sphered>(capsule.radius);
  } else {
    made.shape = std::make_shared<fcl::Capsuled>(capsule.radius, along.norm());
    made.at.linear() = fcl::Quaterniond::FromTwoVectors(fcl::Vector3d::UnitZ(), along).toRotationMatrix();
  }
  return made;
}

Part part(const std::vector<FclCorners>& triangles) {
  const auto mesh = std::make_shared<Mesh>();
  mesh->beginModel(static_cast<int>(triangles.size()), static_cast<int>(3 * triangles.size()));
  for (const FclCorners& t : triangles) mesh->addTriangle({t[0], t[1], t[2]}, {t[3], t[4], t[5]}, {t[6], t[7], t[8]});
  mesh->endModel();
  return {mesh};
}

}  // namespace

struct FclLinks::Impl {
  std::vector<std::vector<Part>> links;
  oracle::Pairs tested;
};

FclLinks::FclLinks(std::span<const FclLink> links, oracle::Pairs tested) : impl_(std::make_unique<Impl>()) {
  for (const FclLink& link : links) {
    std::vector<Part>& parts = impl_->links.emplace_back();
    for (const FclLink::Capsule& capsule : link.capsules) parts.push_back(part(capsule));
    if (!link.triangles.empty()) parts.push_back(part(link.triangles));
  }
  impl_->tested = std::move(tested);
}

FclLinks::~FclLinks() = default;

bool FclLinks::collide(std::span<const oracle::Placement> poses) const {
  const fcl::CollisionRequestd request;
  for (const auto& [first, second] : impl_->tested) {
    const fcl::Transform3d at_first = oracle::transform(poses[first]), at_second = oracle::transform(poses[second]);
    for (const Part& a : impl_->links[first])
      for (const Part& b : impl_->links[second]) {
        fcl::CollisionResultd result;
        if (fcl::collide(a.shape.get(), at_first * a.at, b.shape.get(), at_second * b.at, request, result) > 0)
          return true;
      }
  }
  return false;
}

}  // namespace hinge::bench
