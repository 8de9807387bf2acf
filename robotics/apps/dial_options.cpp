// SPDX-License-Identifier: BSD-3-Clause
// Adds the options of robocd dial.
#include <cstdint>

#include "hinge_tools/help_texts.hpp"
#include "hinge_tools/number_option.hpp"
#include "shared_options.hpp"

namespace robocd {

using hinge::tool::add_number;
using hinge::tool::NumberRange;
using Reals = NumberRange<double>;
namespace title = hinge::tool::title;

void add_dial_options(CLI::App& command, Options& o) {
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
  add_number(command, "--time", o.dial_seconds, Reals{0.0, hinge::tool::largest_length, true},
             "time to measure, which sets the number of configurations")
      ->type_name("SECONDS");
  add_number(command, "-n,--count", o.dial_count, NumberRange<std::uint64_t>{1, std::uint64_t{1} << 53},
             "number of configurations that every choice answers, however long it takes")
      ->excludes(file);
  add_number(command, "--seed", o.seed, NumberRange<std::uint64_t>{0, UINT64_MAX}, "seed of the configurations")
      ->type_name("SEED");
  add_number(command, "--most-false-accepts", o.false_accepts, Reals{0.0, 100.0},
             "largest share of colliding configurations that a recommended choice may call free; 0: only choices that "
             "cannot miss a collision")
      ->type_name("PERCENT");
  add_number(command, "--most-false-rejects", o.false_rejects, Reals{0.0, 100.0},
             "largest share of free configurations that a recommended choice may call colliding")
      ->type_name("PERCENT");
  command.add_flag("--extremes", o.extremes,
                   "also test scaled and displaced copies of the robot and configurations that nearly touch");
  add_json_option(command, o);
  command.add_option("--report", o.report, "write an HTML page with the table and the Pareto front, for any browser")
      ->type_name("FILE.html");
  command.add_option("--apply", o.apply, "write the recommended options to this file, for --settings")
      ->type_name("FILE");
}

}  // namespace robocd
