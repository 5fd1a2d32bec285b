# SPDX-License-Identifier: BSD-3-Clause
#
# Flags of our own translation units only; nothing here is exported.

add_library(pcl_nurbs_warnings INTERFACE)
target_compile_options(pcl_nurbs_warnings INTERFACE -Wall -Wextra -Wpedantic)

# -DPCL_NURBS_SANITIZE=address,undefined or =thread. Any finding ends the program, so a
# test cannot pass with one. -O1 comes after the build type's flags and rules: -O0 is
# too slow for the numerical tests, and higher levels hide some findings.
if(PCL_NURBS_SANITIZE)
  add_compile_options(-fsanitize=${PCL_NURBS_SANITIZE} -fno-omit-frame-pointer
    -fno-sanitize-recover=all -O1 -g1)
  add_compile_definitions(_GLIBCXX_ASSERTIONS)
  add_link_options(-fsanitize=${PCL_NURBS_SANITIZE})
endif()
