// SPDX-License-Identifier: BSD-3-Clause
// For biocd_fcl and robocd_fcl: these programs have no variants for other instruction sets.
#include "hinge_tools/this_program.hpp"

namespace hinge::tool {
const detail::simd::InstructionSet instruction_set = detail::simd::compiled_for();
const char build_id[] = "with FCL";
const char programs_folder[] = "";
}  // namespace hinge::tool
