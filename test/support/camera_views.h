// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

#pragma once

#include "grid_clouds.h"

#include <pcl/segmentation/sensor_noise.h>

#include <cmath>
#include <cstdint>
#include <random>
#include <vector>

namespace pcl {
namespace nurbs {
namespace test {

constexpr int kWidth = 160;
constexpr int kHeight = 120;

inline GridGeometry
camera()
{
  return GridGeometry::pinhole(kWidth, kHeight, {130.0, 130.0, 79.5, 59.5});
}

inline SensorNoise
constantNoise(double sigma)
{
  SensorNoise noise;
  noise.constant = sigma;
  return noise;
}

/** A camera's view of a depth function with Gaussian noise along z. */
template <typename Depth>
GridPoints
noisyView(const Depth& depth, double sigma)
{
  std::mt19937 random(3);
  std::normal_distribution<double> error; // of one unit: there may be none
  const GridGeometry geometry = camera();
  return toGridPoints(cameraCloud(geometry,
                                  [&](int column, int row) {
                                    return depth(column, row) + sigma * error(random);
                                  }),
                      geometry);
}

/** A tilted plane: linear in inverse depth. */
inline double
tilted(int column, int row)
{
  return 1.0 / (0.4 + 0.0004 * column + 0.0003 * row);
}

inline double
wavy(int column, int row)
{
  return 2.0 + 0.1 * std::sin(0.05 * column) * std::cos(0.04 * row);
}

inline std::vector<std::uint32_t>
oneSegment(const GridPoints& points, std::uint32_t label = 1)
{
  return std::vector<std::uint32_t>(points.size(), label);
}

} // namespace test
} // namespace nurbs
} // namespace pcl
