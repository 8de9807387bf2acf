// SPDX-License-Identifier: BSD-3-Clause
// HINGE_ASSERT: internal invariants, checked in debug builds only. Never used for input.
#pragma once

#include <cassert>

#define HINGE_ASSERT(condition) assert(condition)
