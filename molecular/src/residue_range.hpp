// SPDX-License-Identifier: BSD-3-Clause
// Residues named on a command line: "A:45", "A:10-20", "_:60A".
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "hinge/molecular/structure.hpp"

namespace hinge::molecular {

/// ModelError naming the word and what was expected.
[[noreturn]] void refuse(std::string_view word, const std::string& expected);

/// Residues [first, last], positions in Structure::residues, and what follows them in the word (":chi1", or nothing).
struct ResidueRange {
  std::uint32_t first = 0;
  std::uint32_t last = 0;
  std::string_view rest;
};

/// ModelError: a word of another form, a chain or residue that is not there, a first residue behind the last.
ResidueRange read_residue_range(const Structure& structure, std::string_view word);

}  // namespace hinge::molecular
