// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

#pragma once

#include <pcl/segmentation/grid_graph.h>
#include <pcl/segmentation/sensor_noise.h>

#include <array>
#include <vector>

namespace pcl {
namespace nurbs {

/** Directions are granted to err by such a share of a cell. */
constexpr double kLeastDirectionNoise = 0.1;

/** By how much of a cell directions err along rows and along columns (standard
 * deviations). */
struct DirectionNoise {
  double along_rows = kLeastDirectionNoise;
  double along_columns = kLeastDirectionNoise;
};

/** Change of each cell's depth per cell along rows and along columns; 0 where there is
 * no neighbour. */
using DepthSlopes = std::array<std::vector<float>, 2>;

/** O(cells).
 * \throws std::invalid_argument when the graph belongs to other points */
DepthSlopes
measureDepthSlopes(const GridPoints& points, const GridGraph& graph, int threads);

/** Measure the noise in the cloud: where the depth changes by much from cell to cell,
 * points leave the line of their neighbours by a share of this change. The least where
 * nothing steep is seen. O(cells), of which a sample is looked at.
 * \throws std::invalid_argument when the graph belongs to other points */
DirectionNoise
measureDirectionNoise(const GridPoints& points,
                      const GridGraph& graph,
                      const SensorNoise& noise,
                      int threads);

/** Standard deviation of each cell's depth that errors of the direction cause. */
std::vector<float>
depthNoiseOfDirections(const DepthSlopes& slopes, const DirectionNoise& noise);

} // namespace nurbs
} // namespace pcl
