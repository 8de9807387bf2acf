// SPDX-License-Identifier: BSD-3-Clause
// Joins rigid bodies to segments along torsions, and segments to groups through space.
#include "hinge/molecular/ensemble_groups.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <set>
#include <string>
#include <tuple>
#include <utility>

#include "hinge/core/error.hpp"
#include "hinge/core/finite.hpp"
#include "hinge/core/number_text.hpp"

namespace hinge::molecular {

namespace {

/// Distance (angstrom) from a torsion's axis to atoms bonded to it: a C-C bond of 1.53 at the tetrahedral angle. The
/// circular standard deviation times this length is the motion of the smallest body at that axis, even if its distances
/// hardly change.
constexpr double beside_axis = 1.44;

/// Disjoint sets of bodies; the distances between all bodies of a set vary by at most the tolerance.
class RigidSets {
 public:
  RigidSets(const EnsembleSpread& spread, double tolerance) : tolerance_(tolerance), set_of_(spread.bodies().size()) {
    const std::size_t n = set_of_.size();
    std::iota(set_of_.begin(), set_of_.end(), 0U);
    members_.resize(n);
    for (std::size_t b = 0; b < n; ++b) members_[b] = {static_cast<std::uint32_t>(b)};
    spread_.reserve(n * (n + 1) / 2);
    for (std::size_t b = 0; b < n; ++b)
      for (std::size_t a = 0; a <= b; ++a) spread_.push_back(static_cast<float>(spread.distance_spread(a, b)));
  }

  std::uint32_t set_of(std::size_t body) const noexcept { return set_of_[body]; }
  const std::vector<std::uint32_t>& members(std::size_t set) const noexcept { return members_[set]; }
  /// Returns the largest standard deviation (angstrom) of a distance between a point of one set and a point of the
  /// other.
  float spread(std::size_t first, std::size_t second) const noexcept {
    float most = 0.0F;
    for (const std::uint32_t a : members_[first])
      for (const std::uint32_t b : members_[second]) most = std::max(most, of_bodies(a, b));
    return most;
  }
  void join(std::uint32_t first, std::uint32_t second) {
    if (first == second || !(static_cast<double>(spread(first, second)) <= tolerance_)) return;
    if (members_[first].size() < members_[second].size()) std::swap(first, second);
    for (const std::uint32_t b : members_[second]) set_of_[b] = first;
    members_[first].insert(members_[first].end(), members_[second].begin(), members_[second].end());
    members_[second].clear();
  }

 private:
  float of_bodies(std::uint32_t a, std::uint32_t b) const noexcept {
    const std::size_t low = std::min(a, b), high = std::max(a, b);
    return spread_[high * (high + 1) / 2 + low];
  }

  double tolerance_;
  std::vector<std::uint32_t> set_of_;                // per body
  std::vector<std::vector<std::uint32_t>> members_;  // per set; empty if it was merged into another
  std::vector<float> spread_;                        // per pair of bodies, angstrom
};

/// Segments of fewer bodies are not joined through space: small segments close together have nearly constant distances
/// even if torsions between them move. Four bodies are two residues of a backbone.
constexpr std::size_t fewest_bodies = 4;

/// Pairs of segments, the lower index first.
using SegmentPairs = std::set<std::pair<std::uint32_t, std::uint32_t>>;

/// Joins segments through space, the pair with the smallest spread first; never two sets with a moving torsion between
/// them.
void join_segments(RigidSets& sets, const std::vector<std::uint32_t>& segment_of, const SegmentPairs& turning,
                   double tolerance) {
  std::vector<std::uint32_t> segments;
  for (std::uint32_t s = 0; s < segment_of.size(); ++s)
    if (sets.members(s).size() >= fewest_bodies) segments.push_back(s);
  std::vector<std::tuple<float, std::uint32_t, std::uint32_t>> near;
  for (std::size_t j = 1; j < segments.size(); ++j)
    for (std::size_t i = 0; i < j; ++i)
      if (const float spread = sets.spread(segments[i], segments[j]); static_cast<double>(spread) <= tolerance)
        near.emplace_back(spread, segments[i], segments[j]);
  std::sort(near.begin(), near.end());
  // A segment is named by one of its bodies; set_of gives its current set, which changes as sets are merged.
  const auto apart = [&](std::uint32_t first, std::uint32_t second) {
    return std::none_of(turning.begin(), turning.end(), [&](const auto& pair) {
      const std::uint32_t a = sets.set_of(pair.first), b = sets.set_of(pair.second);
      return std::minmax(a, b) == std::minmax(first, second);
    });
  };
  for (const auto& [spread, i, j] : near) {
    const std::uint32_t first = sets.set_of(i), second = sets.set_of(j);
    if (first != second && apart(first, second)) sets.join(first, second);
  }
}

}  // namespace

std::size_t EnsembleGroup::size() const noexcept {
  std::size_t count = 0;
  for (const auto& segment : segments) count += segment.size();
  return count;
}

std::vector<std::uint32_t> EnsembleGroup::atoms() const {
  std::vector<std::uint32_t> all;
  for (const auto& segment : segments) all.insert(all.end(), segment.begin(), segment.end());
  std::sort(all.begin(), all.end());
  return all;
}

EnsembleGroups find_ensemble_groups(const EnsembleSpread& spread, double tolerance) {
  if (spread.conformations() < 2)
    throw ModelError("rigid groups of an ensemble: " + std::to_string(spread.conformations()) +
                     " conformations, expected at least two");
  if (!(tolerance > 0.0) || !is_length(tolerance))
    throw ModelError("rigid groups of an ensemble: tolerance " + number_text(tolerance) +
                     ", expected a length above 0 in angstrom");
  const TorsionBodies& bodies = spread.bodies();
  RigidSets sets(spread, tolerance);
  std::vector<std::size_t> order(spread.torsions().size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::vector<double> turns;
  for (const std::size_t k : order) turns.push_back(spread.circular_std(k));
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return turns[a] < turns[b]; });
  for (const std::size_t k : order) {
    if (!(turns[k] * beside_axis <= tolerance)) continue;
    const auto [a, b] = bodies.joined_by(k);
    sets.join(sets.set_of(a), sets.set_of(b));
  }

