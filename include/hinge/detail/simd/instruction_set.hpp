// SPDX-License-Identifier: BSD-3-Clause
// InstructionSet: the instruction sets that matter for speed, and which of them the code and the CPU support.
#pragma once

#include <array>
#include <cstddef>
#include <string_view>

namespace hinge::detail::simd {

/// avx2 and avx512 mean the levels x86-64-v3 and x86-64-v4. baseline means any lower level or another architecture.
enum class InstructionSet : unsigned char { baseline, avx2, avx512 };

inline constexpr std::array<std::string_view, 3> instruction_set_names = {"baseline", "avx2", "avx512"};

constexpr std::string_view name(InstructionSet set) noexcept {
  return instruction_set_names[static_cast<std::size_t>(set)];
}

/// Returns the instruction set that this translation unit was compiled for.
constexpr InstructionSet compiled_for() noexcept {
#if defined(__AVX512F__) && defined(__AVX512BW__) && defined(__AVX512DQ__) && defined(__AVX512VL__)
  return InstructionSet::avx512;
#elif defined(__AVX2__) && defined(__FMA__)
  return InstructionSet::avx2;
#else
  return InstructionSet::baseline;
#endif
}

/// Returns the best instruction set of this CPU.
inline InstructionSet of_this_cpu() noexcept {
#if defined(__x86_64__)
  __builtin_cpu_init();
  const bool v3 = __builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma") && __builtin_cpu_supports("bmi") &&
                  __builtin_cpu_supports("bmi2") && __builtin_cpu_supports("popcnt");
  const bool v4 = __builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512bw") &&
                  __builtin_cpu_supports("avx512cd") && __builtin_cpu_supports("avx512dq") &&
                  __builtin_cpu_supports("avx512vl");
  if (v3 && v4) return InstructionSet::avx512;
  if (v3) return InstructionSet::avx2;
#endif
  return InstructionSet::baseline;
}

}  // namespace hinge::detail::simd
