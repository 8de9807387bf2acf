// SPDX-License-Identifier: BSD-3-Clause
// The part of the test of mixed flags that is compiled for the baseline.
#include "isa/doubled.hpp"

namespace hinge::isa {

void store_doubled(const float* from, float* to) { doubled(from).store(to); }

}  // namespace hinge::isa
