# SPDX-License-Identifier: BSD-3-Clause
#
# Used by our build and, installed, by the package config of those who build on us.
#
# PCL before 1.15.2 exports no targets. The modules of PCL that appear in our headers
# get one imported name each, so that our exported targets can refer to a name that
# this file makes anew on the consumer's side. Imported targets also make PCL's include
# directories system ones: only our own code answers to our warnings.

# pcl_nurbs_import_pcl(<component>...)
# pcl_nurbs::pcl_<component> for each component of PCL that find_package(PCL) found.
function(pcl_nurbs_import_pcl)
  foreach(component ${ARGN})
    if(NOT TARGET pcl_nurbs::pcl_${component})
      string(TOUPPER ${component} upper)
      add_library(pcl_nurbs::pcl_${component} INTERFACE IMPORTED)
      target_include_directories(pcl_nurbs::pcl_${component} INTERFACE ${PCL_INCLUDE_DIRS})
      target_link_libraries(pcl_nurbs::pcl_${component} INTERFACE ${PCL_${upper}_LIBRARIES})
    endif()
  endforeach()
endfunction()
