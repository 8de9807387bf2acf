// SPDX-License-Identifier: BSD-3-Clause
// Instantiates the molecular hierarchies, in this file only.
#include "hinge/molecular/checker.hpp"

#include <algorithm>

#include "hinge/core/error.hpp"
#include "hinge/detail/model/out_of_reach.hpp"
#include "hinge/detail/primitive/grid_point.hpp"
#include "hinge/policy/collector.hpp"

namespace hinge::molecular {

namespace {

std::vector<Point> as_points(std::span<const Vec3> positions) {
  std::vector<Point> points;
  points.reserve(positions.size());
  for (const Vec3& x : positions) points.push_back(Point{x});
  return points;
}

/// Returns the pairs inside residues if the rules exclude them, otherwise nothing.
std::vector<std::pair<PrimitiveId, PrimitiveId>> never_counted(const Structure& structure, const ClashRules& rules) {
  std::vector<std::pair<PrimitiveId, PrimitiveId>> pairs;
  if (rules.inside_residues) return pairs;
  for (const Residue& residue : structure.residues)
    for (std::uint32_t i = residue.first_atom; i < residue.last_atom; ++i)
      for (std::uint32_t j = i + 1; j < residue.last_atom; ++j)
        pairs.emplace_back(id<PrimitiveId>(i), id<PrimitiveId>(j));
  return pairs;
}

/// Returns the hits that are exempt. Without `interfaces`, both atoms of an exempt pair come from the same file and the
/// same placed part: contacts between files or with a placed part come from the arrangement, not from the molecule.
std::vector<std::pair<PrimitiveId, PrimitiveId>> exempt_pairs(const Molecule& molecule, const std::vector<Hit>& hits,
                                                              bool interfaces) {
  const Structure& s = molecule.structure();
  // Per atom: its file, and 1 + the index of its placed part, or 0.
  std::vector<std::pair<std::uint32_t, std::size_t>> body(s.atoms.size());
  for (std::size_t i = 0; i < body.size(); ++i) body[i].first = s.chains[s.residues[s.atoms[i].residue].chain].file;
  for (std::size_t k = 0; k < molecule.placed_parts().size(); ++k) {
    const std::vector<bool> in = atoms_in(s, molecule.placed_parts()[k].part);
    for (std::size_t i = 0; i < body.size(); ++i)
      if (in[i]) body[i].second = k + 1;
  }
  std::vector<std::pair<PrimitiveId, PrimitiveId>> pairs;
  for (const Hit& hit : hits)
    if (interfaces || body[index(hit.first)] == body[index(hit.second)]) pairs.emplace_back(hit.first, hit.second);
  return pairs;
}

/// Decides whether a pair is closer than a distance, in decimals or in doubles.
struct Rule {
  bool as_written = false;  ///< decimals where there are three (closer_as_written); otherwise doubles
  double largest = 0.0;     ///< largest threshold, angstrom

