// SPDX-License-Identifier: BSD-3-Clause
// Adds the options of robocd dial.
#include "hinge_tools/dial_options.hpp"

#include "hinge_tools/help_texts.hpp"
#include "shared_options.hpp"

namespace robocd {

namespace title = hinge::tool::title;

void add_dial_options(CLI::App& command, Options& o) {
  const char* const units = "configurations";
  command.option_defaults()->group(title::question);
  add_closeness_options(command, o);
  add_environment_option(command, o);
  command.option_defaults()->group(title::sampling);
  CLI::Option* file =
      command
          .add_option("--csv-in", o.csv_in,
                      "CSV file of configurations to measure with, in the format of check --csv-in (default: uniform "
                      "within the joint limits)")
          ->type_name("FILE");
  hinge::tool::add_dial_sampling(command, o.dial, o.seed, units)->excludes(file);
  add_json_option(command, o);
  hinge::tool::add_dial_outputs(
      command, o.dial, o.report, units, "choices that cannot miss a collision",
      "also test scaled and displaced copies of the robot and configurations that nearly touch");
}

}  // namespace robocd
