// SPDX-License-Identifier: BSD-3-Clause
// What a command line says of several molecules: the files, what is placed and how far, which pairs count.
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

/// FILE, and those of --with, kept whole, beside it.
hinge::molecular::Structure read_files(const Options& options);

/// The part and the range of "PART", "PART=DISTANCE" or "PART=DISTANCE,DEGREES". ModelError: no range.
std::pair<std::string, hinge::molecular::PlacementRange> read_placement(const std::string& word);

/// --between and --inside; "rest" is what the other part of a --between does not hold.
hinge::molecular::PairScope read_scope(const Options& options, const hinge::molecular::Structure& structure);

/// Where the value of a selected DOF stands in a configuration.
std::size_t position_of(const Job& job, hinge::DofId dof);
/// Values of each placed part's DOF in a configuration of the job's selection.
using Placements = std::vector<std::array<double, 6>>;
Placements placements_of(const Job& job, std::span<const double> q);

/// Parts, centres and ranges.
Json placed_json(const Job& job);
/// Further files, placed parts and pairs asked about, for people; nothing where there are none.
std::string scene_lines(const Options& options, const Job& job);

Json placements_json(const Job& job, const Placements& placements);
/// Columns that follow those of csv_rows: ",B.x,B.y,B.z,B.rx,B.ry,B.rz" per placed part.
std::string placements_header(const Job& job);
std::string with_placements(const std::string& rows, const Placements& placements);

}  // namespace biocd
