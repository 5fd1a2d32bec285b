// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

#include <pcl/segmentation/grid_layout.h>

#include "cell_filler.h"
#include "grid_steps.h"
#include "projection_choice.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace pcl {
namespace nurbs {
namespace {

constexpr double kTurn = 2.0 * M_PI;
constexpr double kWideAngle = 0.9 * kTurn; // azimuths over more than this go all around
constexpr double kMostCellsPerPoint = 16.0;
constexpr std::size_t kLeastCells = 1024;

/** Lay the raster over the points with a step. */
void
setRaster(GridGeometry& grid, const Interval& u, const Interval& v, double step)
{
  const auto cells = [step](const Interval& interval) {
    return static_cast<int>(std::floor(interval.length() / step + 0.5)) + 1;
  };
  grid.wrap = grid.projection == GridProjection::spherical && u.length() > kWideAngle;
  grid.width =
      grid.wrap ? std::max(32, static_cast<int>(std::ceil(kTurn / step))) : cells(u);
  grid.step_u = grid.wrap ? kTurn / grid.width : step;
  grid.first_u = grid.wrap ? -M_PI + 0.5 * grid.step_u : u.first;
  if (!grid.row_v.empty())
    return;
  grid.height = cells(v);
  grid.step_v = step;
  grid.first_v = v.first;
}

void
setRings(GridGeometry& grid, const Rings& rings)
{
  grid.row_v = rings.depression;
  grid.height = static_cast<int>(rings.depression.size());
  grid.first_v = grid.row_v.front();
  grid.step_v = (grid.row_v.back() - grid.row_v.front()) / (grid.height - 1);
}

/** Finer and finer rasters until few points are lost. */
GridLayout
refineRaster(GridGeometry grid, const ChartList& charts, const Rings& rings)
{
  std::size_t points = 0;
  for (const Eigen::Vector3f& chart : charts)
    points += std::isnan(chart.x()) ? 0 : 1;
  const Interval u = extent(charts, 0);
  const Interval v = extent(charts, 1);
  double step = rings ? rings.azimuth_step : stepForDensity(charts, u, v, 0.8);
  const double most_cells = std::max(kMostCellsPerPoint * static_cast<double>(points),
                                     static_cast<double>(kLeastCells));
  // No use refining one column, or one cell: rows of rings do not get more.
  const bool single = !(std::max(u.length(), rings ? 0.0 : v.length()) > 0.0);
  const auto count_cells = [&] {
    setRaster(grid, u, v, step);
    return static_cast<double>(grid.width) * grid.height;
  };
  while (!single && count_cells() > most_cells)
    step *= 1.25; // lines and outliers cover little of their rectangle
  GridLayout layout;
  for (bool first = true;; first = false, step *= 0.85) {
    if (count_cells() > most_cells && !first)
      break;
    layout = fillCells(grid, charts, rings);
    if (single || layout.dropped * 12 < points)
      break;
  }
  layout.geometry.max_gap = typicalGap(layout);
  return layout;
}

/** Points the projection can show: finite and, for a sensor, not at its own place,
 * where lasers put pulses that never came back. */
std::size_t
countReadings(const PointList& points, const GridGeometry& grid)
{
  return static_cast<std::size_t>(
      std::count_if(points.begin(), points.end(), [&](const Eigen::Vector3f& point) {
        return point.allFinite() && !(isInverseDepthGrid(grid) && point.isZero(0.0F));
      }));
}

GridLayout
layOut(const PointList& points, GridProjection projection, const Rings& rings)
{
  GridGeometry grid = projectionFor(projection, points);
  if (rings)
    setRings(grid, rings);
  GridLayout layout = refineRaster(grid, chartsOf(points, grid, 1), rings);
  const auto placed = static_cast<std::size_t>(std::count_if(
      layout.cell_point.begin(), layout.cell_point.end(), [](std::int32_t point) {
        return point >= 0;
      }));
  layout.dropped = countReadings(points, grid) - placed;
  return layout;
}

/** The layout in the projection the data ask for, or in the next best one when that
 * loses too much: submaps of several scans have layers in every projection. */
GridLayout
layOutByData(const PointList& points)
{
  const GridProjection first = chooseProjection(points);
  GridLayout best = layOut(points, first, {});
  for (const GridProjection other :
       {GridProjection::spherical, GridProjection::plane}) {
    if (best.dropped * 10 < points.size())
      break;
    if (other == first)
      continue;
    GridLayout layout = layOut(points, other, {});
    if (layout.dropped < best.dropped)
      best = std::move(layout);
  }
  return best;
}

} // namespace

GridLayout
layOutScattered(const PointList& points, std::optional<GridProjection> projection)
{
  if (projection == GridProjection::lattice)
    throw std::invalid_argument("layOutScattered: points have no lattice of their own");
  if (!projection || projection == GridProjection::spherical) {
    const GridGeometry sphere = projectionFor(GridProjection::spherical, points);
    const ChartList charts = chartsOf(points, sphere, 1);
    Rings rings = ringsFromOrder(charts);
    if (!rings)
      rings = ringsFromAngles(charts);
    if (rings) {
      GridLayout layout = layOut(points, GridProjection::spherical, rings);
      // What looked like rings was none when most points share their places.
      if (projection || layout.dropped * 10 < points.size())
        return layout;
    }
  }
  return projection ? layOut(points, *projection, {}) : layOutByData(points);
}

} // namespace nurbs
} // namespace pcl
