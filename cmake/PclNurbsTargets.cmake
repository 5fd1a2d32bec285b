# SPDX-License-Identifier: BSD-3-Clause
#
# Targets in the shape of PCL's own macros, which PCL does not install.

include(GenerateExportHeader)
include(GNUInstallDirs)

# pcl_nurbs_add_library(<module> EXPORT_HEADER <path> SOURCES <files...>
#                       MODULES <modules...> PCL <components...>
#                       PCL_PRIVATE <components...>
#                       LINK_PUBLIC <libs...> LINK_PRIVATE <libs...>)
# Library pcl_nurbs_<module> with alias pcl_nurbs::<module>, its headers under
# <module>/include, and the export header <EXPORT_HEADER>. MODULES are all of ours that
# it builds on, lowest first, PCL the components of PCL that its headers need: both
# become public dependencies of the target and of the installed package.
function(pcl_nurbs_add_library module)
  cmake_parse_arguments(ARG "" "EXPORT_HEADER"
    "SOURCES;MODULES;PCL;PCL_PRIVATE;LINK_PUBLIC;LINK_PRIVATE" ${ARGN})
  set(target pcl_nurbs_${module})
  add_library(${target} ${ARG_SOURCES})
  add_library(pcl_nurbs::${module} ALIAS ${target})
  set_target_properties(${target} PROPERTIES
    EXPORT_NAME ${module}
    VERSION ${PROJECT_VERSION}
    SOVERSION ${PROJECT_VERSION_MAJOR}.${PROJECT_VERSION_MINOR}
    CXX_VISIBILITY_PRESET hidden
    VISIBILITY_INLINES_HIDDEN ON
    POSITION_INDEPENDENT_CODE ON
    INSTALL_RPATH "$ORIGIN")
  string(TOUPPER ${module} upper)
  generate_export_header(${target}
    BASE_NAME ${target}
    EXPORT_MACRO_NAME PCL_NURBS_${upper}_EXPORT
    STATIC_DEFINE PCL_NURBS_${upper}_STATIC
    EXPORT_FILE_NAME ${CMAKE_CURRENT_BINARY_DIR}/include/${ARG_EXPORT_HEADER})
  if(NOT BUILD_SHARED_LIBS)
    target_compile_definitions(${target} PUBLIC PCL_NURBS_${upper}_STATIC)
  endif()
  target_include_directories(${target}
    PUBLIC
      $<BUILD_INTERFACE:${CMAKE_CURRENT_SOURCE_DIR}/include>
      $<BUILD_INTERFACE:${CMAKE_CURRENT_BINARY_DIR}/include>
      $<INSTALL_INTERFACE:${PCL_NURBS_INCLUDE_DIR}>
    PRIVATE ${CMAKE_CURRENT_SOURCE_DIR}/src)
  target_compile_features(${target} PUBLIC cxx_std_17)
  list(TRANSFORM ARG_MODULES PREPEND pcl_nurbs:: OUTPUT_VARIABLE modules)
  list(TRANSFORM ARG_PCL PREPEND pcl_nurbs::pcl_ OUTPUT_VARIABLE pcl)
  list(TRANSFORM ARG_PCL_PRIVATE PREPEND pcl_nurbs::pcl_ OUTPUT_VARIABLE pcl_private)
  target_link_libraries(${target}
    PUBLIC ${modules} ${pcl} ${ARG_LINK_PUBLIC}
    PRIVATE ${pcl_private} ${ARG_LINK_PRIVATE} $<BUILD_INTERFACE:pcl_nurbs_warnings>)
  if(NOT BUILD_SHARED_LIBS) # a static library passes its private dependencies on
    list(APPEND ARG_PCL ${ARG_PCL_PRIVATE})
  endif()
  pcl_nurbs_package_module(${module} MODULES ${ARG_MODULES} PCL ${ARG_PCL})
endfunction()

# pcl_nurbs_add_executable(<name> SOURCES <files...> LINK_WITH <libs...>)
function(pcl_nurbs_add_executable name)
  cmake_parse_arguments(ARG "" "" "SOURCES;LINK_WITH" ${ARGN})
  add_executable(${name} ${ARG_SOURCES})
  target_link_libraries(${name} PRIVATE ${ARG_LINK_WITH} pcl_nurbs_warnings)
  file(RELATIVE_PATH to_lib ${CMAKE_INSTALL_FULL_BINDIR} ${CMAKE_INSTALL_FULL_LIBDIR})
  set_target_properties(${name} PROPERTIES INSTALL_RPATH "$ORIGIN/${to_lib}")
  install(TARGETS ${name} RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR} COMPONENT tools)
endfunction()

# pcl_nurbs_add_test(<name> SOURCES <files...> LINK_WITH <libs...>)
# One gtest program, one ctest entry: loading PCL's libraries for each of thousands of
# law tests would take longer than the tests.
function(pcl_nurbs_add_test name)
  cmake_parse_arguments(ARG "" "" "SOURCES;LINK_WITH" ${ARGN})
  add_executable(${name} ${ARG_SOURCES})
  target_include_directories(${name} PRIVATE ${PROJECT_SOURCE_DIR}/test/support)
  target_link_libraries(${name} PRIVATE ${ARG_LINK_WITH} pcl_nurbs_warnings GTest::gtest_main)
  target_compile_definitions(${name} PRIVATE
    PCL_NURBS_TEST_DATA="${PROJECT_SOURCE_DIR}/test/data"
    PCL_NURBS_DEFAULT_DATA="${PCL_NURBS_DATA}")
  add_test(NAME ${name} COMMAND ${name} --gtest_brief=1)
  # Without the data sets some programs have nothing to run: no test passed, none failed.
  set_tests_properties(${name} PROPERTIES
    TIMEOUT 600
    SKIP_REGULAR_EXPRESSION
      "PASSED  \\] 0 tests[.][\r\n]+.  SKIPPED . [0-9]+ tests?[.][\r\n]*$")
endfunction()
