# SPDX-License-Identifier: BSD-3-Clause
# Writes OUT, a source file that defines hinge_build_id: TOOL, VERSION and a hash of all sources of the core
# (ROOT/include) and of the module in FOLDER. Programs with equal ids were compiled from the same sources, in any
# folder. Also defines hinge_programs_folder: PROGRAMS, where an installation has the programs for other instruction
# sets, relative to the folder of the tool.
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
extern const char hinge_build_id[];
const char hinge_build_id[] = \"hinge build id: ${TOOL} ${VERSION} ${hash}\";
extern const char hinge_programs_folder[];
const char hinge_programs_folder[] = \"${PROGRAMS}\";
")
