// SPDX-License-Identifier: BSD-3-Clause
// Family: a name and a generator of cases.
#pragma once

#include "engine/random_mechanism.hpp"

namespace hinge::test {

template <class Input>
struct Family {
  const char* name;
  Input (*make)(Random&);
  bool refuse = false;
};

}  // namespace hinge::test
