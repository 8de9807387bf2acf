# SPDX-License-Identifier: BSD-3-Clause
# hinge_add_library(MODULE): adds hinge_MODULE, a static or shared library (BUILD_SHARED_LIBS), from the caller's
# ${library_sources}. Only what is marked HINGE_API is visible outside the shared library.
function(hinge_add_library module)
  add_library(hinge_${module} ${library_sources})
  add_library(hinge::${module} ALIAS hinge_${module})
  # Before 1.0 every minor version may change the interface.
  set_target_properties(hinge_${module} PROPERTIES EXPORT_NAME ${module} POSITION_INDEPENDENT_CODE ON
                        VERSION ${PROJECT_VERSION} SOVERSION ${PROJECT_VERSION_MAJOR}.${PROJECT_VERSION_MINOR}
                        CXX_VISIBILITY_PRESET hidden VISIBILITY_INLINES_HIDDEN ON)
  target_include_directories(hinge_${module} PUBLIC $<BUILD_INTERFACE:${CMAKE_CURRENT_SOURCE_DIR}/include>
                                                    $<INSTALL_INTERFACE:${CMAKE_INSTALL_INCLUDEDIR}>)
  target_include_directories(hinge_${module} PRIVATE src)
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
