# SPDX-License-Identifier: BSD-3-Clause
#
# Install what was built into a prefix of its own, then build and run a project against
# it: once by find_package, once by pkg-config. Arguments: BUILD_DIR, SOURCE_DIR,
# WORK_DIR, MODULES, CONFIG, COMPILER, FLAGS, LIBDIR.

function(run)
  execute_process(COMMAND ${ARGN} RESULT_VARIABLE result)
  if(NOT result EQUAL 0)
    list(JOIN ARGN " " command)
    message(FATAL_ERROR "failed (${result}): ${command}")
  endif()
endfunction()

# The prefix is moved after the installation: a package must be relocatable.
file(REMOVE_RECURSE ${WORK_DIR})
foreach(component ${MODULES} package)
  run(${CMAKE_COMMAND} --install ${BUILD_DIR} --config ${CONFIG}
    --prefix ${WORK_DIR}/staging --component ${component})
endforeach()
file(RENAME ${WORK_DIR}/staging ${WORK_DIR}/prefix)

run(${CMAKE_COMMAND} -S ${SOURCE_DIR} -B ${WORK_DIR}/build
  -DCMAKE_PREFIX_PATH=${WORK_DIR}/prefix
  -DCMAKE_FIND_USE_PACKAGE_REGISTRY=OFF
  -DCMAKE_BUILD_TYPE=${CONFIG} -DCMAKE_CXX_COMPILER=${COMPILER} -DCMAKE_CXX_FLAGS=${FLAGS})
run(${CMAKE_COMMAND} --build ${WORK_DIR}/build --config ${CONFIG})
run(${WORK_DIR}/build/use_surface)

find_program(PKG_CONFIG pkg-config REQUIRED)
set(ENV{PKG_CONFIG_PATH} ${WORK_DIR}/prefix/${LIBDIR}/pkgconfig)
execute_process(COMMAND ${PKG_CONFIG} --cflags --libs pcl_nurbs_surface
  OUTPUT_VARIABLE flags RESULT_VARIABLE result OUTPUT_STRIP_TRAILING_WHITESPACE)
if(NOT result EQUAL 0)
  message(FATAL_ERROR "pkg-config does not find pcl_nurbs_surface")
endif()
separate_arguments(flags UNIX_COMMAND "${flags}")
separate_arguments(FLAGS UNIX_COMMAND "${FLAGS}")
run(${COMPILER} -std=c++17 ${FLAGS} ${SOURCE_DIR}/use_surface.cpp
  -o ${WORK_DIR}/use_surface ${flags} -Wl,-rpath,${WORK_DIR}/prefix/${LIBDIR})
run(${WORK_DIR}/use_surface)
