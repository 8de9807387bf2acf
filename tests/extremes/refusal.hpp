// SPDX-License-Identifier: BSD-3-Clause
// Returns the message of an exception.
#pragma once

#include <string>

namespace hinge::test {

/// Returns the message of the exception of this type, or "" if nothing is thrown; other types propagate.
template <class Exception, class Action>
std::string refusal(const Action& action) {
  try {
    action();
  } catch (const Exception& error) {
    return error.what();
  }
  return "";
}

}  // namespace hinge::test
