// SPDX-License-Identifier: BSD-3-Clause
// read_path_end: reads an end of a path from the command line.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "options.hpp"

namespace robocd {

/// Returns one value (rad or m) per independent joint. text: "zero", "state:GROUP/NAME,GROUP/NAME...", "@FILE" or
/// "@FILE:ROW" (a CSV file as for read_configurations(), rows from 0; a file with one row needs no number), or a list
/// of values. Throws ModelError, naming the option, for a bad text, row, state or number, and LoadError for a bad file.
/// Appends a note to job.notes for skipped columns of the file.
std::vector<double> read_path_end(const char* option, const std::string& text, const Options& options, Job& job);

/// Returns the file of an end "@FILE" or "@FILE:ROW", and the row if one is given.
std::pair<std::string, std::optional<std::size_t>> file_of_end(const std::string& text);

}  // namespace robocd