  EnsembleGroups found;
  std::vector<std::uint32_t> segment_of;
  SegmentPairs turning;
  for (std::size_t b = 0; b < bodies.size(); ++b) segment_of.push_back(sets.set_of(b));
  for (std::size_t k = 0; k < turns.size(); ++k) {
    const auto [a, b] = bodies.joined_by(k);
    if (segment_of[a] == segment_of[b]) continue;
    found.torsions.push_back(spread.torsions()[k]);
    found.turn_spreads.push_back(turns[k]);
    turning.insert(std::minmax(segment_of[a], segment_of[b]));
  }
  join_segments(sets, segment_of, turning, tolerance);

  std::vector<std::vector<std::uint32_t>> atoms(bodies.size());  // per segment
  for (std::uint32_t i = 0; i < bodies.of_atom().size(); ++i) atoms[segment_of[bodies.of_atom()[i]]].push_back(i);
  for (std::size_t set = 0; set < bodies.size(); ++set) {
    EnsembleGroup group;
    for (std::uint32_t b : sets.members(set))
      if (segment_of[b] == b && !atoms[b].empty()) group.segments.push_back(std::move(atoms[b]));
    if (group.segments.empty()) continue;
    std::stable_sort(group.segments.begin(), group.segments.end(), [](const auto& a, const auto& b) {
      return a.size() != b.size() ? a.size() > b.size() : a.front() < b.front();
    });
    group.spread = static_cast<double>(sets.spread(set, set));
    found.groups.push_back(std::move(group));
  }
  std::stable_sort(found.groups.begin(), found.groups.end(), [](const EnsembleGroup& a, const EnsembleGroup& b) {
    return a.size() != b.size() ? a.size() > b.size() : a.segments[0][0] < b.segments[0][0];
  });
  return found;
}

std::vector<HeldPlacement> held_placements(const Molecule& molecule, const EnsembleGroups& groups) {
  const std::vector<Vec3>& x = molecule.structure().models.front();
  // An atom on an axis belongs to one side but is bonded to the other, so it does not identify a segment.
  std::vector<bool> on_axis(x.size(), false);
  for (const Torsion& torsion : molecule.torsions()) on_axis[torsion.atoms[1]] = on_axis[torsion.atoms[2]] = true;
  const auto aside = [&](const std::vector<std::uint32_t>& segment) {
    return *std::find_if_not(segment.begin(), segment.end() - 1, [&](std::uint32_t i) { return on_axis[i]; });
  };
  std::vector<HeldPlacement> held;
  for (const EnsembleGroup& group : groups.groups)
    for (std::size_t k = 1; k < group.segments.size(); ++k) {
      const std::vector<std::uint32_t>&first = group.segments[0], &other = group.segments[k];
      // Four points far apart: two ends of a long diameter, the atom farthest from their line, and the atom farthest
      // from the plane of these three.
      const auto farthest = [&](const auto& measure) {
        std::uint32_t best = first[0];
        for (const std::vector<std::uint32_t>* atoms : {&first, &other})
          for (const std::uint32_t i : *atoms) best = measure(x[i]) > measure(x[best]) ? i : best;
        return best;
      };
      std::array<std::uint32_t, 4> p{};
      p[0] = farthest([&](const Vec3& a) { return squared_norm(Vec3(a - x[other[0]])); });
      p[1] = farthest([&](const Vec3& a) { return squared_norm(Vec3(a - x[p[0]])); });
      p[2] = farthest([&](const Vec3& a) { return squared_norm(cross(Vec3(a - x[p[0]]), Vec3(x[p[1]] - x[p[0]]))); });
      const Vec3 normal = cross(Vec3(x[p[1]] - x[p[0]]), Vec3(x[p[2]] - x[p[0]]));
      p[3] = farthest([&](const Vec3& a) { return std::abs(dot(normal, Vec3(a - x[p[0]]))); });
      held.push_back({{aside(first), aside(other)}, p});
    }
  return held;
}

}  // namespace hinge::molecular
