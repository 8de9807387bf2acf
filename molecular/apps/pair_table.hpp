// SPDX-License-Identifier: BSD-3-Clause
// Lists of pairs as tables, and how many pairs a list shows.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "hinge/molecular/checker.hpp"
#include "hinge/policy/collector.hpp"
#include "options.hpp"
#include "report.hpp"

namespace biocd {

/// Returns the pairs of a list that are printed, the first ones: see --max-pairs.
std::span<const hinge::molecular::Contact> pairs_to_print(const Options& options,
                                                          const std::vector<hinge::molecular::Contact>& pairs);

/// Adds to a JSON row how many pairs its list leaves out, if --max-pairs is given and the mode lists pairs.
void add_left_out(Json& row, const Options& options, const std::vector<hinge::molecular::Contact>& pairs,
                  const hinge::molecular::Mode& mode);
/// Prints a note on standard error about pairs without a row, which CSV has no field for.
void note_left_out(const Options& options, std::uint64_t left_out);

/// Returns the hits as colliding pairs.
std::vector<hinge::molecular::Contact> contacts(std::span<const hinge::Hit> hits);

/// Returns one line per pair that is printed, each with `note` at its end, and a line about the others. The sign
/// between distance and threshold is ">=" if the pair does not collide, even if the rounded numbers suggest otherwise.
/// headed: print the names and units of the columns first. Returns an empty text for no pairs.
std::string pair_table(const Options& options, const Job& job, const std::vector<hinge::molecular::Contact>& pairs,
                       bool headed, const std::string& note = {});

/// Returns a pair on one line without columns: "A:ARG72:O - A:ARG72:CG: 2.380 < 2.576 angstrom, overlap 0.840".
std::string pair_sentence(const Job& job, const hinge::molecular::Contact& pair);

}  // namespace biocd
