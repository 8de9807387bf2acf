// SPDX-License-Identifier: BSD-3-Clause
// DofChange: one degree of freedom and its new value. A move is a list of DofChange.
#pragma once

#include <cstddef>

namespace hinge {

/// A new value for one selected DOF.
struct DofChange {
  std::size_t dof = 0;  ///< position of the DOF in the selected configuration
  double value = 0.0;   ///< value after the move: rad or model length unit

  /// Orders changes by DOF.
  static bool by_dof(const DofChange& a, const DofChange& b) noexcept { return a.dof < b.dof; }
};

}  // namespace hinge
