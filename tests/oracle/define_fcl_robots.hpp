// SPDX-License-Identifier: BSD-3-Clause
// Definitions for fcl_robots.hpp, included by the two files that compile FCL: with Debian's flags, and for this CPU.
#pragma once

#include <fcl/broadphase/broadphase_dynamic_AABB_tree.h>
#include <fcl/geometry/bvh/BVH_model.h>
#include <fcl/math/bv/OBBRSS.h>
#include <fcl/narrowphase/collision.h>
#include <fcl/narrowphase/distance.h>

#include <algorithm>
#include <memory>
#include <utility>
#include <vector>

#include "oracle/fcl_robots.hpp"
#include "oracle/fcl_transform.hpp"

namespace hinge::oracle {

namespace {

using Object = fcl::CollisionObject<double>;
using Tree = fcl::BVHModel<fcl::OBBRSS<double>>;
using Transforms = std::vector<fcl::Transform3d, Eigen::aligned_allocator<fcl::Transform3d>>;
using Manager = fcl::DynamicAABBTreeCollisionManager<double>;

inline std::shared_ptr<Tree> filled(std::span<const Mesh> meshes) {
  std::size_t triangles = 0;
  for (const Mesh& mesh : meshes) triangles += mesh.size();
  auto tree = std::make_shared<Tree>();
  tree->beginModel(static_cast<int>(triangles), static_cast<int>(3 * triangles));
  for (const Mesh& mesh : meshes)
    for (const auto& t : mesh) tree->addTriangle({t[0], t[1], t[2]}, {t[3], t[4], t[5]}, {t[6], t[7], t[8]});
  return tree;
}
inline std::shared_ptr<Tree> built(std::span<const Mesh> meshes) {
  auto tree = filled(meshes);
  tree->endModel();
  return tree;
}

template <class A, class B>
bool touch(const A& a, const B& b) {
  const fcl::CollisionRequest<double> request;  // asks for one contact, without computing its geometry
  fcl::CollisionResult<double> result;
  return fcl::collide(a, b, request, result) > 0;
}
inline bool touch(const Tree* a, const fcl::Transform3d& at_a, const Tree* b, const fcl::Transform3d& at_b) {
  const fcl::CollisionRequest<double> request;
  fcl::CollisionResult<double> result;
  return fcl::collide(a, at_a, b, at_b, request, result) > 0;
}
inline double gap(const Tree* a, const fcl::Transform3d& at_a, const Tree* b, const fcl::Transform3d& at_b) {
  const fcl::DistanceRequest<double> request;
  fcl::DistanceResult<double> result;
  return fcl::distance(a, at_a, b, at_b, request, result);
}

}  // namespace

template <FclBuild build>
struct FclTrees<build>::Impl {
  std::vector<std::shared_ptr<Tree>> trees;
};

template <FclBuild b>
FclTrees<b>::FclTrees(std::span<const Mesh> meshes) : impl_(std::make_unique<Impl>()) {
  for (const Mesh& mesh : meshes)
    if (!mesh.empty()) impl_->trees.push_back(filled({&mesh, 1}));
}
template <FclBuild build>
FclTrees<build>::FclTrees(FclTrees&&) noexcept = default;
template <FclBuild build>
FclTrees<build>::~FclTrees() = default;

template <FclBuild b>
void FclTrees<b>::build() {
  for (const auto& tree : impl_->trees) tree->endModel();
}

template <FclBuild build>
struct FclScene<build>::Impl {
  std::shared_ptr<Tree> whole;
  fcl::Transform3d at = fcl::Transform3d::Identity();
  std::vector<std::unique_ptr<Object>> objects;
  Manager manager;
};

template <FclBuild build>
FclScene<build>::FclScene(std::span<const Mesh> objects) : impl_(std::make_unique<Impl>()) {
  impl_->whole = built(objects);
  for (const Mesh& object : objects) {
    impl_->objects.push_back(std::make_unique<Object>(built({&object, 1})));
    impl_->manager.registerObject(impl_->objects.back().get());
  }
  impl_->manager.setup();
}
template <FclBuild build>
FclScene<build>::FclScene(FclScene&&) noexcept = default;
template <FclBuild build>
FclScene<build>::~FclScene() = default;

template <FclBuild build>
void FclScene<build>::place(const Placement& at) {
  impl_->at = transform(at);
  for (const auto& object : impl_->objects) {
    object->setTransform(impl_->at);
    object->computeAABB();
  }
  impl_->manager.update();
}

template <FclBuild build>
struct FclRobot<build>::Impl {
  std::size_t count = 0;
  std::vector<std::shared_ptr<Tree>> trees;  // by link; null if the link has no triangles
  std::vector<Transforms> postures;
  const fcl::Transform3d* at = nullptr;  // link poses of the current posture
  Pairs tested;
  std::vector<bool> counts;  // by link pair: is it tested?
  std::vector<std::unique_ptr<Object>> objects;
  std::vector<std::size_t> link_of;  // user data of the objects points into this
  std::vector<std::size_t> with_mesh;
  Manager manager;

