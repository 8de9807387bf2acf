// SPDX-License-Identifier: BSD-3-Clause
// An end of a path, as the command line names it.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "hinge/molecular/fit_torsions.hpp"
#include "options.hpp"

namespace biocd {

struct PathEnd {
  std::string text;                                           ///< as given
  std::vector<double> turns;                                  ///< from the reference, rad, one per selected DOF
  std::optional<hinge::molecular::Superposition> from_model;  ///< model:N: the rebuilt end laid over the model
};

/// "reference", "model:N" (numbers as in the file), "@FILE" or a list: turns from the reference in degrees, one per
/// selected DOF, in a file also separated by blanks and line ends. ModelError: a text, count or number that does not
/// fit, naming the option; LoadError: the same in a file, or a model that leaves a torsion undefined.
PathEnd read_path_end(const char* option, const std::string& text, const Job& job);

/// What a user has to know of an end that stands for a model, one sentence; empty for others.
std::string note_of(const PathEnd& end, const Job& job);

}  // namespace biocd
