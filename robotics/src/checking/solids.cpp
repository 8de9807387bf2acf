// SPDX-License-Identifier: BSD-3-Clause
// Implements Solids. Connected components are found per link when first needed: for large meshes this costs as much as
// building a tree.
#include "checking/solids.hpp"

#include <algorithm>
#include <array>
#include <utility>

#include "hinge/bounds/aabb.hpp"
#include "hinge/robotics/containment.hpp"

namespace hinge::robotics {

namespace {

BoundingBall around(const Aabb& box) {
  if (box.is_empty()) return {};
  const Vec3 centre(box.middle(0), box.middle(1), box.middle(2));
  return {centre, norm(Vec3(box.upper - centre)) * (1.0 + 1e-9)};
}

}  // namespace

Solids::Solids(Model<Triangle> model, std::vector<Solid> solids)
    : model_(std::move(model)),
      solids_(std::move(solids)),
      first_(model_.tree().link_count() + 1, 0),
      first_solid_(first_.size(), 0),
      asked_(std::make_unique<std::once_flag[]>(first_.size())),
      parts_(first_.size()) {
  for (const LinkId link : model_.links()) ++first_[index(link) + 1];
  for (const Solid& solid : solids_) ++first_solid_[index(solid.link) + 1];
  for (std::size_t l = 1; l < first_.size(); ++l) {
    first_[l] += first_[l - 1];
    first_solid_[l] += first_solid_[l - 1];
  }
}

std::span<const SolidPart> Solids::parts(LinkId link) const {
  std::call_once(asked_[index(link)], [&] {
    const std::span<const Triangle> mesh = triangles(link);
    const std::vector<std::size_t> part_of = part_numbers(mesh);
    std::vector<Aabb> boxes(mesh.size());
    std::vector<double> farthest(mesh.size(), 0.0);
    for (std::size_t k = 0; k < mesh.size(); ++k) {
      const std::size_t part = part_of[k];
      boxes[part].extend(mesh[k].bounds());
      for (const Vec3& corner : {mesh[k].a, mesh[k].b, mesh[k].c})
        farthest[part] = std::max(farthest[part], norm(Vec3(corner - mesh[part].a)));
    }
    std::vector<SolidPart>& found = parts_[index(link)];
    for (std::size_t k = 0; k < mesh.size(); ++k) {
      if (part_of[k] != k) continue;
      const double extent = std::max({boxes[k].length(0), boxes[k].length(1), boxes[k].length(2), farthest[k]});
      found.push_back({id<PrimitiveId>(first_[index(link)] + k), mesh[k].a, extent});
    }
  });
  return parts_[index(link)];
}

bool Solids::has_many_triangles(LinkId link) const noexcept {
  constexpr std::size_t many = 1024;
  return triangles(link).size() > many;
}

bool Solids::may_hold_any(const Solid& solid, LinkId link) const {
  if (has_many_triangles(link)) return true;
  const std::span<const SolidPart> all = parts(link);
  return std::any_of(all.begin(), all.end(), [&](const SolidPart& part) { return may_hold(solid, part); });
}

BoundingBall Solids::points(LinkId link) const {
  const std::span<const Triangle> mesh = triangles(link);
  Aabb box;
  if (has_many_triangles(link)) {
    for (const Triangle& triangle : mesh) box.extend(triangle.bounds());
  } else {
    for (const SolidPart& part : parts(link)) box.extend(part.point);
  }
  return around(box);
}

}  // namespace hinge::robotics
