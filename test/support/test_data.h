// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

#pragma once

#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <string>

namespace pcl {
namespace nurbs {
namespace test {

/** Folder of the public data sets that the project uses but does not ship: environment
 * variable PCL_NURBS_DATA, else the default CMake was given. */
inline std::filesystem::path
dataRoot()
{
  const char* root = std::getenv("PCL_NURBS_DATA");
  return root != nullptr ? root : PCL_NURBS_DEFAULT_DATA;
}

} // namespace test
} // namespace nurbs
} // namespace pcl

/** Names a file or folder of the data sets, or skips the test when it is not there. */
#define PCL_NURBS_DATA_OR_SKIP(variable, relative)                                     \
  const std::filesystem::path variable = pcl::nurbs::test::dataRoot() / (relative);    \
  if (!std::filesystem::exists(variable))                                              \
  GTEST_SKIP() << "data set file " << (variable) << " is not there"
