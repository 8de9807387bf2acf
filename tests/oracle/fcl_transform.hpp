// SPDX-License-Identifier: BSD-3-Clause
// Converts poses to FCL's type. The function is local to each source, because FCL's types change with compiler flags.
#pragma once

#include <fcl/common/types.h>

#include <cstddef>

#include "oracle/fcl_oracle.hpp"

namespace hinge::oracle {
namespace {

inline fcl::Transform3d transform(const Placement& p) {
  fcl::Transform3d x = fcl::Transform3d::Identity();
  for (std::size_t r = 0; r < 3; ++r) {
    const auto row = static_cast<int>(r);
    for (std::size_t c = 0; c < 3; ++c) x.linear()(row, static_cast<int>(c)) = p[3 * r + c];
    x.translation()[row] = p[9 + r];
  }
  return x;
}

}  // namespace
}  // namespace hinge::oracle
