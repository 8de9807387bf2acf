// SPDX-License-Identifier: BSD-3-Clause
// Options of the command line that several commands share.
#pragma once

#include <CLI/CLI.hpp>

#include "hinge_tools/number_option.hpp"
#include "options.hpp"

namespace biocd {

inline constexpr hinge::tool::NumberRange<double> lengths_above_0{0.0, hinge::tool::largest_length,
                                                                  true};  // angstrom, or degrees

/// The molecule, what turns in it, and the rules of a check.
void add_model_options(CLI::App& command, Options& o);
void add_json_option(CLI::App& command, Options& o);
/// What check and sample share beyond the model.
void add_check_options(CLI::App& command, Options& o);
void add_closures_option(CLI::App& command, Options& o);
void add_path_options(CLI::App& command, Options& o);

}  // namespace biocd
