# SPDX-License-Identifier: BSD-3-Clause
# hinge_add_library(MODULE FOLDER... [SYSTEM_INCLUDES DIR...] [LIBRARIES TARGET...]): adds hinge_MODULE, a static or
# shared library (BUILD_SHARED_LIBS), from the caller's src/*/*.cpp. Only what is marked HINGE_API is visible outside the
# shared library. FOLDER...: the folders of src whose code runs for every configuration. Programs for other instruction
# sets compile these again (property HINGE_REPEATED_SOURCES). The other folders are compiled once, as hinge_MODULE_once.
# SYSTEM_INCLUDES and LIBRARIES: private dependencies.
function(hinge_add_library module)
  cmake_parse_arguments(PARSE_ARGV 1 needs "" "" "SYSTEM_INCLUDES;LIBRARIES")
  file(GLOB sources CONFIGURE_DEPENDS src/*/*.cpp)
  list(JOIN needs_UNPARSED_ARGUMENTS "|" folders)
  set(repeated ${sources})
  list(FILTER repeated INCLUDE REGEX "/src/(${folders})/")
  list(REMOVE_ITEM sources ${repeated})
  add_library(hinge_${module}_once STATIC ${sources})
  add_library(hinge_${module} ${repeated} $<TARGET_OBJECTS:hinge_${module}_once>)
  add_library(hinge::${module} ALIAS hinge_${module})
  target_link_libraries(hinge_${module} PUBLIC hinge)
  target_link_libraries(hinge_${module}_once PRIVATE hinge)
  foreach(target hinge_${module} hinge_${module}_once)
    set_target_properties(${target} PROPERTIES POSITION_INDEPENDENT_CODE ON CXX_VISIBILITY_PRESET hidden
                                               VISIBILITY_INLINES_HIDDEN ON UNITY_BUILD_BATCH_SIZE 0)
    target_include_directories(${target} PUBLIC $<BUILD_INTERFACE:${CMAKE_CURRENT_SOURCE_DIR}/include>
                                                $<INSTALL_INTERFACE:${CMAKE_INSTALL_INCLUDEDIR}>)
    target_include_directories(${target} PRIVATE src)
    target_include_directories(${target} SYSTEM PRIVATE ${needs_SYSTEM_INCLUDES})
    target_link_libraries(${target} PRIVATE ${needs_LIBRARIES} $<BUILD_INTERFACE:hinge_own>)
  endforeach()
  # Before 1.0 every minor version may change the interface.
  set_target_properties(hinge_${module} PROPERTIES EXPORT_NAME ${module} HINGE_REPEATED_SOURCES "${repeated}"
                        VERSION ${PROJECT_VERSION} SOVERSION ${PROJECT_VERSION_MAJOR}.${PROJECT_VERSION_MINOR})
endfunction()

# hinge_install_library(MODULE DESCRIPTION REQUIRES LIBS): installs hinge_MODULE, its headers, and hinge-MODULE.pc for
# pkg-config. REQUIRES: pkg-config modules; LIBS: linker flags. Both are for users of the static library.
function(hinge_install_library module description requires libs)
  if(NOT HINGE_INSTALL)
    return()
  endif()
  install(DIRECTORY include/hinge DESTINATION ${CMAKE_INSTALL_INCLUDEDIR} FILES_MATCHING PATTERN "*.hpp")
  install(TARGETS hinge_${module} EXPORT hinge-${module})
  install(EXPORT hinge-${module} NAMESPACE hinge:: DESTINATION ${hinge_package_dir})
  if(BUILD_SHARED_LIBS)
    set(pc_requires_private ${requires})
  else()
    set(pc_requires ${requires})
    set(pc_libs ${libs})
  endif()
  configure_file(${PROJECT_SOURCE_DIR}/.cmake/hinge-module.pc.in hinge-${module}.pc @ONLY)
  install(FILES ${CMAKE_CURRENT_BINARY_DIR}/hinge-${module}.pc DESTINATION ${CMAKE_INSTALL_LIBDIR}/pkgconfig)
endfunction()
