// SPDX-License-Identifier: BSD-3-Clause
// Counted: the number of things that share a note, and the description of the first.
#pragma once

#include <cstddef>
#include <string>

namespace hinge::molecular {

struct Counted {
  std::size_t number = 0;
  std::string first{};

  /// Calls describe() for the first thing only.
  template <class Describe>
  void add(const Describe& describe, std::size_t times = 1) {
    if (number == 0) first = describe();
    number += times;
  }
};

}  // namespace hinge::molecular
