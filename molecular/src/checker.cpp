// SPDX-License-Identifier: BSD-3-Clause
// The one place where the molecular hierarchies are instantiated.
#include "hinge/molecular/checker.hpp"

#include <algorithm>

#include "hinge/core/error.hpp"

namespace hinge::molecular {

namespace {

std::vector<Point> as_points(std::span<const Vec3> positions) {
  std::vector<Point> points;
  points.reserve(positions.size());
  for (const Vec3& x : positions) points.push_back(Point{x});
  return points;
}

std::vector<std::pair<PrimitiveId, PrimitiveId>> pairs_of(const std::vector<Hit>& hits) {
  std::vector<std::pair<PrimitiveId, PrimitiveId>> pairs;
  for (const Hit& hit : hits) pairs.emplace_back(hit.first, hit.second);
  return pairs;
}

}  // namespace

Checker::Checker(std::shared_ptr<const Molecule> molecule, DofSelection selection, const CheckOptions& options)
    : molecule_(std::move(molecule)) {
  thresholds_ = std::make_shared<const Thresholds>(make_thresholds(molecule_->structure(), options.thresholds));
  min_bonds_ = options.min_bonds.value_or(thresholds_->set->default_min_bonds);
  exclusions_ = std::make_shared<const BondExclusions>(molecule_->structure(), min_bonds_);

  MolecularHierarchy<Wide> rigid(molecule_->model(), molecule_->select({}), *exclusions_, thresholds_->matrix);
  rigid.update_placed(as_points(molecule_->structure().models.front()));
  reference_ = std::make_shared<const std::vector<Hit>>(rigid.self_collisions());
  if (options.exempt_reference)
    exclusions_ = std::make_shared<const BondExclusions>(molecule_->structure(), min_bonds_, pairs_of(*reference_));

  hierarchy_.emplace(make(options.engine, std::move(selection)));
  std::vector<Hit> constant;
  std::visit(
      [&](const auto& hierarchy) {
        for (const Hit& hit : *reference_)
          if (exclusions_->admits(hit.first, hit.second) && hierarchy.model().constant(hit.first, hit.second))
            constant.push_back(hit);
      },
      *hierarchy_);
  constant_ = std::make_shared<const std::vector<Hit>>(std::move(constant));
}

Checker::AnyHierarchy Checker::make(const std::string& engine, DofSelection selection) const {
  if (engine == "wide")
    return MolecularHierarchy<Wide>(molecule_->model(), std::move(selection), *exclusions_, thresholds_->matrix);
  if (engine == "lazy")
    return MolecularHierarchy<Lazy>(molecule_->model(), std::move(selection), *exclusions_, thresholds_->matrix);
  if (engine == "brute")
    return MolecularHierarchy<Brute>(molecule_->model(), std::move(selection), *exclusions_, thresholds_->matrix);
  throw ModelError("engine '" + engine + "': expected wide, lazy or brute");
}

std::size_t Checker::dof_count() const {
  return std::visit([](const auto& hierarchy) { return hierarchy.dof_count(); }, *hierarchy_);
}

std::size_t Checker::rigid_group_count() const {
  return std::visit([](const auto& hierarchy) { return hierarchy.model().groups()->size(); }, *hierarchy_);
}

GroupId Checker::group_of(std::uint32_t atom) const {
  return std::visit([&](const auto& hierarchy) { return hierarchy.model().group_of(id<PrimitiveId>(atom)); },
                    *hierarchy_);
}

bool Checker::constant(std::uint32_t i, std::uint32_t j) const {
  return std::visit(
      [&](const auto& hierarchy) { return hierarchy.model().constant(id<PrimitiveId>(i), id<PrimitiveId>(j)); },
      *hierarchy_);
}

Verdict Checker::check(std::span<const double> q, const Mode& mode) {
  return std::visit(
      [&](auto& hierarchy) {
        hierarchy.update(q);
        Verdict verdict = ask(mode);
        for (const Closure& closure : molecule_->model().tree().closures())
          verdict.closure_residual = std::max(
              verdict.closure_residual,
              closure_residual(closure, hierarchy.link_pose(closure.first), hierarchy.link_pose(closure.second)));
        return verdict;
      },
      *hierarchy_);
}

Verdict Checker::check_coordinates(std::span<const Vec3> positions, const Mode& mode) {
  return std::visit(
      [&](auto& hierarchy) {
        hierarchy.update_placed(as_points(positions));
        return ask(mode);
      },
      *hierarchy_);
}

Verdict Checker::ask(const Mode& mode) {
  return std::visit(
      [&](auto& hierarchy) {
        Verdict verdict;
        switch (mode.kind) {
          case Mode::Kind::any: verdict.collides = hierarchy.self_collides(); break;
          case Mode::Kind::all:
            verdict.pairs = hierarchy.self_collisions();
            verdict.collides = !verdict.pairs.empty();
            break;
          case Mode::Kind::within:
            verdict.pairs = hierarchy.self_within(mode.margin);
            // A margin may list pairs that do not collide; the verdict is the strict rule's.
            verdict.collides = hierarchy.self_collides();
            break;
          case Mode::Kind::closest:
            verdict.closest = hierarchy.self_closest();
            verdict.collides = hierarchy.self_collides();
            break;
        }
        return verdict;
      },
      *hierarchy_);
}

std::vector<Vec3> Checker::positions() {
  return std::visit(
      [](auto& hierarchy) {
        std::vector<Vec3> positions;
        for (const Point& point : hierarchy.placed()) positions.push_back(point.position);
        return positions;
      },
      *hierarchy_);
}

}  // namespace hinge::molecular
