# SPDX-License-Identifier: BSD-3-Clause
# hinge_add_tool(NAME LIBRARY [SYSTEM_INCLUDES DIR...] [LIBRARIES TARGET...]): adds the command-line tool NAME from the
# caller's apps/*.cpp and LIBRARY. The private dependencies of LIBRARY are given again.
find_package(CLI11 QUIET)
find_package(nlohmann_json QUIET)
find_package(fmt QUIET)

set(HINGE_TOOL_LEVELS "x86-64-v3;x86-64-v4" CACHE STRING
    "On x86-64: the levels that tools have programs of their own for, beside the baseline's")

# Adds PROGRAM_build_id, the object of the generated source BUILD_ID. It is a target of its own, because CMake generates
# the source of a target after building the target's libraries, and compiles no object of the target before that. This
# target has no compiled library, so the objects of the program need not wait.
function(hinge_add_build_id program build_id)
  add_library(${program}_build_id OBJECT ${build_id})
  target_link_libraries(${program}_build_id PRIVATE hinge hinge_own)
endfunction()

function(hinge_add_tool tool library)
  cmake_parse_arguments(PARSE_ARGV 2 needs "" "" "SYSTEM_INCLUDES;LIBRARIES")
  # The tool is for developers and for installations, not for a host project that links the library.
  if(NOT PROJECT_IS_TOP_LEVEL AND NOT HINGE_INSTALL)
    return()
  endif()
  set(missing "")
  foreach(package CLI11 nlohmann_json fmt TBB)
    if(NOT ${package}_FOUND)
      string(APPEND missing " ${package}")
    endif()
  endforeach()
  if(missing)
    message(STATUS "${tool} is left out. Not found:${missing} (Debian: libcli11-dev nlohmann-json3-dev libfmt-dev "
                   "libtbb-dev)")
    return()
  endif()
  if(NOT TARGET hinge_report)
    add_subdirectory(${PROJECT_SOURCE_DIR}/report ${PROJECT_BINARY_DIR}/report)
  endif()
  file(GLOB sources CONFIGURE_DEPENDS apps/*.cpp)
  # The tool starts a program for another instruction set only if both were built from the same sources.
  file(RELATIVE_PATH programs_from_bin /${CMAKE_INSTALL_BINDIR} /${CMAKE_INSTALL_LIBEXECDIR}/hinge)
  set(build_id ${CMAKE_CURRENT_BINARY_DIR}/build_id.cpp)
  set(write_build_id ${PROJECT_SOURCE_DIR}/.cmake/write_build_id.cmake)
  file(GLOB_RECURSE hashed CONFIGURE_DEPENDS ${PROJECT_SOURCE_DIR}/include/*.hpp include/*.hpp src/*.[hc]pp
       apps/*.[hc]pp ${PROJECT_SOURCE_DIR}/report/dist/*.html)
  add_custom_command(OUTPUT ${build_id} DEPENDS ${hashed} ${write_build_id} VERBATIM
                     COMMAND ${CMAKE_COMMAND} -DOUT=${build_id} -DTOOL=${tool} -DVERSION=${PROJECT_VERSION}
                             -DROOT=${PROJECT_SOURCE_DIR} -DFOLDER=${CMAKE_CURRENT_SOURCE_DIR}
                             -DPROGRAMS=${programs_from_bin} -P ${write_build_id})
  hinge_add_build_id(${tool} ${build_id})
  set(libraries hinge_ensemble hinge_own hinge_report CLI11::CLI11 nlohmann_json::nlohmann_json fmt::fmt)
  add_library(${tool}_once STATIC ${sources})
  set_target_properties(${tool}_once PROPERTIES UNITY_BUILD_BATCH_SIZE 0)
  # Not linked to ${library}: a program for another instruction set has its own copy of that code.
  target_include_directories(${tool}_once PRIVATE include)
  target_link_libraries(${tool}_once PRIVATE ${libraries})
  add_executable(${tool} $<TARGET_OBJECTS:${tool}_build_id>)
  set_target_properties(${tool} PROPERTIES LINKER_LANGUAGE CXX)
  target_link_libraries(${tool} PRIVATE ${tool}_once ${library} ${libraries})
  set(programs ${tool})
  # One more program per instruction set, for Release builds. The tool starts the best one. A program's own objects come
  # before the libraries in the linker's command. So where both have an inline function, the linker takes the copy for
  # the program's instruction set.
  if(CMAKE_SYSTEM_PROCESSOR MATCHES "x86_64|AMD64" AND CMAKE_BUILD_TYPE STREQUAL "Release")
    get_target_property(library_sources ${library} HINGE_REPEATED_SOURCES)
    set(x86-64-v3 avx2)
    set(x86-64-v4 avx512)
    foreach(level x86-64-v3 x86-64-v4)
      if(NOT level IN_LIST HINGE_TOOL_LEVELS)  # otherwise an outdated program of an earlier build would be run
        file(REMOVE ${CMAKE_RUNTIME_OUTPUT_DIRECTORY}/${tool}-${${level}})
      endif()
    endforeach()
    foreach(level IN LISTS HINGE_TOOL_LEVELS)
      set(name ${${level}})
      if(NOT name)
        message(FATAL_ERROR "HINGE_TOOL_LEVELS has '${level}', expected x86-64-v3 and x86-64-v4")
      endif()
      hinge_add_build_id(${tool}-${name} ${build_id})
      add_dependencies(${tool}-${name}_build_id ${tool}_build_id)  # so that only one job of make generates the source
      add_executable(${tool}-${name} $<TARGET_OBJECTS:${tool}-${name}_build_id> ${library_sources})
      set_target_properties(${tool}-${name} PROPERTIES UNITY_BUILD_BATCH_SIZE 0)
      foreach(target ${tool}-${name} ${tool}-${name}_build_id)
        target_compile_options(${target} PRIVATE -march=${level})
      endforeach()
      target_include_directories(${tool}-${name} PRIVATE include src)
      target_include_directories(${tool}-${name} SYSTEM PRIVATE ${needs_SYSTEM_INCLUDES})
      target_link_libraries(${tool}-${name} PRIVATE ${tool}_once ${library}_once ${libraries} ${needs_LIBRARIES})
      add_dependencies(${tool} ${tool}-${name})
      list(APPEND programs ${tool}-${name})
    endforeach()
  endif()
  # The manual page and the completion are made from the command line's own description.
  set(pages "")
  if(NOT CMAKE_CROSSCOMPILING)
    set(pages ${tool}.1 ${tool}.bash ${tool}.zsh ${tool}.fish)
    add_custom_command(OUTPUT ${pages} DEPENDS ${tool} VERBATIM
                       COMMAND ${tool} --man > ${tool}.1
                       COMMAND ${tool} --completion bash > ${tool}.bash
                       COMMAND ${tool} --completion zsh > ${tool}.zsh
                       COMMAND ${tool} --completion fish > ${tool}.fish)
    add_custom_target(${tool}_pages ALL DEPENDS ${pages})
  endif()
  if(HINGE_INSTALL)
    file(RELATIVE_PATH from_bin /${CMAKE_INSTALL_BINDIR} /${CMAKE_INSTALL_LIBDIR})
    set_target_properties(${tool} PROPERTIES INSTALL_RPATH $ORIGIN/${from_bin})
    list(REMOVE_ITEM programs ${tool})
    install(TARGETS ${tool})
    install(TARGETS ${programs} DESTINATION ${CMAKE_INSTALL_LIBEXECDIR}/hinge)
    if(pages)
      set(made ${CMAKE_CURRENT_BINARY_DIR})
      install(FILES ${made}/${tool}.1 DESTINATION ${CMAKE_INSTALL_MANDIR}/man1)
      install(FILES ${made}/${tool}.bash DESTINATION ${CMAKE_INSTALL_DATADIR}/bash-completion/completions RENAME ${tool})
      install(FILES ${made}/${tool}.zsh DESTINATION ${CMAKE_INSTALL_DATADIR}/zsh/vendor-completions RENAME _${tool})
      install(FILES ${made}/${tool}.fish DESTINATION ${CMAKE_INSTALL_DATADIR}/fish/vendor_completions.d)
    endif()
  endif()
endfunction()
