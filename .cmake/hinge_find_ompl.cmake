# SPDX-License-Identifier: BSD-3-Clause
# Finds OMPL and adds the target ompl::ompl, which packages of OMPL before 1.6 do not have. Debian's OMPL_LIBRARIES lists
# development files of Boost that its package does not install.
find_package(ompl QUIET)
if(ompl_FOUND AND NOT TARGET ompl::ompl)
  find_library(HINGE_OMPL_LIBRARY ompl PATHS ${OMPL_LIBRARY_DIR} ${OMPL_LIBRARY_DIRS})
  add_library(ompl::ompl INTERFACE IMPORTED)
  set_target_properties(ompl::ompl PROPERTIES INTERFACE_LINK_LIBRARIES ${HINGE_OMPL_LIBRARY}
                                              INTERFACE_INCLUDE_DIRECTORIES ${OMPL_INCLUDE_DIR})
endif()
