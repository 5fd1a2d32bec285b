// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

#include <pcl/segmentation/grid_layout.h>

#include "cell_filler.h"
#include "grid_steps.h"
#include "principal_axes.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <stdexcept>
#include <unordered_map>

namespace pcl {
namespace nurbs {
namespace {

constexpr double kTurn = 2.0 * M_PI;
constexpr double kWideAngle = 0.9 * kTurn; // azimuths over more than this go all around
constexpr std::size_t kSample = 100000;
constexpr double kMostCellsPerPoint = 16.0;
constexpr std::size_t kLeastCells = 1024;

ChartList
chartsOf(const PointList& points, const GridGeometry& grid, std::size_t stride)
{
  const float nan = std::numeric_limits<float>::quiet_NaN();
  ChartList charts;
  charts.reserve(points.size() / stride + 1);
  for (std::size_t i = 0; i < points.size(); i += stride) {
    Eigen::Vector3f chart = grid.chart(points[i].cast<double>()).cast<float>();
    if (!chart.allFinite() || (isInverseDepthGrid(grid) && !(chart.z() > 0.0F)))
      chart.setConstant(nan);
    charts.push_back(chart);
  }
  return charts;
}

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
extent(const ChartList& charts, int coordinate)
{
  std::vector<float> values;
  const std::size_t stride = charts.size() / kSample + 1;
  float least = std::numeric_limits<float>::infinity();
  float most = -least;
  for (std::size_t i = 0; i < charts.size(); ++i) {
    const float value = charts[i][coordinate];
    if (std::isnan(value))
      continue;
    least = std::min(least, value);
    most = std::max(most, value);
    if (i % stride == 0)
      values.push_back(value);
  }
  if (values.empty())
    return {0.0, 0.0};
  std::sort(values.begin(), values.end());
  const std::size_t tail = values.size() / 1000;
  const double low = values[tail];
  const double high = values[values.size() - 1 - tail];
  const double margin = 0.5 * (high - low);
  return {std::max<double>(least, low - margin), std::min<double>(most, high + margin)};
}

std::uint64_t
coarseCell(const Eigen::Vector3f& chart, double step)
{
  const auto u = static_cast<std::int32_t>(std::floor(chart.x() / step));
  const auto v = static_cast<std::int32_t>(std::floor(chart.y() / step));
  return (static_cast<std::uint64_t>(static_cast<std::uint32_t>(u)) << 32U) |
         static_cast<std::uint32_t>(v);
}

/** Step of a raster that has about \a per_cell points in each cell they touch. */
double
stepForDensity(const ChartList& charts,
               const Interval& u,
               const Interval& v,
               double per_cell)
{
  double points = 0.0;
  for (const Eigen::Vector3f& chart : charts)
    points += std::isnan(chart.x()) ? 0.0 : 1.0;
  const double longest = std::max(u.length(), v.length());
  if (points < 1.0 || !(longest > 0.0))
    return 1.0;
  double step = longest / std::max(1.0, std::sqrt(points / 8.0));
  // The area touched depends on the step it is measured with: a few rounds settle it.
  for (int round = 0; round < 3; ++round) {
    std::unordered_map<std::uint64_t, char> touched;
    for (const Eigen::Vector3f& chart : charts)
      if (!std::isnan(chart.x()))
        touched.emplace(coarseCell(chart, step), 1);
    const double density = points / static_cast<double>(touched.size());
    step = std::max(step * std::sqrt(8.0 / density), longest * 1e-5);
  }
  return step * std::sqrt(per_cell / 8.0);
}

/** Share of points that lie far behind another one of their cell: how badly the depth
 * fails to be a function of the cell. */
double
layering(const ChartList& charts, const GridGeometry& grid)
{
  const double step = stepForDensity(charts, extent(charts, 0), extent(charts, 1), 4.0);
  std::unordered_map<std::uint64_t, float> nearest;
  for (const Eigen::Vector3f& chart : charts)
    if (!std::isnan(chart.x())) {
      const auto place = nearest.emplace(coarseCell(chart, step), chart.z()).first;
      place->second = std::min(place->second, chart.z());
    }
  double behind = 0.0;
  double all = 0.0;
  for (const Eigen::Vector3f& chart : charts) {
    ++all;
    if (std::isnan(chart.x())) {
      ++behind; // a point the projection cannot show
      continue;
    }
    const float front = nearest[coarseCell(chart, step)];
    const double cell = isInverseDepthGrid(grid) ? step * front : step;
    behind += chart.z() - front > 4.0 * cell ? 1.0 : 0.0;
  }
  return behind / std::max(all, 1.0);
}

GridGeometry
rasterOf(GridProjection projection, const PointList& points)
{
  GridGeometry grid;
  grid.projection = projection;
  if (projection == GridProjection::spherical)
    grid.frame = GridGeometry::vehicleFrame();
  else if (projection == GridProjection::plane)
    grid.frame = principalAxes(points);
  return grid;
}

PointList
finitePoints(const PointList& points, std::size_t stride)
{
  PointList finite;
  for (std::size_t i = 0; i < points.size(); i += stride)
    if (points[i].allFinite())
      finite.push_back(points[i]);
  return finite;
}

/** The projection with the least layering. A camera or laser is believed a little more
 * than a height field; a camera only when all it sees is in front of it. */
GridProjection
chooseProjection(const PointList& points)
{
  const PointList sample = finitePoints(points, points.size() / kSample + 1);
  constexpr std::array<GridProjection, 3> candidates = {
      GridProjection::perspective, GridProjection::spherical, GridProjection::plane};
  constexpr std::array<double, 3> handicap = {0.0, 0.01, 0.02};
  GridProjection best = GridProjection::plane;
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t c = 0; c < candidates.size(); ++c) {
    const GridGeometry grid = rasterOf(candidates[c], sample);
    const ChartList charts = chartsOf(sample, grid, 1);
    if (candidates[c] == GridProjection::perspective &&
        (extent(charts, 0).length() > 4.0 || extent(charts, 1).length() > 4.0))
      continue;
    const double score = layering(charts, grid) + handicap[c];
    if (score < least) {
      least = score;
      best = candidates[c];
    }
  }
  return best;
}

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
  GridLayout layout;
  for (bool first = true;; first = false, step *= 0.85) {
    setRaster(grid, u, v, step);
    const double cells = static_cast<double>(grid.width) * grid.height;
    if (!first && cells > most_cells)
      break;
    layout = fillCells(grid, charts, rings);
    if (layout.dropped * 12 < points)
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
  GridGeometry grid = rasterOf(projection, points);
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
    const GridGeometry sphere = rasterOf(GridProjection::spherical, points);
    const ChartList charts = chartsOf(points, sphere, 1);
    Rings rings = ringsFromOrder(charts);
    if (!rings)
      rings = ringsFromAngles(charts);
    if (rings)
      return layOut(points, GridProjection::spherical, rings);
  }
  return projection ? layOut(points, *projection, {}) : layOutByData(points);
}

} // namespace nurbs
} // namespace pcl
