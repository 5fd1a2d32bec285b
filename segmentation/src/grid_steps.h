// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

#pragma once

#include <pcl/segmentation/grid_geometry.h>

#include <array>
#include <cmath>
#include <cstddef>

namespace pcl {
namespace nurbs {

/** Columns and rows from a cell to its neighbour in a direction of GridGraph. */
struct GridStep {
  int columns;
  int rows;
};

inline GridStep
gridStep(int direction)
{
  constexpr std::array<GridStep, 4> steps = {
      GridStep{1, 0}, GridStep{0, 1}, GridStep{1, 1}, GridStep{-1, 1}};
  return steps[static_cast<std::size_t>(direction)];
}

/** Distance of neighbours on a surface that faces the sensor: a constant in a plane
 * grid, proportional to the depth in a sensor's. */
struct GridSpacing {
  GridSpacing(const GridGeometry& grid, int direction)
  {
    const GridStep step = gridStep(direction);
    const auto at = [&](double depth) {
      return static_cast<float>(std::hypot(step.columns * grid.columnSpacing(depth),
                                           step.rows * grid.rowSpacing(depth)));
    };
    constant = at(0.0);
    per_depth = at(1.0) - constant;
  }

  float
  operator()(float depth) const
  {
    return constant + per_depth * depth;
  }

  float constant;
  float per_depth;
};

/** Whether the inverse of the depth, not the depth, is linear over a plane. */
inline bool
isInverseDepthGrid(const GridGeometry& grid)
{
  return grid.projection == GridProjection::perspective ||
         grid.projection == GridProjection::spherical;
}

} // namespace nurbs
} // namespace pcl
