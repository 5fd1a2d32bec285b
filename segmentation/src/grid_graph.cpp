// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

#include "grid_steps.h"

#include <pcl/segmentation/grid_graph.h>

#include <algorithm>
#include <stdexcept>

namespace pcl {
namespace nurbs {
namespace {

/** Keeps weights finite where neither spacing nor noise is known. */
constexpr float kLeast = 1e-20F;

/** First point at most max_gap cells from (column, row) in a direction. */
std::int32_t
nextPoint(const GridPoints& points, int column, int row, GridStep step)
{
  const GridGeometry& grid = points.geometry;
  for (int gap = 1; gap <= grid.max_gap; ++gap) {
    int c = column + gap * step.columns;
    const int r = row + gap * step.rows;
    if (grid.wrap)
      c = (c + grid.width) % grid.width;
    if (c < 0 || c >= grid.width || r >= grid.height)
      break;
    const std::int32_t cell = r * grid.width + c;
    if (points.valid(static_cast<std::size_t>(cell)))
      return cell;
  }
  return GridGraph::kNone;
}

/** How many cells the edge bridges: a longer way is expected over empty cells. */
int
cellsBetween(const GridGeometry& grid, GridStep step, std::size_t from, std::size_t to)
{
  const auto row_of = [&](std::size_t cell) {
    return static_cast<int>(cell) / grid.width;
  };
  if (step.rows != 0)
    return row_of(to) - row_of(from);
  const int columns = static_cast<int>(to) - static_cast<int>(from); // of one row
  return columns > 0 ? columns : columns + grid.width;
}

void
requireValid(const GridPoints& points, const GridGraphOptions& options)
{
  if (options.connectivity != 4 && options.connectivity != 8)
    throw std::invalid_argument("GridGraph: connectivity must be 4 or 8");
  if (!(options.incidence_cap >= 1.0F))
    throw std::invalid_argument("GridGraph: the incidence cap must be at least 1");
  if (options.threads < 1)
    throw std::invalid_argument("GridGraph: there must be a thread");
  if (points.geometry.max_gap < 1)
    throw std::invalid_argument("GridGraph: the gap must be at least 1");
  if (points.geometry.wrap && points.geometry.width <= 2 * points.geometry.max_gap)
    throw std::invalid_argument("GridGraph: a grid this narrow cannot wrap");
}

} // namespace

void
GridGraph::build(const GridPoints& points,
                 const SensorNoise& noise,
                 const GridGraphOptions& options)
{
  requireValid(points, options);
  cells_ = points.size();
  directions_ = options.connectivity / 2;
  std::vector<float> noise_variance(cells_);
  for (std::size_t i = 0; i < cells_; ++i) {
    const auto sigma = static_cast<float>(noise.sigma(points.depth[i]));
    noise_variance[i] = sigma * sigma;
  }
#pragma omp parallel for schedule(dynamic, 1) num_threads(options.threads)
  for (int d = 0; d < directions_; ++d) {
    findEdges(points, d);
    expectDistances(points, noise_variance, options.incidence_cap, d);
  }
}

void
GridGraph::findEdges(const GridPoints& points, int direction)
{
  Lines& line = lines_[static_cast<std::size_t>(direction)];
  line.target.assign(cells_, kNone);
  line.source.assign(cells_, kNone);
  line.squared_distance.assign(cells_, 0.0F);
  line.weight.assign(cells_, 0.0F);
  const GridStep step = gridStep(direction);
  std::size_t cell = 0;
  for (int row = 0; row < points.geometry.height; ++row)
    for (int column = 0; column < points.geometry.width; ++column, ++cell) {
      if (!points.valid(cell))
        continue;
      const std::int32_t next = nextPoint(points, column, row, step);
      if (next == kNone)
        continue;
      const auto far = static_cast<std::size_t>(next);
      line.target[cell] = next;
      line.source[far] = static_cast<std::int32_t>(cell);
      line.squared_distance[cell] =
          (points.point(far) - points.point(cell)).squaredNorm();
    }
}

void
GridGraph::expectDistances(const GridPoints& points,
                           const std::vector<float>& noise_variance,
                           float cap,
                           int direction)
{
  Lines& line = lines_[static_cast<std::size_t>(direction)];
  line.variance.assign(cells_, 0.0F);
  const GridSpacing spacing(points.geometry, direction);
  const GridStep step = gridStep(direction);
  const bool gaps = points.geometry.max_gap > 1;
  for (std::size_t i = 0; i < cells_; ++i) {
    if (line.target[i] == kNone)
      continue;
    const auto j = static_cast<std::size_t>(line.target[i]);
    float expected = spacing(std::min(points.depth[i], points.depth[j]));
    if (gaps)
      expected *= static_cast<float>(cellsBetween(points.geometry, step, i, j));
    const float facing = expected * expected;
    float beside = cap * cap * facing;
    const bool before = line.source[i] != kNone;
    const bool after = line.target[j] != kNone;
    if (before)
      beside = std::min(
          beside, line.squared_distance[static_cast<std::size_t>(line.source[i])]);
    if (after)
      beside = std::min(beside, line.squared_distance[j]);
    if (!before && !after)
      beside = facing;
    line.variance[i] =
        kLeast + std::max(beside, facing) + noise_variance[i] + noise_variance[j];
  }
}

void
GridGraph::setDistanceWeights(int threads)
{
#pragma omp parallel for schedule(dynamic, 1) num_threads(threads)
  for (int d = 0; d < directions_; ++d)
    setLineWeights(DistanceWeight(), d);
}

std::size_t
GridGraph::numEdges() const
{
  std::size_t edges = 0;
  for (int d = 0; d < directions_; ++d)
    edges += cells_ - static_cast<std::size_t>(
                          std::count(target(d).begin(), target(d).end(), kNone));
  return edges;
}

} // namespace nurbs
} // namespace pcl
