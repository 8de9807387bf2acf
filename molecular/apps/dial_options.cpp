// SPDX-License-Identifier: BSD-3-Clause
// Adds the options of biocd dial.
#include <cstdint>

#include "hinge_tools/help_texts.hpp"
#include "shared_options.hpp"

namespace biocd {

using hinge::tool::add_number;
using hinge::tool::NumberRange;
using Reals = NumberRange<double>;
namespace title = hinge::tool::title;

void add_dial_options(CLI::App& command, Options& o) {
  command.option_defaults()->group(title::sampling);
  add_number(command, "--time", o.dial_seconds, lengths_above_0,
             "time to measure, which sets the number of conformations")
      ->type_name("SECONDS");
  add_number(command, "-n,--count", o.dial_count, NumberRange<std::uint64_t>{1, std::uint64_t{1} << 53},
             "number of conformations that every choice answers, however long it takes");
  add_number(command, "--seed", o.seed, NumberRange<std::uint64_t>{0, UINT64_MAX}, "seed of the conformations")
      ->type_name("SEED");
  CLI::Option* sigma = add_number(command, "--sigma", o.sigma_degrees, lengths_above_0,
                                  "standard deviation of a Gaussian about the reference (default: such that about half "
                                  "of the conformations collide)")
                           ->type_name("DEGREES");
  command.add_flag("--uniform", o.uniform, "draw torsions over the full range")->excludes(sigma);
  add_closures_option(command, o);
  add_number(command, "--most-false-accepts", o.false_accepts, Reals{0.0, 100.0},
             "largest share of colliding conformations that a recommended choice may call free; 0: only exact choices")
      ->type_name("PERCENT");
  add_number(command, "--most-false-rejects", o.false_rejects, Reals{0.0, 100.0},
             "largest share of free conformations that a recommended choice may call colliding")
      ->type_name("PERCENT");
  command.add_flag(
      "--extremes", o.extremes,
      "also test conformations that nearly touch, with coordinates that are written to files or displaced");
  command.option_defaults()->group(title::output);
  command.add_flag_callback(
      "--json", [&o] { o.output = Output::json; }, "print JSON on standard output");
  command.add_option("--report", o.report, "write an HTML page with the table and the Pareto front, for any browser")
      ->type_name("FILE.html");
  command.add_option("--apply", o.apply, "write the recommended options to this file, for --settings")
      ->type_name("FILE");
}

}  // namespace biocd
