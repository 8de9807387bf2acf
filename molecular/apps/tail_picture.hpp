// SPDX-License-Identifier: BSD-3-Clause
// draw_tail: draws random conformations of a protein's last residues.
#pragma once

#include <cstdint>
#include <memory>
#include <string>

#include "hinge/molecular/checker.hpp"
#include "hinge/molecular/molecule.hpp"

namespace biocd {

/// Returns an SVG picture: the backbone, `count` random conformations of the last seven residues of the first protein
/// chain (5 degrees, sigma, about the reference; green: free, red: in collision), and the clashes of the first
/// colliding one. Returns an empty text if no chain has more than seven amino acids.
std::string draw_tail(const std::shared_ptr<const hinge::molecular::Molecule>& molecule,
                      const hinge::molecular::CheckOptions& rules, std::uint64_t seed, std::uint64_t count);

}  // namespace biocd
