// SPDX-License-Identifier: BSD-3-Clause
// An end of a path, as the command line names it.
#pragma once

#include <string>
#include <vector>

#include "options.hpp"

namespace robocd {

/// "zero", "state:GROUP/NAME,GROUP/NAME...", "@FILE" or "@FILE:ROW" (a CSV file as of read_configurations, rows from 0;
/// a file of one row needs no number), or a list of values: one value (rad or m) per independent joint. ModelError,
/// naming the option: a text, row, state or number that does not fit. LoadError: the file's faults. What is left out of
/// a file is added to job.notes.
std::vector<double> read_path_end(const char* option, const std::string& text, const Options& options, Job& job);

}  // namespace robocd
