// SPDX-License-Identifier: BSD-3-Clause
// An end of a path, as given on the command line.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "hinge/molecular/fit_torsions.hpp"
#include "options.hpp"

namespace biocd {

/// One end of a path.
struct PathEnd {
  std::string text;           ///< text of the option
  std::vector<double> turns;  ///< from the reference, one per selected DOF: rad, or angstrom (moves)
  std::optional<hinge::molecular::Superposition> from_model;  ///< model:N only: the rebuilt end superposed on it
};

/// Reads "reference", "model:N" (number in the file), "@FILE" or a list: values relative to the reference, one per
/// selected DOF, in degrees (moves in angstrom), separated by commas, blanks or line ends. Throws ModelError, naming
/// the option, if the text, a count or a number is wrong; LoadError for the same in a file, or for a model that leaves
/// a torsion undefined.
PathEnd read_path_end(const char* option, const std::string& text, const Job& job);

/// Returns one sentence on how well the rebuilt end fits its model; empty for other ends.
std::string note_of(const PathEnd& end, const Job& job);

}  // namespace biocd
