// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

#include "projection_choice.h"

#include "grid_steps.h"
#include "principal_axes.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <unordered_map>
#include <unordered_set>

namespace pcl {
namespace nurbs {
namespace {

constexpr std::size_t kSample = 100000;

std::uint64_t
coarseCell(const Eigen::Vector3f& chart, double step)
{
  const auto u = static_cast<std::int32_t>(std::floor(chart.x() / step));
  const auto v = static_cast<std::int32_t>(std::floor(chart.y() / step));
  return (static_cast<std::uint64_t>(static_cast<std::uint32_t>(u)) << 32U) |
         static_cast<std::uint32_t>(v);
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

PointList
finitePoints(const PointList& points, std::size_t stride)
{
  PointList finite;
  for (std::size_t i = 0; i < points.size(); i += stride)
    if (points[i].allFinite())
      finite.push_back(points[i]);
  return finite;
}

} // namespace

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

double
stepForDensity(const ChartList& charts,
               const Interval& u,
               const Interval& v,
               double per_cell)
{
  const std::size_t stride = charts.size() / kSample + 1;
  ChartList sample;
  for (std::size_t i = 0; i < charts.size(); i += stride)
    if (!std::isnan(charts[i].x()))
      sample.push_back(charts[i]);
  const auto points = static_cast<double>(sample.size());
  const double longest = std::max(u.length(), v.length());
  if (points < 1.0 || !(longest > 0.0))
    return 1.0;
  double step = longest / std::max(1.0, std::sqrt(points / 8.0));
  // The area touched depends on the step it is measured with: a few rounds settle it.
  for (int round = 0; round < 3; ++round) {
    std::unordered_set<std::uint64_t> touched;
    for (const Eigen::Vector3f& chart : sample)
      touched.insert(coarseCell(chart, step));
    const double density = points / static_cast<double>(touched.size());
    step = std::max(step * std::sqrt(8.0 / density), longest * 1e-5);
  }
  return step * std::sqrt(per_cell / (8.0 * static_cast<double>(stride)));
}

GridGeometry
projectionFor(GridProjection projection, const PointList& points)
{
  GridGeometry grid;
  grid.projection = projection;
  if (projection == GridProjection::spherical)
    grid.frame = GridGeometry::vehicleFrame();
  else if (projection == GridProjection::plane)
    grid.frame = principalAxes(points);
  return grid;
}

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
    const GridGeometry grid = projectionFor(candidates[c], sample);
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

} // namespace nurbs
} // namespace pcl
