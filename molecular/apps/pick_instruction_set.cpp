// SPDX-License-Identifier: BSD-3-Clause
// By exec: programs compiled apart share no inline functions, so none can slip into one that must do without AVX.
#include "pick_instruction_set.hpp"

#include <unistd.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <string>
#include <system_error>

#include "hinge/core/error.hpp"
#include "hinge/simd/instruction_set.hpp"

namespace biocd {

namespace {

using hinge::simd::InstructionSet;

InstructionSet wanted() {
  const InstructionSet best = hinge::simd::of_this_cpu();
  const char* chosen = std::getenv("HINGE_ISA");
  if (chosen == nullptr || *chosen == '\0') return best;
  const auto& names = hinge::simd::instruction_set_names;
  const auto found = std::find(names.begin(), names.end(), chosen);
  if (found == names.end())
    throw hinge::ModelError("HINGE_ISA is '" + std::string(chosen) + "': expected baseline, avx2 or avx512");
  const auto set = static_cast<InstructionSet>(found - names.begin());
  if (set > best)
    throw hinge::ModelError("HINGE_ISA is '" + std::string(chosen) + "', but this CPU has " +
                            std::string(hinge::simd::name(best)) + " at most");
  return set;
}

}  // namespace

void pick_instruction_set(char** argv) {
  // The other programs run this too, and are never replaced again.
  if (hinge::simd::compiled_for() != InstructionSet::baseline) return;
  for (InstructionSet set = wanted(); set != InstructionSet::baseline;
       set = static_cast<InstructionSet>(static_cast<unsigned char>(set) - 1)) {
    std::error_code error;
    const std::filesystem::path own = std::filesystem::read_symlink("/proc/self/exe", error);
    if (error) return;
    const std::string other = own.string() + "-" + std::string(hinge::simd::name(set));
    ::execv(other.c_str(), argv);  // comes back only when it is not there: then the next lower one
  }
}

}  // namespace biocd
