// SPDX-License-Identifier: BSD-3-Clause
// An end of a path, as given on the command line.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "hinge/molecular/fit_coordinates.hpp"
#include "options.hpp"
#include "report.hpp"

namespace biocd {

/// One end of a path.
struct PathEnd {
  std::string text;                              ///< text of the option
  std::vector<double> turns;                     ///< from the reference, one per selected DOF: rad, or angstrom (moves)
  hinge::molecular::TargetCoordinates target{};  ///< model:N and files only: the coordinates that the end should have
  std::optional<hinge::molecular::CoordinateFit> fitted{};  ///< the same: how near `turns` comes to them
};

/// Reads "reference", "model:N" (number in the file), a file of coordinates, "@FILE" or a list. A file is PDB, mmCIF or
/// PQR, with ":N" for a model other than the first, or a trajectory "FILE:FRAME" of the molecule. A list, or the file
/// after @, has values relative to the reference, one per selected DOF, in degrees (moves in angstrom), separated by
/// commas, blanks or line ends. Coordinates are fitted (fit_coordinates); fit and stop are for that. Throws ModelError,
/// naming the option, if the text, a count or a number is wrong; LoadError for the same in a file, or for one that is
/// not of this molecule.
PathEnd read_path_end(const char* option, const std::string& text, const Options& options, const Job& job,
                      const hinge::molecular::FitOptions& fit = {}, const std::function<bool()>& stop = {});

/// Angles of a fitted end are known up to whole turns: turns them so that the path is the shorter way. A list states
/// the turns exactly, so it stays.
void take_shorter_way(const Job& job, PathEnd& from, PathEnd& to);

/// Returns the text of the option, cut short.
std::string shown(const PathEnd& end);
/// Returns the end as JSON: degrees (moves in angstrom), and the distance from the coordinates.
Json end_json(const Job& job, const PathEnd& end);

/// Returns the file that an end names ("FILE", "FILE:N", "@FILE"); empty for other ends.
std::string file_of_end(const std::string& text);

/// Returns one sentence on how near a fitted end is to its coordinates; empty for other ends.
std::string note_of(const PathEnd& end, const Job& job);

}  // namespace biocd
