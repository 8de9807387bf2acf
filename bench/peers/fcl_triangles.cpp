// SPDX-License-Identifier: BSD-3-Clause
// Calls FCL's triangle kernels, meshes and balls; FCL's headers stay in this file.
#include "peers/fcl_triangles.hpp"

#include <fcl/geometry/bvh/BVH_model.h>
#include <fcl/geometry/shape/sphere.h>
#include <fcl/math/bv/OBBRSS.h>
#include <fcl/narrowphase/collision.h>
#include <fcl/narrowphase/detail/primitive_shape_algorithm/triangle_distance.h>
#include <fcl/narrowphase/detail/traversal/collision/intersect.h>
#include <fcl/narrowphase/distance.h>

#include <memory>

namespace hinge::bench {
namespace {

using Point = fcl::Vector3d;
using Mesh = fcl::BVHModel<fcl::OBBRSS<double>>;

std::array<Point, 3> corners(const FclCorners& t) {
  return {Point(t[0], t[1], t[2]), Point(t[3], t[4], t[5]), Point(t[6], t[7], t[8])};
}

std::unique_ptr<Mesh> mesh(const FclCorners& t) {
  const auto [a, b, c] = corners(t);
  auto model = std::make_unique<Mesh>();
  model->beginModel(1, 3);
  model->addTriangle(a, b, c);
  model->endModel();
  return model;
}

}  // namespace

bool fcl_intersect(const FclCorners& p, const FclCorners& q) {
  const auto [a, b, c] = corners(p);
  const auto [d, e, f] = corners(q);
  return fcl::detail::Intersect<double>::intersect_Triangle(a, b, c, d, e, f);
}

double fcl_distance(const FclCorners& p, const FclCorners& q) {
  const auto x = corners(p), y = corners(q);
  Point on_p, on_q;
  return fcl::detail::TriangleDistance<double>::triDistance(x.data(), y.data(), on_p, on_q);
}

bool fcl_meshes_collide(const FclCorners& p, const FclCorners& q) {
  const auto a = mesh(p), b = mesh(q);
  const fcl::CollisionRequest<double> request;
  fcl::CollisionResult<double> result;
  return fcl::collide(a.get(), fcl::Transform3d::Identity(), b.get(), fcl::Transform3d::Identity(), request, result) >
         0;
}

double fcl_meshes_distance(const FclCorners& p, const FclCorners& q) {
  const auto a = mesh(p), b = mesh(q);
  const fcl::DistanceRequest<double> request;
  fcl::DistanceResult<double> result;
  return fcl::distance(a.get(), fcl::Transform3d::Identity(), b.get(), fcl::Transform3d::Identity(), request, result);
}

bool fcl_balls_collide(const std::array<double, 3>& p, double p_radius, const std::array<double, 3>& q,
                       double q_radius) {
  const fcl::Sphere<double> a(p_radius), b(q_radius);
  fcl::Transform3d at_a = fcl::Transform3d::Identity(), at_b = at_a;
  at_a.translation() = Point(p[0], p[1], p[2]);
  at_b.translation() = Point(q[0], q[1], q[2]);
  const fcl::CollisionRequest<double> request;
  fcl::CollisionResult<double> result;
  return fcl::collide(&a, at_a, &b, at_b, request, result) > 0;
}

}  // namespace hinge::bench
