// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

#include <pcl/segmentation/impl/grid_segmentation.hpp>

#include <pcl/impl/instantiate.hpp>
#include <pcl/point_types.h>

#include <array>
#include <cmath>

PCL_INSTANTIATE(GridSegmentation, PCL_XYZ_POINT_TYPES)
PCL_INSTANTIATE(ConnectedGroupsSegmentation, PCL_XYZ_POINT_TYPES)

namespace pcl {
namespace nurbs {

RGB
labelColor(std::uint32_t label)
{
  if (label == 0)
    return {0, 0, 0};
  // Hues a golden section apart never come close again; brightness in three levels.
  const double hue = std::fmod(label * 0.6180339887498949, 1.0) * 2.0 * M_PI;
  const double value = 255.0 - 45.0 * (label % 3);
  const auto channel = [&](double phase) {
    return static_cast<std::uint8_t>(value * (0.55 + 0.45 * std::cos(hue - phase)));
  };
  return {channel(0.0), channel(2.0 * M_PI / 3.0), channel(4.0 * M_PI / 3.0)};
}

} // namespace nurbs
} // namespace pcl
