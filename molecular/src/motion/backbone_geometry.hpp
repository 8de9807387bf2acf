// SPDX-License-Identifier: BSD-3-Clause
// BackboneGeometry: what the statistics of a residue's backbone depend on: its kind, its chirality, phi of proline.
#pragma once

#include <cmath>
#include <cstdint>
#include <numbers>
#include <optional>
#include <string_view>
#include <vector>

#include "chemistry/ramachandran_table.hpp"
#include "chemistry/residue_table.hpp"
#include "hinge/core/vec3.hpp"
#include "hinge/molecular/bond_exclusions.hpp"
#include "hinge/molecular/structure.hpp"
#include "hinge/molecular/torsions.hpp"

namespace hinge::molecular {

/// Returns the name of the amino acid that a residue is or is derived from; empty if there is none.
inline std::string_view parent_name(const Residue& residue) noexcept {
  const ResidueTemplate* found = find_residue_template(residue.name);
  return found == nullptr ? std::string_view() : found->name;
}

/// Residues of the reference coordinates. The structure must outlive this object.
class BackboneGeometry {
 public:
  explicit BackboneGeometry(const Structure& structure) : s_(structure), neighbours_(bonded_neighbours(structure)) {}

  /// True for D residues: the triple product of N, C and CB about CA has the other sign.
  bool is_mirrored(std::uint32_t residue) const {
    const Vec3 *ca = at(residue, "CA"), *n = at(residue, "N"), *c = at(residue, "C"), *cb = at(residue, "CB");
    return ca != nullptr && n != nullptr && c != nullptr && cb != nullptr &&
           dot(*n - *ca, cross(*c - *ca, *cb - *ca)) < 0.0;
  }

  /// Returns the table of the residue.
  BackboneKind kind(std::uint32_t residue) const {
    const std::string_view name = parent_name(s_.residues[residue]);
    if (name == "PRO") {
      const auto before = next_to(residue, "N", "C");
      const double omega = before
                               ? dihedral_of(at(*before, "CA"), at(*before, "C"), at(residue, "N"), at(residue, "CA"))
                               : std::numbers::pi;
      return std::abs(omega) < std::numbers::pi / 2 ? BackboneKind::cis_proline : BackboneKind::trans_proline;
    }
    if (name == "GLY") return BackboneKind::glycine;
    const auto after = next_to(residue, "C", "N");
    if (after && parent_name(s_.residues[*after]) == "PRO") return BackboneKind::before_proline;
    return name == "ILE" || name == "VAL" ? BackboneKind::isoleucine_valine : BackboneKind::general;
  }

  /// Returns phi, rad; NaN if it is undefined.
  double phi(std::uint32_t residue) const {
    const auto before = next_to(residue, "N", "C");
    return dihedral_of(before ? at(*before, "C") : nullptr, at(residue, "N"), at(residue, "CA"), at(residue, "C"));
  }

 private:
  const Vec3* at(std::uint32_t residue, std::string_view name) const {
    const Residue& r = s_.residues[residue];
    for (std::uint32_t atom = r.first_atom; atom < r.last_atom; ++atom)
      if (s_.atoms[atom].name == name) return &s_.models.front()[atom];
    return nullptr;
  }
  static double dihedral_of(const Vec3* a, const Vec3* b, const Vec3* c, const Vec3* d) {
    return a == nullptr || b == nullptr || c == nullptr || d == nullptr ? std::nan("") : dihedral(*a, *b, *c, *d);
  }
  /// Returns the residue whose atom `other` is bonded to atom `own` of this one.
  std::optional<std::uint32_t> next_to(std::uint32_t residue, std::string_view own, std::string_view other) const {
    for (std::uint32_t a = s_.residues[residue].first_atom; a < s_.residues[residue].last_atom; ++a)
      if (s_.atoms[a].name == own)
        for (const std::uint32_t b : neighbours_[a])
          if (s_.atoms[b].residue != residue && s_.atoms[b].name == other) return s_.atoms[b].residue;
    return std::nullopt;
  }

  const Structure& s_;
  std::vector<std::vector<std::uint32_t>> neighbours_;
};

}  // namespace hinge::molecular
