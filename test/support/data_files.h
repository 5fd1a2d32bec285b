// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

#pragma once

#include <pcl/mapping/cloud_reader.h>

#include <algorithm>
#include <filesystem>
#include <string>
#include <vector>

namespace pcl {
namespace nurbs {
namespace test {

/** Files below a folder with an extension, sorted, at most so many; a file is itself.
 */
inline std::vector<std::filesystem::path>
filesIn(const std::filesystem::path& place,
        const std::string& extension,
        std::size_t most)
{
  if (std::filesystem::is_regular_file(place))
    return {place};
  std::vector<std::filesystem::path> files;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(place))
    if (entry.path().extension() == extension)
      files.push_back(entry.path());
  std::sort(files.begin(), files.end());
  files.resize(std::min(files.size(), most));
  return files;
}

/** Depth images of so many units per metre. */
inline CloudReadOptions
depthScale(double scale)
{
  CloudReadOptions options;
  options.depth_scale = scale;
  return options;
}

/** .bin files of (x, y, z) only. */
inline CloudReadOptions
withoutReflectance()
{
  CloudReadOptions options;
  options.bin_values_per_point = 3;
  return options;
}

} // namespace test
} // namespace nurbs
} // namespace pcl
