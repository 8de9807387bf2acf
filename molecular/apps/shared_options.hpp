// SPDX-License-Identifier: BSD-3-Clause
// Adds the command-line options that several commands share. Each function stores the values in `o`, which must outlive
// the command.
#pragma once

#include <CLI/CLI.hpp>

#include "hinge_tools/number_option.hpp"
#include "options.hpp"

namespace biocd {

inline constexpr hinge::tool::NumberRange<double> lengths_above_0{0.0, hinge::tool::largest_length,
                                                                  true};  // angstrom or degrees

/// Adds FILE and the options about the molecule, its free torsions and the rules of a check.
void add_model_options(CLI::App& command, Options& o);
/// Adds --json, --csv and --npy if with_csv, and --max-pairs.
void add_output_options(CLI::App& command, Options& o, bool with_csv = false);
/// Adds --out of conformations.
void add_out_option(CLI::App& command, Options& o);
/// Adds --explain.
void add_explain_option(CLI::App& command, Options& o);
/// Adds --view.
void add_view_option(CLI::App& command, Options& o);
/// Adds --report.
void add_report_option(CLI::App& command, Options& o);
/// Adds the further options that check and sample share: output format, mode, --out, parts, threads.
void add_check_options(CLI::App& command, Options& o);
/// Adds all options of dial but those of the model.
void add_dial_options(CLI::App& command, Options& o);
/// Adds --closures.
void add_closures_option(CLI::App& command, Options& o);
/// Adds the options of path: output format, both ends and the method.
void add_ends(CLI::App& command, Options& o, bool from_is_required);
/// Adds all options of path but those of the model.
void add_path_options(CLI::App& command, Options& o);

}  // namespace biocd
