# SPDX-License-Identifier: BSD-3-Clause

find_package(Eigen3 3.4 REQUIRED NO_MODULE)
find_package(Boost 1.74 REQUIRED COMPONENTS iostreams program_options)
find_package(Ceres 2.1 REQUIRED)
find_path(CHOLMOD_INCLUDE_DIR cholmod.h PATH_SUFFIXES suitesparse REQUIRED) # as Ceres uses
find_library(CHOLMOD_LIBRARY cholmod REQUIRED)
find_library(CCOLAMD_LIBRARY ccolamd REQUIRED)
find_package(PCL 1.12 REQUIRED COMPONENTS common search io registration QUIET)
find_package(nlohmann_json 3.9 REQUIRED)
find_package(PNG REQUIRED)
find_package(PkgConfig REQUIRED)
pkg_check_modules(ZSTD REQUIRED IMPORTED_TARGET libzstd)
pkg_check_modules(CAIRO REQUIRED IMPORTED_TARGET cairo) # plots of the tools
pkg_check_modules(YAML_CPP REQUIRED IMPORTED_TARGET yaml-cpp) # their settings
find_package(OpenMP REQUIRED COMPONENTS CXX)
find_package(Threads REQUIRED)

include(PclNurbsPcl)
pcl_nurbs_import_pcl(common search io registration)
