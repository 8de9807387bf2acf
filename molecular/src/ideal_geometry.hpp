// SPDX-License-Identifier: BSD-3-Clause
// Ideal side chains: bond lengths and angles after Engh & Huber, Acta Cryst. A47 (1991) 392.
#pragma once

#include <array>
#include <string_view>

namespace hinge::molecular {

/// Atom d beyond a-b-c: |c d| in angstrom, angle b-c-d and torsion a-b-c-d in degrees (IUPAC sign).
struct IdealAtom {
  char letter;  ///< one-letter code of the residue
  std::string_view name, a, b, c;
  double length, angle, torsion;
};

// Rotamers common in helices and strands alike: chi1 -65, or 180 where -65 meets the backbone of a helix (branched and
// aromatic side chains). Of two branches the second is 122 degrees from the first (120 in threonine). Benzene rings are
// regular hexagons of side 1.39, so they close exactly; five-membered rings close to 0.01 angstrom.
inline constexpr std::array<IdealAtom, 66> ideal_side_chains{{
    {'C', "SG", "N", "CA", "CB", 1.808, 114.4, -65},     {'D', "CG", "N", "CA", "CB", 1.516, 112.6, -70},
    {'D', "OD1", "CA", "CB", "CG", 1.249, 118.4, -15},   {'D', "OD2", "CA", "CB", "CG", 1.249, 118.4, 165},
    {'E', "CG", "N", "CA", "CB", 1.520, 114.1, -65},     {'E', "CD", "CA", "CB", "CG", 1.516, 112.6, 180},
    {'E', "OE1", "CB", "CG", "CD", 1.249, 118.4, -10},   {'E', "OE2", "CB", "CG", "CD", 1.249, 118.4, 170},
    {'F', "CG", "N", "CA", "CB", 1.502, 113.8, 180},     {'F', "CD1", "CA", "CB", "CG", 1.390, 120.0, 80},
    {'F', "CD2", "CA", "CB", "CG", 1.390, 120.0, -100},  {'F', "CE1", "CB", "CG", "CD1", 1.390, 120.0, 180},
    {'F', "CE2", "CB", "CG", "CD2", 1.390, 120.0, 180},  {'F', "CZ", "CG", "CD1", "CE1", 1.390, 120.0, 0},
    {'H', "CG", "N", "CA", "CB", 1.497, 113.8, -65},     {'H', "ND1", "CA", "CB", "CG", 1.378, 122.7, -70},
    {'H', "CD2", "CA", "CB", "CG", 1.354, 131.2, 110},   {'H', "CE1", "CB", "CG", "ND1", 1.326, 109.3, 180},
    {'H', "NE2", "CG", "ND1", "CE1", 1.319, 108.34, 0},  {'I', "CG1", "N", "CA", "CB", 1.530, 110.4, -65},
    {'I', "CG2", "N", "CA", "CB", 1.521, 110.5, 173},    {'I', "CD1", "CA", "CB", "CG1", 1.513, 113.8, 170},
    {'K', "CG", "N", "CA", "CB", 1.520, 114.1, -65},     {'K', "CD", "CA", "CB", "CG", 1.520, 111.3, 180},
    {'K', "CE", "CB", "CG", "CD", 1.520, 111.3, 180},    {'K', "NZ", "CG", "CD", "CE", 1.489, 111.9, 180},
    {'L', "CG", "N", "CA", "CB", 1.530, 116.3, -65},     {'L', "CD1", "CA", "CB", "CG", 1.521, 110.7, 175},
    {'L', "CD2", "CA", "CB", "CG", 1.521, 110.7, -63},   {'M', "CG", "N", "CA", "CB", 1.520, 114.1, -65},
    {'M', "SD", "CA", "CB", "CG", 1.803, 112.7, 180},    {'M', "CE", "CB", "CG", "SD", 1.791, 100.9, 180},
    {'N', "CG", "N", "CA", "CB", 1.516, 112.6, -70},     {'N', "OD1", "CA", "CB", "CG", 1.231, 120.8, -20},
    {'N', "ND2", "CA", "CB", "CG", 1.328, 116.4, 160},   {'Q', "CG", "N", "CA", "CB", 1.520, 114.1, -65},
    {'Q', "CD", "CA", "CB", "CG", 1.516, 112.6, 180},    {'Q', "OE1", "CB", "CG", "CD", 1.231, 120.8, -25},
    {'Q', "NE2", "CB", "CG", "CD", 1.328, 116.4, 155},   {'R', "CG", "N", "CA", "CB", 1.520, 114.1, -65},
    {'R', "CD", "CA", "CB", "CG", 1.520, 111.3, 180},    {'R', "NE", "CB", "CG", "CD", 1.460, 112.0, 180},
    {'R', "CZ", "CG", "CD", "NE", 1.329, 124.2, 180},    {'R', "NH1", "CD", "NE", "CZ", 1.326, 120.0, 0},
    {'R', "NH2", "CD", "NE", "CZ", 1.326, 119.7, 180},   {'S', "OG", "N", "CA", "CB", 1.417, 111.1, -65},
    {'T', "OG1", "N", "CA", "CB", 1.433, 109.6, -65},    {'T', "CG2", "N", "CA", "CB", 1.521, 110.5, 175},
    {'V', "CG1", "N", "CA", "CB", 1.521, 110.5, 175},    {'V', "CG2", "N", "CA", "CB", 1.521, 110.5, -63},
    {'W', "CG", "N", "CA", "CB", 1.498, 113.6, 180},     {'W', "CD1", "CA", "CB", "CG", 1.365, 126.9, -105},
    {'W', "CD2", "CA", "CB", "CG", 1.433, 126.8, 75},    {'W', "NE1", "CB", "CG", "CD1", 1.374, 110.2, 180},
    {'W', "CE2", "CB", "CG", "CD2", 1.409, 107.2, 180},  {'W', "CE3", "CB", "CG", "CD2", 1.398, 134.0, 0},
    {'W', "CZ2", "CG", "CD2", "CE2", 1.394, 122.4, 180}, {'W', "CZ3", "CG", "CD2", "CE3", 1.382, 118.6, 180},
    {'W', "CH2", "CD2", "CE2", "CZ2", 1.368, 117.5, 0},  {'Y', "CG", "N", "CA", "CB", 1.512, 113.9, 180},
    {'Y', "CD1", "CA", "CB", "CG", 1.390, 120.0, 80},    {'Y', "CD2", "CA", "CB", "CG", 1.390, 120.0, -100},
    {'Y', "CE1", "CB", "CG", "CD1", 1.390, 120.0, 180},  {'Y', "CE2", "CB", "CG", "CD2", 1.390, 120.0, 180},
    {'Y', "CZ", "CG", "CD1", "CE1", 1.390, 120.0, 0},    {'Y', "OH", "CD1", "CE1", "CZ", 1.376, 120.0, 180},
}};

}  // namespace hinge::molecular
