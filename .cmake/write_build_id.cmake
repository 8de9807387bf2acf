# SPDX-License-Identifier: BSD-3-Clause
# Writes OUT, a source file with the definitions of include/hinge_tools/this_program.hpp. build_id: TOOL, VERSION and a
# hash of all sources of the core (ROOT/include) and of the module in FOLDER. Programs with equal ids were compiled from
# the same sources, in any folder. programs_folder: PROGRAMS.
file(GLOB_RECURSE sources ${ROOT}/include/*.hpp ${FOLDER}/include/*.hpp ${FOLDER}/src/*.[hc]pp ${FOLDER}/apps/*.[hc]pp)
list(SORT sources)
set(hashes "")
foreach(source IN LISTS sources)
  file(SHA256 ${source} hash)
  file(RELATIVE_PATH name ${ROOT} ${source})
  string(APPEND hashes "${name} ${hash}\n")
endforeach()
string(SHA256 hash "${hashes}")
file(WRITE ${OUT} "// Made by .cmake/write_build_id.cmake.
#include \"hinge_tools/this_program.hpp\"
namespace hinge::tool {
const detail::simd::InstructionSet instruction_set = detail::simd::compiled_for();
const char build_id[] = \"hinge build id: ${TOOL} ${VERSION} ${hash}\";
const char programs_folder[] = \"${PROGRAMS}\";
}  // namespace hinge::tool
")
