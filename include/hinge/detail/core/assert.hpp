// SPDX-License-Identifier: BSD-3-Clause
// HINGE_ASSERT: checks internal invariants in debug builds. It never validates input.
#pragma once

#include <cassert>

#define HINGE_ASSERT(condition) assert(condition)
