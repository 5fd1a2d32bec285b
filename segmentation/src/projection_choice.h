// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

#pragma once

#include "ring_detection.h"

namespace pcl {
namespace nurbs {

/** Chart coordinates of every \a stride-th point; NaN where the projection cannot show
 * it. */
ChartList
chartsOf(const PointList& points, const GridGeometry& grid, std::size_t stride);

struct Interval {
  double first;
  double last;

  double
  length() const
  {
    return last - first;
  }
};

/** Where a chart coordinate lies, a few far outliers aside. */
Interval
extent(const ChartList& charts, int coordinate);

/** Step of a raster that has about \a per_cell points in each cell they touch. */
double
stepForDensity(const ChartList& charts,
               const Interval& u,
               const Interval& v,
               double per_cell);

/** Projection and axes, without a raster yet. */
GridGeometry
projectionFor(GridProjection projection, const PointList& points);

/** The projection with the least layering. A camera or laser is believed a little more
 * than a height field; a camera only when all it sees is in front of it. */
GridProjection
chooseProjection(const PointList& points);

} // namespace nurbs
} // namespace pcl
