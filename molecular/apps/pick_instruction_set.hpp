// SPDX-License-Identifier: BSD-3-Clause
// The tool is installed once per instruction set; the plain one hands over to the best the CPU has.
#pragma once

namespace biocd {

/// Replaces this process by the program `biocd-avx512` or `biocd-avx2` beside it when the CPU runs that, or by the one
/// the environment variable HINGE_ISA names (baseline, avx2, avx512; ModelError otherwise, or when the CPU lacks it).
/// Returns when this program is the right one, or the other is not there. Answers are the same on all.
void pick_instruction_set(char** argv);

}  // namespace biocd
