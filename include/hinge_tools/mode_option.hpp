// SPDX-License-Identifier: BSD-3-Clause
// add_mode: the option --mode.
#pragma once

#include <string>

#include "hinge/core/error.hpp"
#include "hinge/query/mode.hpp"
#include "hinge_tools/number_option.hpp"

namespace hinge::tool {

/// Adds --mode to a CLI11 command. `mode` gets the text after a check (ModelError). unit: of D, in messages. help: what
/// the modes mean.
template <class Command>
void add_mode(Command& command, std::string& mode, const std::string& unit, const std::string& help) {
  command
      .template add_option_function<std::string>(
          "--mode",
          [&mode, unit](const std::string& text) {
            if (Mode::parse(text, unit).margin > largest_length)
              throw ModelError("--mode '" + text + "': expected D in " + unit + ", at most 1e+09");
            mode = text;
          },
          help)
      ->default_str(mode)
      ->type_name("any|all|within:D|closest");
}

}  // namespace hinge::tool
