// SPDX-License-Identifier: BSD-3-Clause
// A command-line tool is installed once per instruction set; the plain program hands over to the best the CPU has. By
// exec: programs compiled apart share no inline functions, so none can slip into one that must do without AVX.
#pragma once

#include <fcntl.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstddef>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <string>
#include <string_view>
#include <system_error>

#include "hinge/core/error.hpp"
#include "hinge/detail/simd/instruction_set.hpp"

namespace hinge::tool {

/// What the environment variable HINGE_ISA names, or the best of this CPU. ModelError: another word, or one the CPU
/// lacks.
inline detail::simd::InstructionSet wanted_instruction_set() {
  using detail::simd::InstructionSet;
  const InstructionSet best = detail::simd::of_this_cpu();
  const char* chosen = std::getenv("HINGE_ISA");
  if (chosen == nullptr || *chosen == '\0') return best;
  const auto& names = detail::simd::instruction_set_names;
  const auto found = std::find(names.begin(), names.end(), chosen);
  if (found == names.end())
    throw ModelError("HINGE_ISA is '" + std::string(chosen) + "': expected baseline, avx2 or avx512");
  const auto set = static_cast<InstructionSet>(found - names.begin());
  if (set > best)
    throw ModelError("HINGE_ISA is '" + std::string(chosen) + "', but this CPU has " +
                     std::string(detail::simd::name(best)) + " at most");
  return set;
}

/// Does the open file hold this text (not empty) anywhere? No where it cannot be read.
inline bool file_holds(int file, std::string_view text) {
  constexpr std::size_t chunk = std::size_t{1} << 18;
  std::string part;
  for (;;) {
    part.erase(0, part.size() - std::min(part.size(), text.size() - 1));  // the text may lie across two chunks
    const std::size_t kept = part.size();
    part.resize(kept + chunk);
    const ssize_t got = ::read(file, part.data() + kept, chunk);
    if (got <= 0) return false;
    part.resize(kept + static_cast<std::size_t>(got));
    if (part.find(text) != std::string::npos) return true;
  }
}

/// Replaces this process by the program NAME-avx512 or NAME-avx2 beside it, NAME being its own, when the CPU runs that,
/// or by the one HINGE_ISA names (baseline, avx2, avx512; ModelError as above). Returns when this program is the right
/// one, or the other is not there. Answers are the same on all. LoadError: the other program does not hold build_id,
/// which all programs of one build do; it is not run.
inline void pick_instruction_set(char** argv, std::string_view build_id) {
  using detail::simd::InstructionSet;
  // The other programs run this too, and are never replaced again.
  if (detail::simd::compiled_for() != InstructionSet::baseline) return;
  for (InstructionSet set = wanted_instruction_set(); set != InstructionSet::baseline;
       set = static_cast<InstructionSet>(static_cast<unsigned char>(set) - 1)) {
    std::error_code error;
    const std::filesystem::path own = std::filesystem::read_symlink("/proc/self/exe", error);
    if (error) return;
    const std::string other = own.string() + "-" + std::string(detail::simd::name(set));
    const int file = ::open(other.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK);
    if (file < 0 && errno == ENOENT) continue;
    if (file < 0 || !file_holds(file, build_id))
      throw LoadError(other + ": not of the same build as " + own.string() +
                      "; expected a program built from the same sources (build or install both anew, remove it, or set "
                      "HINGE_ISA=baseline)");
    ::fexecve(file, argv, environ);  // the very file that was looked at
    const std::string reason = std::strerror(errno);
    ::close(file);
    throw LoadError(other + ": cannot be run: " + reason);
  }
}

}  // namespace hinge::tool
