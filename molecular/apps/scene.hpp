// SPDX-License-Identifier: BSD-3-Clause
// Options and output for several molecules: the files, the placed parts and their ranges, the pairs that count.
#pragma once

#include <array>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "hinge/molecular/pair_scope.hpp"
#include "hinge/molecular/sampler.hpp"
#include "hinge/molecular/structure.hpp"
#include "options.hpp"
#include "report.hpp"

namespace biocd {

/// Reads FILE and the files of --with, and joins them. Files of --with keep all their atoms except waters. Throws
/// LoadError.
hinge::molecular::Structure read_files(const Options& options);

/// Reads "PART", "PART=DISTANCE" or "PART=DISTANCE,DEGREES". Returns the part and its range (angstrom, rad); defaults
/// are 10 angstrom and 180 degrees. Throws ModelError for a bad range.
std::pair<std::string, hinge::molecular::PlacementRange> read_placement(const std::string& word);

/// Reads --between and --inside; "rest" stands for all residues outside the other part. Throws ModelError if a part is
/// wrong or two parts of a --between overlap.
hinge::molecular::PairScope read_scope(const Options& options, const hinge::molecular::Structure& structure);

/// Returns the index of a selected DOF in a configuration.
std::size_t position_of(const Job& job, hinge::DofId dof);
/// Values of PlacedPart::dofs per placed part: angstrom, then rad.
using Placements = std::vector<std::array<double, 6>>;
/// Returns the placements in a configuration q of the job's selection: job.checker.dof_count() values.
Placements placements_of(const Job& job, std::span<const double> q);

/// Returns parts, centres (angstrom) and ranges (angstrom, degrees).
Json placed_json(const Job& job);
/// Returns the lines of the heading about further files, placed parts and --between or --inside; empty if there are
/// none.
std::string scene_lines(const Options& options, const Job& job);

/// Returns one conformation's placements: moves (angstrom) and turns (degrees).
Json placements_json(const Job& job, const Placements& placements);
/// Returns the CSV columns of placements, such as ",B.x,B.y,B.z,B.rx,B.ry,B.rz" per placed part.
std::string placements_header(const Job& job);
/// Returns the CSV rows with the values of these columns appended (angstrom, degrees).
std::string with_placements(const std::string& rows, const Placements& placements);

}  // namespace biocd
