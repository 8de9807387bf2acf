// SPDX-License-Identifier: BSD-3-Clause
// Adds the options of biocd dial.
#include "hinge_tools/dial_options.hpp"

#include "hinge_tools/help_texts.hpp"
#include "shared_options.hpp"

namespace biocd {

namespace title = hinge::tool::title;

void add_dial_options(CLI::App& command, Options& o) {
  const char* const units = "conformations";
  hinge::tool::add_dial_sampling(command, o.dial, o.seed, units);
  CLI::Option* sigma =
      hinge::tool::add_number(command, "--sigma", o.sigma_degrees, lengths_above_0,
                              "standard deviation of a Gaussian about the reference (default: such that about half of "
                              "the conformations collide)")
          ->type_name("DEGREES");
  command.add_flag("--uniform", o.uniform, "draw torsions over the full range")->excludes(sigma);
  add_closures_option(command, o);
  command.option_defaults()->group(title::output);
  command.add_flag_callback(
      "--json", [&o] { o.output = Output::json; }, "print JSON on standard output");
  hinge::tool::add_dial_outputs(
      command, o.dial, o.report, units, "exact choices",
      "also test conformations that nearly touch, with coordinates that are written to files or displaced");
}

}  // namespace biocd
