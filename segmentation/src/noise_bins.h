// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

#pragma once

#include <pcl/segmentation/grid_points.h>

#include <array>
#include <cstddef>
#include <vector>

namespace pcl {
namespace nurbs {

/** How depths of one range deviate from what their neighbours make expect. */
struct NoiseBin {
  std::vector<float> depths; /**< where there are several bins */
  /** |Depth less that of the line of two neighbours|, divided by what unit noise makes
   * of it; along rows and along columns. */
  std::array<std::vector<float>, 2> deviations;
  std::vector<float> steps; /**< of next neighbours that differ */
  std::size_t ties = 0;     /**< next neighbours of the same depth */
};

/** Sample a cloud's deviations, in bins of depth between \a nearest and \a farthest;
 * one bin for all where depth is a height, for it says nothing about the sensor. O(n).
 */
std::vector<NoiseBin>
sampleNoise(const GridPoints& points, float nearest, float farthest, int threads);

} // namespace nurbs
} // namespace pcl
