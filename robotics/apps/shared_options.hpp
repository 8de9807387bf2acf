// SPDX-License-Identifier: BSD-3-Clause
// Adds the options of the commands. Each function stores the values in `o`, which must outlive the command.
#pragma once

#include <CLI/CLI.hpp>

#include "options.hpp"

namespace robocd {

/// Adds URDF and the options about reading it.
void add_robot_options(CLI::App& command, Options& o);
/// Adds the options about tested pairs.
void add_pair_options(CLI::App& command, Options& o);
/// Adds --clearance and --contained.
void add_closeness_options(CLI::App& command, Options& o);
/// Adds --json.
void add_json_option(CLI::App& command, Options& o);
/// Adds the bodies around the robot.
void add_environment_option(CLI::App& command, Options& o);
/// These add the further options of one command.
void add_check_options(CLI::App& command, Options& o);
void add_matrix_options(CLI::App& command, Options& o);
void add_path_options(CLI::App& command, Options& o);
void add_relax_options(CLI::App& command, Options& o);
void add_plan_options(CLI::App& command, Options& o);
void add_dial_options(CLI::App& command, Options& o);

}  // namespace robocd
