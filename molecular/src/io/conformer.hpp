// SPDX-License-Identifier: BSD-3-Clause
// ConformerChoice: chooses the alternative location of each residue.
#pragma once

#include <cstddef>
#include <optional>
#include <string>

#include "chemistry/counted.hpp"
#include "io/read_file.hpp"

namespace hinge::molecular {

/// Chooses one conformer for the whole structure, so that atoms of different conformers are not tested against each
/// other: the requested one, otherwise the one of highest summed occupancy, then the first letter.
class ConformerChoice {
 public:
  /// Sums the occupancies of the residues that the options keep.
  ConformerChoice(const RawModel& first_model, const ReadOptions& options);

  /// Rank of a residue among residue types that share a position; the highest is read.
  double preference(const RawResidue& residue) const;
  /// Returns the alternative location to read in a residue, or '\0' if it has none. A residue without the structure's
  /// conformer uses its own location of highest occupancy, then the first letter.
  char altloc_of(const RawResidue& residue) const;

  /// Both count for note(): a residue read at a location, and an atom, "A:LYS3:CB at B", that is not read.
  void count(char altloc, const std::string& residue);
  void count_dropped(const std::string& atom);
  /// Describes the choice in one sentence; empty if the file has no alternative locations.
  std::string note() const;

 private:
  std::optional<char> conformer_;
  bool asked_for_;          ///< requested in the options
  std::size_t inside_ = 0;  // residues with alternative locations that are read in conformer_
  Counted beside_;          // those that are not
  Counted dropped_;         // atoms that were not read
};

}  // namespace hinge::molecular
