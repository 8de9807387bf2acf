// SPDX-License-Identifier: BSD-3-Clause
// Divides atoms into rigid bodies between torsions, and accumulates statistics over conformations.
#include "hinge/molecular/ensemble_spread.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

#include "hinge/core/error.hpp"
#include "hinge/core/id.hpp"
#include "hinge/detail/core/elementary.hpp"
#include "hinge/detail/core/sincos.hpp"
#include "hinge/molecular/fit_torsions.hpp"

namespace hinge::molecular {

namespace {

/// Atoms farther than this (angstrom) from the line through two others determine the rotation of a body about that
/// line. Atoms bonded at the usual angles are at least 0.8 from it.
constexpr double off_line = 0.3;

double squared_distance_from_line(const Vec3& x, const Vec3& a, const Vec3& b) {
  const Vec3 along = b - a;
  return squared_norm(cross(along, Vec3(x - a))) / squared_norm(along);
}

/// Returns the index of the pair i < j.
std::size_t at(std::size_t i, std::size_t j) noexcept { return j * (j - 1) / 2 + i; }

}  // namespace

TorsionBodies::TorsionBodies(const Molecule& molecule, std::span<const std::size_t> torsions)
    : joined_(torsions.size()) {
  const KinematicTree& tree = molecule.model().tree();
  std::vector<std::size_t> position(tree.dof_count(), torsions.size());
  for (std::size_t k = 0; k < torsions.size(); ++k) position[index(molecule.dof(torsions[k]))] = k;
  // Each link attached to the world starts a new body: no torsion joins it to another.
  std::vector<std::uint32_t> body(tree.link_count(), 0);
  for (std::size_t l = 1; l < tree.link_count(); ++l) {
    const LinkId link = id<LinkId>(l), parent = tree.parent(link);
    const std::size_t k = tree.joint(link).has_dof() ? position[index(tree.dof_of(link))] : torsions.size();
    const bool starts = parent == world || k < torsions.size();
    body[l] = starts ? static_cast<std::uint32_t>(size_++) : body[index(parent)];
    if (k < torsions.size()) joined_[k] = {body[index(parent)], body[l]};
  }
  const std::span<const LinkId> links = molecule.model().links();
  for (const LinkId link : links) of_atom_.push_back(body[index(link)]);

  points_.resize(size_);
  for (std::size_t k = 0; k < torsions.size(); ++k)
    for (const std::uint32_t b : joined_[k])
      for (const std::uint32_t atom :
           {molecule.torsions()[torsions[k]].atoms[1], molecule.torsions()[torsions[k]].atoms[2]})
        if (std::find(points_[b].begin(), points_[b].end(), atom) == points_[b].end()) points_[b].push_back(atom);
  const std::vector<Vec3>& x = molecule.structure().models.front();
  std::vector<std::vector<std::uint32_t>> atoms(size_);
  for (std::uint32_t atom = 0; atom < of_atom_.size(); ++atom) atoms[of_atom_[atom]].push_back(atom);
  for (std::size_t b = 0; b < size_; ++b) {
    std::vector<std::uint32_t>& points = points_[b];
    // A body without torsions gets its first atom and the atom farthest from it, which define a line.
    const auto farthest = [&](const auto& measure) {
      return *std::max_element(atoms[b].begin(), atoms[b].end(),
                               [&](std::uint32_t i, std::uint32_t j) { return measure(i) < measure(j); });
    };
    if (points.empty() && !atoms[b].empty()) {
      points.push_back(atoms[b].front());
      if (atoms[b].size() > 1)
        points.push_back(farthest([&](std::uint32_t i) { return squared_norm(Vec3(x[i] - x[points[0]])); }));
    }
    if (points.size() < 2 || atoms[b].empty()) continue;
    const auto aside = [&](std::uint32_t i) { return squared_distance_from_line(x[i], x[points[0]], x[points[1]]); };
    if (std::none_of(points.begin(), points.end(), [&](std::uint32_t i) { return aside(i) > off_line * off_line; }))
      if (const std::uint32_t third = farthest(aside); aside(third) > 0.0) points.push_back(third);
  }
}

EnsembleSpread::EnsembleSpread(const Molecule& molecule, std::span<const std::size_t> torsions)
    : molecule_(molecule),
      torsions_(torsions.begin(), torsions.end()),
      bodies_(molecule, torsions),
      cosines_(torsions.size()),
      sines_(torsions.size()) {
  std::vector<std::uint32_t> position(bodies_.of_atom().size(), std::numeric_limits<std::uint32_t>::max());
  points_of_.resize(bodies_.size());
  for (std::size_t b = 0; b < bodies_.size(); ++b)
    for (const std::uint32_t atom : bodies_.points(b)) {
      if (position[atom] == std::numeric_limits<std::uint32_t>::max()) {
        position[atom] = static_cast<std::uint32_t>(points_.size());
        points_.push_back(atom);
      }
      points_of_[b].push_back(position[atom]);
    }
  if (points_.size() > most_points)
    throw ModelError("rigid groups of an ensemble: the axes of " + std::to_string(torsions.size()) + " torsions have " +
                     std::to_string(points_.size()) + " atoms, expected at most " + std::to_string(most_points) +
                     "; select fewer torsions");
  mean_.resize(at(0, points_.size()));
  squares_.resize(mean_.size());
}

void EnsembleSpread::add(std::span<const Vec3> positions) {
  for (std::size_t k = 0; k < torsions_.size(); ++k) {
    const detail::SinCos turn = detail::sincos(turn_of(molecule_, torsions_[k], positions));
    cosines_[k] += turn.cos;
    sines_[k] += turn.sin;
  }
  const float share = 1.0F / static_cast<float>(++count_);
  std::size_t pair = 0;
  for (std::size_t j = 1; j < points_.size(); ++j) {
    const Vec3& x = positions[points_[j]];
    for (std::size_t i = 0; i < j; ++i, ++pair) {
      const auto distance = static_cast<float>(norm(Vec3(positions[points_[i]] - x)));
      const float off = distance - mean_[pair];
      mean_[pair] += share * off;
      squares_[pair] += off * (distance - mean_[pair]);
    }
  }
}

double EnsembleSpread::circular_std(std::size_t k) const noexcept {
  const double n = static_cast<double>(count_);
  const double squared = (cosines_[k] * cosines_[k] + sines_[k] * sines_[k]) / (n * n);
  return std::isnormal(squared) ? std::sqrt(std::max(0.0, -detail::log(squared)))
                                : std::numeric_limits<double>::infinity();
}

double EnsembleSpread::distance_spread(std::size_t first, std::size_t second) const noexcept {
  float most = 0.0F;
  for (const std::uint32_t i : points_of_[first])
    for (const std::uint32_t j : points_of_[second])
      if (i != j) most = std::max(most, squares_[at(std::min(i, j), std::max(i, j))]);
  return std::sqrt(static_cast<double>(most) / static_cast<double>(count_));
}

}  // namespace hinge::molecular
