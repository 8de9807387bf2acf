// SPDX-License-Identifier: BSD-3-Clause
// ConformerChoice: which alternative location of each residue is read.
#pragma once

#include <cstddef>
#include <optional>
#include <string>

#include "io/read_file.hpp"

namespace hinge::molecular {

/// One conformer for the whole structure, so that atoms of one are not held against those of another: the one asked
/// for, else that of the highest summed occupancy, then the first by letter.
class ConformerChoice {
 public:
  ConformerChoice(const RawModel& first_model, const ReadOptions& options);

  /// Of residue types that share a position the one with the highest is read.
  double preference(const RawResidue& residue) const;
  /// The alternative location to read in a residue; '\0' when there is none. One that lacks the structure's conformer
  /// takes its own of highest occupancy, then the first by letter.
  char altloc_of(const RawResidue& residue) const;

  /// For the note: that this residue is read at this location, and that this atom, "A:LYS3:CB at B", is not read.
  void count(char altloc, const std::string& residue);
  void count_dropped(const std::string& atom);
  /// Which conformer is read, in one sentence; empty where the file has one only.
  std::string note() const;

 private:
  std::optional<char> conformer_;
  bool asked_for_;
  std::size_t inside_ = 0, beside_ = 0;  // residues with alternative locations
  std::size_t dropped_ = 0;              // atoms
  std::string first_beside_, first_dropped_;
};

}  // namespace hinge::molecular
