// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

#pragma once

#include <pcl/segmentation/grid_graph.h>
#include <pcl/segmentation/sensor_noise.h>

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

/** Measure it in the cloud: where the depth changes by much from cell to cell, points
 * leave the line of their neighbours by a share of this change. The least where nothing
 * steep is seen. O(cells), of which a sample is looked at.
 * \throws std::invalid_argument when the graph belongs to other points */
DirectionNoise
measureDirectionNoise(const GridPoints& points,
                      const GridGraph& graph,
                      const SensorNoise& noise);

/** Standard deviation of each cell's depth that errors of the direction cause; 0 where
 * there is no neighbour.
 * \throws std::invalid_argument when the graph belongs to other points */
std::vector<float>
depthNoiseOfDirections(const GridPoints& points,
                       const GridGraph& graph,
                       const DirectionNoise& noise,
                       int threads);

} // namespace nurbs
} // namespace pcl
