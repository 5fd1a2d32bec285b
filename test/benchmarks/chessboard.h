// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

#pragma once

#include <pcl/segmentation/grid_points.h>

#include <cmath>
#include <cstddef>
#include <random>

namespace pcl {
namespace nurbs {
namespace bench {

/** Steps of a chessboard, 2 and 2.2 m from a noisy camera. */
inline GridPoints
chessboard(std::size_t count)
{
  const auto width =
      static_cast<int>(std::sqrt(static_cast<double>(count) * 4.0 / 3.0));
  const int height = static_cast<int>(count / static_cast<std::size_t>(width));
  GridPoints points;
  points.geometry = GridGeometry::pinhole(
      width, height, {0.8 * width, 0.8 * width, 0.5 * width, 0.5 * height});
  std::mt19937 random(1);
  std::normal_distribution<double> noise(0.0, 0.6 / width);
  points.x.reserve(count);
  points.y.reserve(count);
  points.z.reserve(count);
  for (int row = 0; row < height; ++row)
    for (int column = 0; column < width; ++column) {
      const int field = column * 8 / width + row * 8 / width;
      const double z = 2.0 + 0.2 * (field % 2) + noise(random);
      const double u = points.geometry.first_u + column * points.geometry.step_u;
      const double v = points.geometry.first_v + row * points.geometry.step_v;
      points.x.push_back(static_cast<float>(u * z));
      points.y.push_back(static_cast<float>(v * z));
      points.z.push_back(static_cast<float>(z));
    }
  completeGridPoints(points);
  return points;
}

} // namespace bench
} // namespace nurbs
} // namespace pcl