  struct Found {
    Impl* robot;
    Pairs* pairs;  // null: stop at the first pair
    bool any = false;
  };
  struct Nearest {
    Impl* robot;
    bool shared;
    fcl::DistanceResult<double> result{};
  };

  static std::size_t link(const Object* object) { return *static_cast<const std::size_t*>(object->getUserData()); }
  bool asked(std::size_t i, std::size_t j) const { return counts[i * count + j]; }

  static bool on_pair(Object* a, Object* b, void* data) {
    Found& found = *static_cast<Found*>(data);
    const std::size_t i = std::min(link(a), link(b)), j = std::max(link(a), link(b));
    if (!found.robot->asked(i, j) || !touch(a, b)) return false;
    found.any = true;
    if (found.pairs == nullptr) return true;
    found.pairs->emplace_back(i, j);
    return false;
  }
  static bool on_near_pair(Object* a, Object* b, void* data, double& bound) {
    Nearest& nearest = *static_cast<Nearest*>(data);
    if (nearest.robot->asked(std::min(link(a), link(b)), std::max(link(a), link(b)))) {
      const double before = nearest.result.min_distance;
      if (!nearest.shared) nearest.result.clear();
      fcl::distance(a, b, fcl::DistanceRequest<double>(), nearest.result);
      nearest.result.min_distance = std::min(nearest.result.min_distance, before);
    }
    bound = nearest.result.min_distance;
    return bound <= 0.0;
  }
  static bool on_scenery(Object* a, Object* b, void* data) {
    bool& hit = *static_cast<bool*>(data);
    hit = hit || touch(a, b);
    return hit;
  }

