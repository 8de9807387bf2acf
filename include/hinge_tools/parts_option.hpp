// SPDX-License-Identifier: BSD-3-Clause
// The options of a run in units, for CLI11.
#pragma once

#include <cstdint>
#include <string>

#include "hinge/core/error.hpp"
#include "hinge_tools/exit_zero_option.hpp"
#include "hinge_tools/help_texts.hpp"
#include "hinge_tools/number_option.hpp"
#include "hinge_tools/parts.hpp"

namespace hinge::tool {

/// Adds --parts, --unit, --slice and --serve. conformations: what a unit consists of, in words.
template <class Command>
void add_parts(Command& command, PartsOptions& parts, const std::string& conformations) {
  command.option_defaults()->group(title::parts);
  auto* const folder = command
                           .add_option("--parts", parts.folder,
                                       "compute in units, each written to a file of this folder when it is complete; "
                                       "units that are there are skipped; needs --json, --csv or --npy")
                           ->type_name("FOLDER");
  add_number(command, "--unit", parts.unit, NumberRange<std::uint64_t>{1, std::uint64_t{1} << 32},
             "number of " + conformations + " in a unit")
      ->needs(folder);
  command
      .template add_option_function<std::string>(
          "--slice", [&parts](const std::string& text) { parts.slice = parse_slice(text); },
          "compute only units I, I + N, ... (from 1); in a Slurm array the default is the task's")
      ->needs(folder)
      ->type_name("I/N");
  command.add_flag("--serve", parts.serves, "compute the units whose numbers arrive on standard input, one a line")
      ->needs(folder);
}

/// Adds the command merge with its options. Returns it.
template <class App>
App* add_merge(App& tool, std::string& folder, std::string& out, bool& exit_zero) {
  App* const merge = tool.add_subcommand("merge", "print the output of a run that was computed in parts");
  merge->option_defaults()->group(title::input);
  merge->add_option("FOLDER", folder, "folder of --parts")->required();
  merge->option_defaults()->group(title::output);
  merge->add_option("--out", out, "file to write, completely or not at all (default: standard output)")
      ->type_name("FILE");
  add_exit_zero(*merge, exit_zero);
  return merge;
}

/// Throws ModelError if the parts are wanted with an option that does not fit. table: the output is a table. other: the
/// name of an option with one output for the whole run, or null.
inline void check_parts(const PartsOptions& parts, bool table, const char* other) {
  if (!parts.wanted()) return;
  if (table) throw ModelError("--parts: expected --json, --csv or --npy in addition");
  if (other != nullptr) throw ModelError(std::string("--parts: does not work with ") + other);
  if (parts.serves && parts.slice) throw ModelError("--serve and --slice are both given, expected one of the two");
}

}  // namespace hinge::tool
