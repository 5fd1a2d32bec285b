// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

#pragma once

#include <fstream>
#include <iterator>
#include <string>

namespace pcl {
namespace nurbs {

/** \brief Whole content of a file.
 * \throws Error "PATH: cannot be opened" or "PATH: cannot be read" */
template <class Error>
std::string
textOfFile(const std::string& path)
{
  std::ifstream file(path, std::ios::binary);
  if (!file)
    throw Error(path + ": cannot be opened");
  std::string text{std::istreambuf_iterator<char>(file), {}};
  if (file.bad())
    throw Error(path + ": cannot be read");
  return text;
}

} // namespace nurbs
} // namespace pcl