  void move(std::size_t l) {
    objects[l]->setTransform(at[l]);
    objects[l]->computeAABB();
  }
  void update() {
    for (const std::size_t l : with_mesh) move(l);
    manager.update();
  }
  bool touching(std::size_t i, std::size_t j) const { return touch(trees[i].get(), at[i], trees[j].get(), at[j]); }
};

template <FclBuild build>
FclRobot<build>::FclRobot(std::span<const Mesh> links, const Pairs& tested) : impl_(std::make_unique<Impl>()) {
  Impl& robot = *impl_;
  robot.count = links.size();
  robot.tested = tested;
  robot.counts.assign(links.size() * links.size(), false);
  for (const auto& [i, j] : tested) robot.counts[std::min(i, j) * links.size() + std::max(i, j)] = true;
  robot.postures.emplace_back(links.size(), fcl::Transform3d::Identity());
  robot.at = robot.postures.front().data();
  for (std::size_t l = 0; l < links.size(); ++l) robot.link_of.push_back(l);
  for (std::size_t l = 0; l < links.size(); ++l) {
    robot.trees.push_back(links[l].empty() ? nullptr : built(links.subspan(l, 1)));
    robot.objects.push_back(links[l].empty() ? nullptr : std::make_unique<Object>(robot.trees.back()));
    if (links[l].empty()) continue;
    robot.objects.back()->setUserData(&robot.link_of[l]);
    robot.with_mesh.push_back(l);
    robot.manager.registerObject(robot.objects.back().get());
  }
  robot.manager.setup();
}
template <FclBuild build>
FclRobot<build>::FclRobot(FclRobot&&) noexcept = default;
template <FclBuild build>
FclRobot<build>::~FclRobot() = default;

template <FclBuild build>
void FclRobot<build>::set_postures(std::span<const std::vector<Placement>> postures) {
  impl_->postures.clear();
  for (const auto& links : postures) {
    Transforms& at = impl_->postures.emplace_back();
    for (const Placement& link : links) at.push_back(transform(link));
  }
  impl_->at = impl_->postures.front().data();
}
template <FclBuild build>
void FclRobot<build>::take(std::size_t posture) noexcept {
  impl_->at = impl_->postures[posture].data();
}

template <FclBuild build>
bool FclRobot<build>::any(FclManner manner) {
  if (manner == FclManner::loop)
    return std::any_of(impl_->tested.begin(), impl_->tested.end(),
                       [&](const auto& pair) { return impl_->touching(pair.first, pair.second); });
  impl_->update();
  typename Impl::Found found{impl_.get(), nullptr};
  impl_->manager.collide(&found, &Impl::on_pair);
  return found.any;
}

template <FclBuild build>
void FclRobot<build>::all(FclManner manner, Pairs& pairs) {
  pairs.clear();
  if (manner == FclManner::loop) {
    for (const auto& [i, j] : impl_->tested)
      if (impl_->touching(i, j)) pairs.emplace_back(std::min(i, j), std::max(i, j));
    return;
  }
  impl_->update();
  typename Impl::Found found{impl_.get(), &pairs};
  impl_->manager.collide(&found, &Impl::on_pair);
}

template <FclBuild build>
double FclRobot<build>::distance(FclManner manner) {
  typename Impl::Nearest nearest{impl_.get(), manner != FclManner::unshared};
  if (manner != FclManner::loop) {
    impl_->update();
    impl_->manager.distance(&nearest, &Impl::on_near_pair);
    return nearest.result.min_distance;
  }
  for (const auto& [i, j] : impl_->tested) {
    fcl::distance(impl_->trees[i].get(), impl_->at[i], impl_->trees[j].get(), impl_->at[j],
                  fcl::DistanceRequest<double>(), nearest.result);
    if (nearest.result.min_distance <= 0.0) break;
  }
  return nearest.result.min_distance;
}

template <FclBuild build>
bool FclRobot<build>::hits(const FclScene<build>& scene, FclManner manner) {
  if (manner == FclManner::loop)
    return std::any_of(impl_->with_mesh.begin(), impl_->with_mesh.end(), [&](std::size_t l) { return hits(scene, l); });
  bool hit = false;
  for (const std::size_t l : impl_->with_mesh) {
    impl_->move(l);
    scene.impl().manager.collide(impl_->objects[l].get(), &hit, &Impl::on_scenery);
    if (hit) return true;
  }
  return false;
}

template <FclBuild build>
bool FclRobot<build>::collide(std::size_t i, std::size_t j) const {
  return impl_->touching(i, j);
}
template <FclBuild build>
double FclRobot<build>::distance(std::size_t i, std::size_t j) const {
  return gap(impl_->trees[i].get(), impl_->at[i], impl_->trees[j].get(), impl_->at[j]);
}
template <FclBuild build>
bool FclRobot<build>::hits(const FclScene<build>& scene, std::size_t link) const {
  return touch(impl_->trees[link].get(), impl_->at[link], scene.impl().whole.get(), scene.impl().at);
}
template <FclBuild build>
double FclRobot<build>::distance(const FclScene<build>& scene, std::size_t link) const {
  return gap(impl_->trees[link].get(), impl_->at[link], scene.impl().whole.get(), scene.impl().at);
}

}  // namespace hinge::oracle
