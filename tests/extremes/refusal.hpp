// SPDX-License-Identifier: BSD-3-Clause
// refusal: the message a bad input is refused with.
#pragma once

#include <string>

namespace hinge::test {

/// The message of the exception of this type, "" when nothing was thrown; another type leaves the test.
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
