# SPDX-License-Identifier: BSD-3-Clause
#
# Flags of our own translation units only; nothing here is exported.

add_library(pcl_nurbs_warnings INTERFACE)
target_compile_options(pcl_nurbs_warnings INTERFACE -Wall -Wextra -Wpedantic)
if(PCL_NURBS_SANITIZE)
  add_compile_options(-fsanitize=${PCL_NURBS_SANITIZE} -fno-omit-frame-pointer
    -fno-sanitize-recover=all -g)
  add_link_options(-fsanitize=${PCL_NURBS_SANITIZE})
endif()
