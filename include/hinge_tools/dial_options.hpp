// SPDX-License-Identifier: BSD-3-Clause
// The options of dial that both tools have.
#pragma once

#include <CLI/CLI.hpp>
#include <cstdint>
#include <string>

#include "hinge_tools/dial.hpp"
#include "hinge_tools/help_texts.hpp"
#include "hinge_tools/number_option.hpp"

namespace hinge::tool {

/// Adds --time, --count and --seed. units: what is measured, such as "conformations". Returns the option --count.
inline CLI::Option* add_dial_sampling(CLI::App& command, DialOptions& o, std::uint64_t& seed,
                                      const std::string& units) {
  command.option_defaults()->group(title::sampling);
  add_number(command, "--time", o.seconds, NumberRange<double>{0.0, largest_length, true},
             "time to measure, which sets the number of " + units)
      ->type_name("SECONDS");
  CLI::Option* count = add_number(command, "-n,--count", o.count, count_range,
                                  "number of " + units + " that every choice answers, however long it takes");
  add_number(command, "--seed", seed, seed_range, "seed of the " + units)->type_name("SEED");
  return count;
}

/// Adds the limits of the recommendation, --extremes, --report and --apply. at_zero: choices that a limit of 0 allows.
/// extremes: help text.
inline void add_dial_outputs(CLI::App& command, DialOptions& o, std::string& report, const std::string& units,
                             const std::string& at_zero, const std::string& extremes) {
  constexpr NumberRange<double> percents{0.0, 100.0};
  command.option_defaults()->group(title::sampling);
  add_number(command, "--most-false-accepts", o.false_accepts, percents,
             "largest share of colliding " + units + " that a recommended choice may call free; 0: only " + at_zero)
      ->type_name("PERCENT");
  add_number(command, "--most-false-rejects", o.false_rejects, percents,
             "largest share of free " + units + " that a recommended choice may call colliding")
      ->type_name("PERCENT");
  command.add_flag("--extremes", o.extremes, extremes);
  command.option_defaults()->group(title::output);
  command.add_option("--report", report, "write an HTML page with the table and the Pareto front, for any browser")
      ->type_name("FILE.html");
  command.add_option("--apply", o.apply, "write the recommended options to this file, for --settings")
      ->type_name("FILE");
}

}  // namespace hinge::tool
