// SPDX-License-Identifier: BSD-3-Clause
// ramachandran_tables: how often backbone torsions (phi, psi) occur in proteins, by kind of residue.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

namespace hinge::molecular {

/// Kinds of residues with different backbones, in the order of the tables. before_proline: the next residue is proline.
enum class BackboneKind : std::uint8_t {
  general,
  isoleucine_valine,
  glycine,
  before_proline,
  trans_proline,
  cis_proline
};

inline constexpr std::size_t ramachandran_bins = 36;  ///< bins of 10 degrees from -180, for phi and for psi

/// Shares of the bins in units of 1/10 000, phi by psi: a row for each bin of phi.
using RamachandranTable = std::uint16_t[ramachandran_bins * ramachandran_bins];

/// Source: Top8000, see ramachandran_table.cpp.
extern const RamachandranTable ramachandran_tables[6];

}  // namespace hinge::molecular
