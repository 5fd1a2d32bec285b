# SPDX-License-Identifier: BSD-3-Clause
#
# What is installed beside the libraries: package config, version file, pkg-config
# files. One export set per module, so that asking for COMPONENTS surface neither loads
# nor needs what only mapping needs.

include(CMakePackageConfigHelpers)

set(PCL_NURBS_PACKAGE_DIR ${CMAKE_INSTALL_LIBDIR}/cmake/pcl_nurbs)

# PCL's own .pc files are named pcl_<component> in all supported versions.
function(pcl_nurbs_install_pkg_config module)
  cmake_parse_arguments(ARG "" "" "MODULES;PCL" ${ARGN})
  set(PC_NAME pcl_nurbs_${module})
  list(TRANSFORM ARG_MODULES PREPEND pcl_nurbs_)
  list(TRANSFORM ARG_PCL PREPEND pcl_)
  list(JOIN ARG_MODULES " " modules)
  list(JOIN ARG_PCL " " pcl)
  string(STRIP "eigen3 ${pcl} ${modules}" PC_REQUIRES)
  file(RELATIVE_PATH PC_PREFIX
    ${CMAKE_INSTALL_FULL_LIBDIR}/pkgconfig ${CMAKE_INSTALL_PREFIX})
  string(REGEX REPLACE "/$" "" PC_PREFIX "${PC_PREFIX}")
  configure_file(${PROJECT_SOURCE_DIR}/cmake/pcl_nurbs.pc.in
    ${PROJECT_BINARY_DIR}/${PC_NAME}.pc @ONLY)
  install(FILES ${PROJECT_BINARY_DIR}/${PC_NAME}.pc
    DESTINATION ${CMAKE_INSTALL_LIBDIR}/pkgconfig COMPONENT ${module})
endfunction()

# pcl_nurbs_package_module(<module> MODULES <modules...> PCL <components...>)
# Install the library, its headers, its exported target and its .pc file, and note its
# dependencies for the package config.
function(pcl_nurbs_package_module module)
  cmake_parse_arguments(ARG "" "" "MODULES;PCL" ${ARGN})
  install(TARGETS pcl_nurbs_${module} EXPORT pcl_nurbs-${module}
    ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR} COMPONENT ${module}
    LIBRARY DESTINATION ${CMAKE_INSTALL_LIBDIR} COMPONENT ${module}
    RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR} COMPONENT ${module})
  install(DIRECTORY include/ ${CMAKE_CURRENT_BINARY_DIR}/include/
    DESTINATION ${PCL_NURBS_INCLUDE_DIR} COMPONENT ${module})
  install(EXPORT pcl_nurbs-${module} NAMESPACE pcl_nurbs::
    DESTINATION ${PCL_NURBS_PACKAGE_DIR} COMPONENT ${module})
  pcl_nurbs_install_pkg_config(${module} MODULES ${ARG_MODULES} PCL ${ARG_PCL})
  set_property(GLOBAL APPEND PROPERTY PCL_NURBS_MODULES ${module})
  list(JOIN ARG_MODULES " " modules)
  list(JOIN ARG_PCL " " pcl)
  string(CONCAT rows
    "set(_pcl_nurbs_${module}_modules ${modules})\n"
    "set(_pcl_nurbs_${module}_pcl ${pcl})\n")
  set_property(GLOBAL APPEND_STRING PROPERTY PCL_NURBS_MODULE_TABLE "${rows}")
endfunction()

# pcl_nurbs_install_package()
# Package config and version file; call once, after all modules.
function(pcl_nurbs_install_package)
  get_property(PCL_NURBS_MODULES GLOBAL PROPERTY PCL_NURBS_MODULES)
  list(JOIN PCL_NURBS_MODULES " " PCL_NURBS_MODULES)
  get_property(PCL_NURBS_MODULE_TABLE GLOBAL PROPERTY PCL_NURBS_MODULE_TABLE)
  configure_package_config_file(${PROJECT_SOURCE_DIR}/cmake/pcl_nurbs-config.cmake.in
    ${PROJECT_BINARY_DIR}/pcl_nurbs-config.cmake
    INSTALL_DESTINATION ${PCL_NURBS_PACKAGE_DIR}
    NO_SET_AND_CHECK_MACRO)
  write_basic_package_version_file(${PROJECT_BINARY_DIR}/pcl_nurbs-config-version.cmake
    COMPATIBILITY SameMinorVersion)
  install(FILES
    ${PROJECT_BINARY_DIR}/pcl_nurbs-config.cmake
    ${PROJECT_BINARY_DIR}/pcl_nurbs-config-version.cmake
    ${PROJECT_SOURCE_DIR}/cmake/PclNurbsPcl.cmake
    DESTINATION ${PCL_NURBS_PACKAGE_DIR} COMPONENT package)
endfunction()
