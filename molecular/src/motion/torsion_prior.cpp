// SPDX-License-Identifier: BSD-3-Clause
// Draws torsions from protein statistics.
#include "hinge/molecular/torsion_prior.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string_view>
#include <utility>

#include "chemistry/ramachandran_table.hpp"
#include "chemistry/rotamer_table.hpp"
#include "hinge/core/error.hpp"
#include "motion/backbone_geometry.hpp"
#include "motion/draw_turn.hpp"

namespace hinge::molecular {

namespace {

constexpr double rad_per_degree = std::numbers::pi / 180.0;
constexpr double omega_spread = 5.0 * rad_per_degree;
constexpr std::size_t bins = ramachandran_bins;
constexpr double bin_width = 2.0 * std::numbers::pi / static_cast<double>(bins);

/// Returns the angle in (-pi, pi]. The angle is at most a few turns away.
double wrapped(double angle) {
  while (angle > std::numbers::pi) angle -= 2.0 * std::numbers::pi;
  while (angle <= -std::numbers::pi) angle += 2.0 * std::numbers::pi;
  return angle;
}

std::size_t bin_of(double angle) {
  const auto bin = static_cast<std::size_t>((wrapped(angle) + std::numbers::pi) / bin_width);
  return std::min(bin, bins - 1);
}

/// Draws an index with probability weight(k) / total, k < count. total > 0.
template <class Weight>
std::size_t draw_index(SampleStream& stream, std::size_t count, double total, const Weight& weight) {
  double left = stream.uniform() * total;
  std::size_t last = 0;
  for (std::size_t k = 0; k < count; ++k) {
    const double w = weight(k);
    if (w <= 0.0) continue;
    last = k;
    left -= w;
    if (left < 0.0) break;
  }
  return last;
}

double draw_in_bin(SampleStream& stream, std::size_t bin) {
  return (static_cast<double>(bin) + stream.uniform()) * bin_width - std::numbers::pi;
}

/// Sums of all rows of the tables, and of the tables.
struct TableSums {
  TableSums() {
    for (std::size_t t = 0; t < std::size(ramachandran_tables); ++t)
      for (std::size_t k = 0; k < bins * bins; ++k) {
        by_phi[t][k / bins] += ramachandran_tables[t][k];
        total[t] += ramachandran_tables[t][k];
      }
  }
  std::array<std::array<double, bins>, 6> by_phi{};
  std::array<double, 6> total{};
};

const TableSums& table_sums() {
  static const TableSums sums;
  return sums;
}

}  // namespace

TorsionPrior::TorsionPrior(const Molecule& molecule, const DofSelection& selection, Prior prior,
                           std::optional<double> sigma, std::vector<std::vector<std::size_t>> units)
    : sigma_(sigma) {
  if (prior == Prior::ramachandran && sigma)
    throw ModelError("protein statistics and a standard deviation are both given, expected one of the two");
  if (prior == Prior::independent) {
    for (std::vector<std::size_t>& positions : units) units_.emplace_back().others = std::move(positions);
    return;
  }
  const BackboneGeometry geometry(molecule.structure());
  std::vector<bool> drawn(selection.size(), false);
  for (const std::vector<std::size_t>& positions : units) {
    units_.push_back(make(molecule, selection, geometry, positions, drawn));
    for (const std::size_t k : positions) drawn[k] = true;
  }
}

TorsionPrior::Unit TorsionPrior::make(const Molecule& molecule, const DofSelection& selection,
                                      const BackboneGeometry& geometry, const std::vector<std::size_t>& positions,
                                      const std::vector<bool>& drawn_before) {
  Unit unit;
  const Structure& s = molecule.structure();
  const auto torsion_at = [&](std::size_t k) -> const Torsion& {
    return molecule.torsions()[molecule.torsion_of(selection.dofs()[k])];
  };
  const std::uint32_t residue = positions.empty() ? 0 : torsion_at(positions.front()).residue;
  if (positions.empty() || s.residues[residue].kind != ResidueKind::amino_acid) {
    unit.others = positions;
    return unit;
  }
  Backbone backbone;
  backbone.reference = {geometry.phi(residue), std::nan("")};
  for (const std::size_t k : positions) {
    const std::string& name = torsion_at(k).name;
    if (name == "phi" || name == "psi")
      backbone.drawn[name == "phi" ? 0 : 1] = true;
    else
      (name == "omega" ? unit.omegas : unit.others).push_back(k);
  }
  if (backbone.drawn[0] || backbone.drawn[1]) {
    // Torsions that are not free, or are in another unit, matter too.
    const auto by_residue = [](const Torsion& torsion, std::uint32_t r) { return torsion.residue < r; };
    const auto all = molecule.torsions();
    for (auto t = std::lower_bound(all.begin(), all.end(), residue, by_residue);
         t != all.end() && t->residue == residue; ++t) {
      if (t->name != "phi" && t->name != "psi") continue;
      const std::size_t which = t->name == "phi" ? 0 : 1;
      const DofId dof = molecule.dof(static_cast<std::size_t>(t - all.begin()));
      const auto found = std::lower_bound(selection.dofs().begin(), selection.dofs().end(), dof);
      if (found != selection.dofs().end() && *found == dof)
        backbone.position[which] = static_cast<std::size_t>(found - selection.dofs().begin());
      // At the end of a chain, psi is measured to O, which is opposite to the next N.
      const bool to_oxygen = which == 1 && s.atoms[t->atoms[3]].name != "N";
      backbone.reference[which] = wrapped(t->reference + (to_oxygen ? std::numbers::pi : 0.0));
    }
    // The other torsion is known if an earlier unit has it, or if it is fixed and does not close a loop.
    const std::size_t other = backbone.drawn[0] ? 1 : 0;
    const bool closes = std::any_of(molecule.loops().begin(), molecule.loops().end(),
                                    [&](const Loop& loop) { return loop.last == residue; });
    const bool known = backbone.position[other] == none ? !closes && !std::isnan(backbone.reference[other])
                                                        : drawn_before[backbone.position[other]];
    backbone.given = known && !(backbone.drawn[0] && backbone.drawn[1]);
    backbone.mirrored = geometry.is_mirrored(residue);
    backbone.table = static_cast<std::size_t>(geometry.kind(residue));
    unit.backbone = backbone;
  }
  const std::string_view name = parent_name(s.residues[residue]);
  const auto of_residue = [&](const Rotamer& rotamer) { return rotamer.residue == name; };
  const Rotamer* const end = rotamers + rotamer_count;
  const Rotamer* const first = std::find_if(rotamers, end, of_residue);
  if (first == end) return unit;
  SideChain side;
  side.first_rotamer = static_cast<std::size_t>(first - rotamers);
  side.rotamers = static_cast<std::size_t>(std::find_if_not(first, end, of_residue) - first);
  side.mirrored = geometry.is_mirrored(residue);
  const std::size_t torsions = std::erase_if(unit.others, [&](std::size_t k) {
    const std::string& chi = torsion_at(k).name;
    if (chi.size() != 4 || !chi.starts_with("chi") || chi[3] < '1' || chi[3] - '0' > first->chis) return false;
    const auto c = static_cast<std::size_t>(chi[3] - '1');
    side.position[c] = k;
    side.reference[c] = torsion_at(k).reference;
    return true;
  });
  if (torsions > 0) unit.side_chain = side;
  return unit;
}

void TorsionPrior::draw_backbone(const Backbone& backbone, SampleStream& stream, std::span<double> q) {
  const auto& table = ramachandran_tables[backbone.table];
  const TableSums& sums = table_sums();
  const double sign = backbone.mirrored ? -1.0 : 1.0;
  const auto set = [&](std::size_t which, std::size_t bin) {
    const double angle = sign * draw_in_bin(stream, bin);
    if (backbone.drawn[which]) q[backbone.position[which]] = wrapped(angle - backbone.reference[which]);
  };
  const auto row = [&](std::size_t phi) {
    return [&table, phi](std::size_t k) { return static_cast<double>(table[phi * bins + k]); };
  };
  if (!backbone.given) {
    const std::size_t phi = draw_index(stream, bins, sums.total[backbone.table],
                                       [&](std::size_t k) { return sums.by_phi[backbone.table][k]; });
    const std::size_t psi = draw_index(stream, bins, sums.by_phi[backbone.table][phi], row(phi));
    set(0, phi);
    set(1, psi);
    return;
  }
  const std::size_t which = backbone.drawn[0] ? 0 : 1, other = 1 - which;
  const double turned = backbone.position[other] == none ? 0.0 : q[backbone.position[other]];
  const std::size_t known = bin_of(sign * (backbone.reference[other] + turned));
  const auto weight = [&](std::size_t k) {
    return static_cast<double>(table[which == 1 ? known * bins + k : k * bins + known]);
  };
  double total = 0.0;
  for (std::size_t k = 0; k < bins; ++k) total += weight(k);
  // No residue of the data has the known value: each bin is as good as another.
  set(which, total > 0.0 ? draw_index(stream, bins, total, weight)
                         : draw_index(stream, bins, static_cast<double>(bins), [](std::size_t) { return 1.0; }));
}

void TorsionPrior::draw_side_chain(const SideChain& side_chain, SampleStream& stream, std::span<double> q) {
  const Rotamer* const first = rotamers + side_chain.first_rotamer;
  double total = 0.0;
  for (std::size_t k = 0; k < side_chain.rotamers; ++k) total += first[k].share;
  const Rotamer& rotamer =
      first[draw_index(stream, side_chain.rotamers, total, [&](std::size_t k) { return first[k].share; })];
  const double sign = side_chain.mirrored ? -1.0 : 1.0;
  for (std::size_t c = 0; c < static_cast<std::size_t>(rotamer.chis); ++c) {
    const double angle = sign * rad_per_degree * (rotamer.mean[c] + rotamer.spread[c] * stream.normal());
    if (side_chain.position[c] != none) q[side_chain.position[c]] = wrapped(angle - side_chain.reference[c]);
  }
}

void TorsionPrior::draw(std::size_t unit, SampleStream& stream, std::span<double> q) const {
  const Unit& drawn = units_[unit];
  if (drawn.backbone) draw_backbone(*drawn.backbone, stream, q);
  if (drawn.side_chain) draw_side_chain(*drawn.side_chain, stream, q);
  for (const std::size_t k : drawn.omegas) q[k] = omega_spread * stream.normal();
  for (const std::size_t k : drawn.others) q[k] = draw_turn(sigma_, stream);
}

}  // namespace hinge::molecular
