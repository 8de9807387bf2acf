// SPDX-License-Identifier: BSD-3-Clause
// DofChange: one degree of freedom and its new value. A move is a list of them.
#pragma once

#include <cstddef>

namespace hinge {

struct DofChange {
  std::size_t dof = 0;  ///< position in the selected configuration
  double value = 0.0;   ///< its value after the move: rad or model length unit
};

}  // namespace hinge
