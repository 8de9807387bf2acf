// SPDX-License-Identifier: BSD-3-Clause
// FCL with the binaries and flags of Debian, and distances of FCL's own shapes.
#include "oracle/fcl_robots.hpp"

#include <fcl/geometry/shape/box.h>
#include <fcl/geometry/shape/capsule.h>
#include <fcl/geometry/shape/cylinder.h>
#include <fcl/geometry/shape/sphere.h>

#include "oracle/define_fcl_robots.hpp"

namespace hinge::oracle {

template class FclTrees<FclBuild::debian>;
template class FclScene<FclBuild::debian>;
template class FclRobot<FclBuild::debian>;

namespace {

template <class A, class B>
double shape_distance(const A& a, const Placement& at_a, const B& b, const Placement& at_b) {
  fcl::DistanceRequest<double> request;
  request.distance_tolerance = 1e-12;  // tolerance of libccd's iteration and so its error; the default is 1e-6
  fcl::DistanceResult<double> result;
  return fcl::distance(&a, transform(at_a), &b, transform(at_b), request, result);
}

struct MakeShape {
  using Shape = std::shared_ptr<fcl::CollisionGeometry<double>>;
  Shape operator()(const FclSphere& s) const { return std::make_shared<fcl::Sphere<double>>(s.radius); }
  Shape operator()(const FclCapsule& c) const { return std::make_shared<fcl::Capsule<double>>(c.radius, c.length); }
  Shape operator()(const FclBox& b) const {
    return std::make_shared<fcl::Box<double>>(b.size[0], b.size[1], b.size[2]);
  }
  Shape operator()(const FclCylinder& c) const { return std::make_shared<fcl::Cylinder<double>>(c.radius, c.length); }
};

}  // namespace

bool collide(const FclShape& a, const Placement& at_a, const FclShape& b, const Placement& at_b) {
  const auto x = std::visit(MakeShape{}, a), y = std::visit(MakeShape{}, b);
  fcl::CollisionRequest<double> request;
  fcl::CollisionResult<double> result;
  return fcl::collide(x.get(), transform(at_a), y.get(), transform(at_b), request, result) > 0;
}

double distance(const FclSphere& a, const Placement& at_a, const FclSphere& b, const Placement& at_b) {
  return shape_distance(fcl::Sphere<double>(a.radius), at_a, fcl::Sphere<double>(b.radius), at_b);
}
double distance(const FclCapsule& a, const Placement& at_a, const FclCapsule& b, const Placement& at_b) {
  return shape_distance(fcl::Capsule<double>(a.radius, a.length), at_a, fcl::Capsule<double>(b.radius, b.length), at_b);
}
double distance(const FclBox& a, const Placement& at_a, const FclBox& b, const Placement& at_b) {
  return shape_distance(fcl::Box<double>(a.size[0], a.size[1], a.size[2]), at_a,
                        fcl::Box<double>(b.size[0], b.size[1], b.size[2]), at_b);
}

}  // namespace hinge::oracle
