# SPDX-License-Identifier: BSD-3-Clause

find_package(Eigen3 3.4 REQUIRED NO_MODULE)
find_package(Boost 1.74 REQUIRED COMPONENTS program_options)
find_package(Ceres 2.1 REQUIRED)
find_package(PCL 1.12 REQUIRED COMPONENTS common search io QUIET)
find_package(nlohmann_json 3.9 REQUIRED)
find_package(PNG REQUIRED)
find_package(PkgConfig REQUIRED)
pkg_check_modules(ZSTD REQUIRED IMPORTED_TARGET libzstd)
find_package(OpenMP REQUIRED COMPONENTS CXX)

# PCL before 1.15.2 exports no targets: give its flags one name each. Its include
# directories are system ones, so that only our own code answers to our warnings.
add_library(pcl_nurbs_pcl INTERFACE)
target_include_directories(pcl_nurbs_pcl SYSTEM INTERFACE ${PCL_INCLUDE_DIRS})
target_link_libraries(pcl_nurbs_pcl INTERFACE ${PCL_COMMON_LIBRARIES}
  ${PCL_SEARCH_LIBRARIES} ${PCL_KDTREE_LIBRARIES} ${PCL_OCTREE_LIBRARIES})
