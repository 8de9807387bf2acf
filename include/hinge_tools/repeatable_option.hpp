// SPDX-License-Identifier: BSD-3-Clause
// repeatable: an option that may be given several times.
#pragma once

namespace hinge::tool {

/// Lets a CLI11 option be given several times, with one value each. The word after the value is a new argument. type:
/// the placeholder of the value in help. Returns the option.
template <class Option>
Option* repeatable(Option* option, const char* type) {
  return option->allow_extra_args(false)->type_name(type);
}

}  // namespace hinge::tool