  /// Returns by how much the distance of a pair, as a double, can exceed its threshold although the pair is closer in
  /// decimals (angstrom). Coordinates on the grid are below 2^31 and off by at most 2^-23, so distances are off by at
  /// most 2^-21. Thresholds are at most 17 half ulps from their decimals, and three sums are rounded.
  double hair(double margin) const noexcept { return as_written ? 0x1p-20 + 32 * 0x1p-53 * (largest + margin) : 0.0; }
  bool closer(const Point& p, const Point& q, double m) const noexcept {
    return as_written ? detail::closer_as_written(p, q, m) : closer_than(p, q, m);
  }
};

Rule as_written(const Thresholds& thresholds) {
  Rule rule{true, 0.0};
  for (const double m : thresholds.table) rule.largest = std::max(rule.largest, m);
  return rule;
}

/// Returns the pairs with d < M + margin, sorted.
template <class H>
std::vector<Contact> contacts(H& hierarchy, const Rule& rule, double margin) {
  const std::vector<Hit> hits = hierarchy.self_within(margin + rule.hair(margin));
  std::vector<Contact> found;
  found.reserve(hits.size());
  if (!rule.as_written && margin == 0.0) {  // the query has decided them
    for (const Hit& hit : hits) found.push_back({hit, true});
    return found;
  }
  const std::span<const Point> placed = hierarchy.placed();
  for (const Hit& hit : hits) {
    const Point &p = placed[index(hit.first)], &q = placed[index(hit.second)];
    const bool collides = rule.closer(p, q, hit.threshold);
    if (collides || rule.closer(p, q, hit.threshold + margin)) found.push_back({hit, collides});
  }
  return found;
}

/// Returns the closest pair; if any pair collides, the closest colliding pair. Two pairs can have the same gap in
/// doubles although only one of them collides in decimals.
template <class H>
std::optional<Contact> closest(H& hierarchy, const Rule& rule) {
  const std::optional<Hit> hit = hierarchy.self_closest();
  if (!hit) return std::nullopt;
  const std::span<const Point> placed = hierarchy.placed();
  if (rule.closer(placed[index(hit->first)], placed[index(hit->second)], hit->threshold)) return Contact{*hit, true};
  const std::vector<Contact> colliding = contacts(hierarchy, rule, 0.0);
  if (colliding.empty()) return Contact{*hit, false};
  return *std::min_element(colliding.begin(), colliding.end(),
                           [](const Contact& a, const Contact& b) { return a.hit.gap() < b.hit.gap(); });
}

/// Collects a verdict decided in decimals; stops at the first pair that collides.
class AnyAsWritten {
 public:
  static constexpr bool ranks = false;
  AnyAsWritten(const Rule& rule, std::span<const Point> placed) : rule_(rule), placed_(placed) {}
  void add(const Hit& hit) noexcept {
    hit_ = hit_ || rule_.closer(placed_[index(hit.first)], placed_[index(hit.second)], hit.threshold);
  }
  double cutoff() const noexcept { return rule_.hair(0.0); }
  bool done() const noexcept { return hit_; }

