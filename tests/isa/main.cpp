// SPDX-License-Identifier: BSD-3-Clause
// Compiled for the baseline, and shares no inline functions with answers.cpp, because the linker could keep the copy of
// answers.cpp. Exit status 0: answers are equal; 1: they differ; 77: this CPU lacks the instruction set.
#include <cstdio>

#include "hinge/detail/simd/instruction_set.hpp"
#include "isa/answers.hpp"

int main() {
  const auto best = static_cast<unsigned>(hinge::detail::simd::of_this_cpu());
  if (needed_instruction_set > best) {
    std::printf("skipped: compiled for instruction set %u, this CPU has %u (baseline 0, avx2 1, avx512 2)\n",
                static_cast<unsigned>(needed_instruction_set), best);
    return 77;
  }
  return compare_answers() == 0 ? 0 : 1;
}
