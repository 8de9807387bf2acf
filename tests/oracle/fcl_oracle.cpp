// SPDX-License-Identifier: BSD-3-Clause
// Implements the FCL oracle: spheres in a dynamic AABB tree, and triangle meshes.
#include "oracle/fcl_oracle.hpp"

#include <fcl/broadphase/broadphase_dynamic_AABB_tree.h>
#include <fcl/geometry/bvh/BVH_model.h>
#include <fcl/geometry/shape/sphere.h>
#include <fcl/math/bv/OBBRSS.h>
#include <fcl/narrowphase/collision.h>
#include <fcl/narrowphase/distance.h>

#include <algorithm>
#include <limits>

#include "oracle/fcl_transform.hpp"

namespace hinge::oracle {

namespace {

using Object = fcl::CollisionObject<double>;
using Mesh = fcl::BVHModel<fcl::OBBRSS<double>>;

/// Returns the number of an object; its user data points to it.
std::size_t number(const Object* object) { return *static_cast<const std::size_t*>(object->getUserData()); }

}  // namespace

struct FclSpheres::Impl {
  std::vector<std::unique_ptr<Object>> objects;
  std::vector<std::size_t> numbers;  // user data of the objects points into this
  std::vector<double> radii;
  std::function<bool(std::size_t, std::size_t)> admits;
  fcl::DynamicAABBTreeCollisionManager<double> manager;
  bool ready = false;

  struct Query {
    Impl* self;
    bool stop_at_first;
    Pairs pairs;
    double nearest = std::numeric_limits<double>::infinity();
  };

  /// Spheres use the exact formula: this compares FCL's broad phase, and FCL's sphere test computes the same.
  double gap(std::size_t i, std::size_t j) const {
    return (objects[i]->getTranslation() - objects[j]->getTranslation()).norm() - (radii[i] + radii[j]);
  }

  static bool on_collide(Object* a, Object* b, void* data) {
    auto& query = *static_cast<Query*>(data);
    const std::size_t i = std::min(number(a), number(b)), j = std::max(number(a), number(b));
    if (!query.self->admits(i, j)) return false;
    fcl::CollisionRequest<double> request;
    fcl::CollisionResult<double> result;
    if (fcl::collide(a, b, request, result) == 0) return false;
    query.pairs.emplace_back(i, j);
    return query.stop_at_first;
  }

  static bool on_distance(Object* a, Object* b, void* data, double& bound) {
    auto& query = *static_cast<Query*>(data);
    const std::size_t i = std::min(number(a), number(b)), j = std::max(number(a), number(b));
    if (query.self->admits(i, j)) query.nearest = std::min(query.nearest, query.self->gap(i, j));
    bound = query.nearest;
    return false;
  }
};

FclSpheres::FclSpheres(std::span<const double> radii, std::function<bool(std::size_t, std::size_t)> admits)
    : impl_(std::make_unique<Impl>()) {
  impl_->radii.assign(radii.begin(), radii.end());
  impl_->admits = std::move(admits);
  for (std::size_t i = 0; i < radii.size(); ++i) impl_->numbers.push_back(i);
  for (std::size_t i = 0; i < radii.size(); ++i) {
    impl_->objects.push_back(std::make_unique<Object>(std::make_shared<fcl::Sphere<double>>(radii[i])));
    impl_->objects.back()->setUserData(&impl_->numbers[i]);
  }
}
FclSpheres::FclSpheres(FclSpheres&&) noexcept = default;
FclSpheres::~FclSpheres() = default;

void FclSpheres::update(std::span<const Position> positions, std::span<const std::size_t> moved) {
  std::vector<Object*> touched;
  const auto place = [&](std::size_t i) {
    impl_->objects[i]->setTranslation(fcl::Vector3d(positions[i][0], positions[i][1], positions[i][2]));
    impl_->objects[i]->computeAABB();
    touched.push_back(impl_->objects[i].get());
  };
  if (!impl_->ready) {
    for (std::size_t i = 0; i < positions.size(); ++i) place(i);
    impl_->manager.registerObjects(touched);
    impl_->manager.setup();
    impl_->ready = true;
    return;
  }
  for (const std::size_t i : moved) place(i);
  if (moved.size() == positions.size())
    impl_->manager.update();
  else
    impl_->manager.update(touched);
}

bool FclSpheres::any() {
  Impl::Query query{impl_.get(), true, {}};
  impl_->manager.collide(&query, &Impl::on_collide);
  return !query.pairs.empty();
}

Pairs FclSpheres::all() {
  Impl::Query query{impl_.get(), false, {}};
  impl_->manager.collide(&query, &Impl::on_collide);
  return query.pairs;
}

std::optional<double> FclSpheres::distance() {
  Impl::Query query{impl_.get(), false, {}};
  impl_->manager.distance(&query, &Impl::on_distance);
  if (query.nearest == std::numeric_limits<double>::infinity()) return std::nullopt;
  return query.nearest;
}

struct FclMeshes::Impl {
  std::vector<std::shared_ptr<Mesh>> meshes;
};

FclMeshes::FclMeshes(const std::vector<std::vector<std::array<double, 9>>>& meshes) : impl_(std::make_unique<Impl>()) {
  for (const auto& triangles : meshes) {
    auto mesh = std::make_shared<Mesh>();
    if (triangles.empty()) {  // a link without geometry; FCL refuses to make a model of nothing
      impl_->meshes.push_back(nullptr);
      continue;
    }
    mesh->beginModel();
    for (const auto& t : triangles) mesh->addTriangle({t[0], t[1], t[2]}, {t[3], t[4], t[5]}, {t[6], t[7], t[8]});
    mesh->endModel();
    impl_->meshes.push_back(std::move(mesh));
  }
}
FclMeshes::FclMeshes(FclMeshes&&) noexcept = default;
FclMeshes::~FclMeshes() = default;

bool FclMeshes::collide(std::size_t i, const Placement& at_i, std::size_t j, const Placement& at_j) const {
  fcl::CollisionRequest<double> request;
  fcl::CollisionResult<double> result;
  return fcl::collide(impl_->meshes[i].get(), transform(at_i), impl_->meshes[j].get(), transform(at_j), request,
                      result) > 0;
}

Pairs FclMeshes::contacts(std::size_t i, const Placement& at_i, std::size_t j, const Placement& at_j) const {
  fcl::CollisionRequest<double> request;
  request.enable_contact = true;
  request.num_max_contacts = std::numeric_limits<std::size_t>::max();
  fcl::CollisionResult<double> result;
  fcl::collide(impl_->meshes[i].get(), transform(at_i), impl_->meshes[j].get(), transform(at_j), request, result);
  std::vector<fcl::Contact<double>> contacts;
  result.getContacts(contacts);
  Pairs pairs;
  for (const auto& contact : contacts)
    pairs.emplace_back(static_cast<std::size_t>(contact.b1), static_cast<std::size_t>(contact.b2));
  std::sort(pairs.begin(), pairs.end());
  pairs.erase(std::unique(pairs.begin(), pairs.end()), pairs.end());
  return pairs;
}

double FclMeshes::distance(std::size_t i, const Placement& at_i, std::size_t j, const Placement& at_j) const {
  fcl::DistanceRequest<double> request;
  fcl::DistanceResult<double> result;
  return fcl::distance(impl_->meshes[i].get(), transform(at_i), impl_->meshes[j].get(), transform(at_j), request,
                       result);
}

}  // namespace hinge::oracle
