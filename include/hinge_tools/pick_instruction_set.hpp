// SPDX-License-Identifier: BSD-3-Clause
// pick_instruction_set: a tool is installed once per instruction set, and the plain program replaces itself by the best
// for the CPU. It uses exec: all code of the plain program is compiled for the baseline, so no AVX code can enter it.
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
#include "hinge_tools/this_program.hpp"

namespace hinge::tool {

/// The instruction set named by the environment variable HINGE_ISA, or the best of this CPU. Throws ModelError if the
/// name is unknown or the CPU lacks the set.
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
    throw ModelError("HINGE_ISA is '" + std::string(chosen) + "', expected at most " +
                     std::string(detail::simd::name(best)) + ", the best instruction set of this CPU");
  return set;
}

/// True if the open file contains this text (not empty). False if the file cannot be read.
inline bool file_holds(int file, std::string_view text) {
  constexpr std::size_t chunk = std::size_t{1} << 18;
  std::string part;
  for (;;) {
    part.erase(0, part.size() - std::min(part.size(), text.size() - 1));  // the text may span two chunks
    const std::size_t kept = part.size();
    part.resize(kept + chunk);
    const ssize_t got = ::read(file, part.data() + kept, chunk);
    if (got <= 0) return false;
    part.resize(kept + static_cast<std::size_t>(got));
    if (part.find(text) != std::string::npos) return true;
  }
}

/// Replaces this process by the program NAME-avx512 or NAME-avx2, where NAME is the name of this program: the best set
/// of the CPU, or the set named by HINGE_ISA (see wanted_instruction_set). The program is looked for next to this one,
/// then in programs_folder. Returns if this program is the right one, or no other exists. All programs give the same
/// answers. Throws LoadError, without running it, if the other program does not contain build_id; also if it cannot be
/// run.
inline void pick_instruction_set(char** argv) {
  using detail::simd::InstructionSet;
  // The replacing programs call this too, and must not be replaced again.
  if (instruction_set != InstructionSet::baseline) return;
  for (InstructionSet set = wanted_instruction_set(); set != InstructionSet::baseline;
       set = static_cast<InstructionSet>(static_cast<unsigned char>(set) - 1)) {
    std::error_code error;
    const std::filesystem::path own = std::filesystem::read_symlink("/proc/self/exe", error);
    if (error) return;
    const std::string name = own.filename().string() + "-" + std::string(detail::simd::name(set));
    std::filesystem::path other = own.parent_path() / name;
    int file = ::open(other.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK);
    if (file < 0 && errno == ENOENT) {
      other = own.parent_path() / programs_folder / name;
      file = ::open(other.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK);
    }
    if (file < 0 && (errno == ENOENT || errno == ENOTDIR)) continue;
    if (file < 0 || !file_holds(file, build_id))
      throw LoadError(other.string() + ": not of the same build as " + own.string() +
                      "; expected a program of the same build (rebuild or reinstall both, remove this program, or set "
                      "HINGE_ISA=baseline)");
    ::fexecve(file, argv, environ);  // exactly the file that was checked
    const std::string reason = std::strerror(errno);
    ::close(file);
    throw LoadError(other.string() + ": cannot be run: " + reason);
  }
}

}  // namespace hinge::tool
