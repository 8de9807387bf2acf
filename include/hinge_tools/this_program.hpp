// SPDX-License-Identifier: BSD-3-Clause
// What differs between the programs of one tool, and what they must have in common.
#pragma once

#include "hinge/detail/simd/instruction_set.hpp"

// CMake writes the definitions (.cmake/write_build_id.cmake) and compiles them for each program.
namespace hinge::tool {

/// The instruction set of this program. Most sources are compiled once for all programs of a tool, so
/// detail::simd::compiled_for() is the baseline in them.
extern const detail::simd::InstructionSet instruction_set;

/// Equal in all programs that were compiled from the same sources.
extern const char build_id[];

/// Where an installation has the programs for other instruction sets, relative to the folder of the tool.
extern const char programs_folder[];

}  // namespace hinge::tool