 private:
  const Rule& rule_;
  std::span<const Point> placed_;
  bool hit_ = false;
};

template <class H>
bool any(H& hierarchy, const Rule& rule) {
  if (!rule.as_written) return hierarchy.self_collides();
  AnyAsWritten collector(rule, hierarchy.placed());
  hierarchy.self_query(collector);
  return collector.done();
}

template <class H>
Verdict ask(H& hierarchy, const Rule& rule, const Mode& mode) {
  Verdict verdict;
  switch (mode.kind) {
    case Mode::Kind::any: verdict.collides = any(hierarchy, rule); break;
    case Mode::Kind::all:
    case Mode::Kind::within:
      verdict.pairs = contacts(hierarchy, rule, mode.margin);
      verdict.collides =
          std::any_of(verdict.pairs.begin(), verdict.pairs.end(), [](const Contact& c) { return c.collides; });
      break;
    case Mode::Kind::closest:
      verdict.closest = closest(hierarchy, rule);
      verdict.collides = verdict.closest && verdict.closest->collides;
      break;
  }
  return verdict;
}

}  // namespace

Checker::Checker(std::shared_ptr<const Molecule> molecule, DofSelection selection, const CheckOptions& options)
    : molecule_(std::move(molecule)) {
  if (molecule_ == nullptr) throw ModelError("checker: expected a molecule, got none");
  ThresholdOptions chosen = options.thresholds;
  if (chosen.rules == "auto" && options.min_bonds) chosen.rules = "biocd";  // min_bonds belongs to these rules
  thresholds_ = std::make_shared<const Thresholds>(make_thresholds(molecule_->structure(), chosen));
  if (options.min_bonds && thresholds_->rules->name != "biocd")
    throw ModelError("clash rules " + options.thresholds.rules +
                     " set the minimal bond distance themselves, expected no option for it");
  min_bonds_ = options.min_bonds ? MinBonds(*options.min_bonds) : thresholds_->min_bonds;
  auto exempt = never_counted(molecule_->structure(), *thresholds_->rules);
  exclusions_ = std::make_shared<const BondExclusions>(molecule_->structure(), min_bonds_, exempt, options.scope);

  MolecularHierarchy<Simd> rigid(molecule_->model(), molecule_->select({}), *exclusions_, thresholds_->matrix);
  rigid.update_placed(as_points(molecule_->structure().models.front()));
  std::vector<Hit> reference;
  for (const Contact& contact : contacts(rigid, as_written(*thresholds_), 0.0)) reference.push_back(contact.hit);
  reference_ = std::make_shared<const std::vector<Hit>>(std::move(reference));
  if (options.exempt_reference) {
    const auto collisions = exempt_pairs(*molecule_, *reference_, options.exempt_interfaces);
    exempt.insert(exempt.end(), collisions.begin(), collisions.end());
    exclusions_ = std::make_shared<const BondExclusions>(molecule_->structure(), min_bonds_, exempt, options.scope);
  }

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
  if (engine == "simd")
    return MolecularHierarchy<Simd>(molecule_->model(), std::move(selection), *exclusions_, thresholds_->matrix);
  if (engine == "lazy")
    return MolecularHierarchy<Lazy>(molecule_->model(), std::move(selection), *exclusions_, thresholds_->matrix);
  if (engine == "brute")
    return MolecularHierarchy<Brute>(molecule_->model(), std::move(selection), *exclusions_, thresholds_->matrix);
  throw ModelError("engine '" + engine + "': expected simd, lazy or brute");
}

const DofSelection& Checker::selection() const {
  return std::visit([](const auto& hierarchy) -> const DofSelection& { return hierarchy.model().selection(); },
                    *hierarchy_);
}

std::size_t Checker::dof_count() const {
  return std::visit([](const auto& hierarchy) { return hierarchy.dof_count(); }, *hierarchy_);
}

const RigidGroups& Checker::rigid_groups() const {
  return std::visit([](const auto& hierarchy) -> const RigidGroups& { return *hierarchy.model().groups(); },
                    *hierarchy_);
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

std::vector<std::uint32_t> Checker::out_of_reach() const {
  const std::vector<std::uint8_t> flags = std::visit(
      [&](const auto& hierarchy) { return detail::out_of_reach(hierarchy.model(), thresholds_->matrix); }, *hierarchy_);
  std::vector<std::uint32_t> atoms;
  for (std::uint32_t i = 0; i < flags.size(); ++i)
    if (flags[i] != 0) atoms.push_back(i);
  return atoms;
}

Verdict Checker::check(std::span<const double> q, const Mode& mode) {
  return std::visit(
      [&](auto& hierarchy) {
        hierarchy.update(q);
        Verdict verdict = ask(hierarchy, Rule{}, mode);
        for (const Closure& closure : molecule_->model().tree().closures()) {
          verdict.closure_residuals.push_back(
              closure_residual(closure, hierarchy.link_pose(closure.first), hierarchy.link_pose(closure.second)));
          verdict.closure_residual = std::max(verdict.closure_residual, verdict.closure_residuals.back());
        }
        return verdict;
      },
      *hierarchy_);
}

bool Checker::collides_in(std::span<const double> q, GroupRange groups) {
  return std::visit(
      [&](auto& hierarchy) {
        hierarchy.update(q);
        return hierarchy.self_collides({.groups = groups});
      },
      *hierarchy_);
}

std::vector<Hit> Checker::collisions_in(GroupRange groups) const {
  return std::visit([&](const auto& hierarchy) { return hierarchy.self_collisions({.groups = groups}); }, *hierarchy_);
}

Verdict Checker::check_coordinates(std::span<const Vec3> positions, const Mode& mode) {
  return std::visit(
      [&](auto& hierarchy) {
        hierarchy.update_placed(as_points(positions));
        return ask(hierarchy, as_written(*thresholds_), mode);
      },
      *hierarchy_);
}

Vec3 Checker::position(std::uint32_t atom) const {
  return std::visit([&](const auto& hierarchy) { return hierarchy.placed(id<PrimitiveId>(atom)).position; },
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
