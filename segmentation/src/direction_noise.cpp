// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

#include "direction_noise.h"

#include "grid_steps.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>
#include <stdexcept>

namespace pcl {
namespace nurbs {
namespace {

/** The most that directions err by, in cells. */
constexpr double kMostShare = 0.5;

/** Mean change of depth to the neighbours on either side, but that on the smoother side
 * where one is beyond an edge. */
float
slopeBetween(float before, float after)
{
  constexpr float kEdge = 4.0F;
  const float least = std::min(before, after);
  const float most = std::max(before, after);
  return std::isfinite(most) && most < kEdge * least ? 0.5F * (least + most) : least;
}

/** Changes of depth along the lines of one direction. */
class DepthLines {
public:
  DepthLines(const GridPoints& points, const GridGraph& graph, int direction)
      : depth_(points.depth),
        target_(graph.target(direction)),
        source_(graph.source(direction)),
        inverse_(isInverseDepthGrid(points.geometry))
  {
  }

  /** Change of depth from cell to cell; infinite where there is no neighbour. */
  float
  slope(std::size_t cell) const
  {
    const auto change = [&](std::int32_t next) {
      return next == GridGraph::kNone
                 ? std::numeric_limits<float>::infinity()
                 : std::abs(depth_[static_cast<std::size_t>(next)] - depth_[cell]);
    };
    return slopeBetween(change(source_[cell]), change(target_[cell]));
  }

  /** Change per cell over four cells around one, if it is steady. */
  std::optional<float>
  steadySlope(std::size_t cell) const
  {
    constexpr float kSteady = 2.0F;
    const std::int32_t before = twice(source_, cell);
    const std::int32_t after = twice(target_, cell);
    if (before == GridGraph::kNone || after == GridGraph::kNone)
      return std::nullopt;
    const float first = depth_[cell] - depth_[static_cast<std::size_t>(before)];
    const float second = depth_[static_cast<std::size_t>(after)] - depth_[cell];
    const float least = std::min(std::abs(first), std::abs(second));
    const float most = std::max(std::abs(first), std::abs(second));
    if (!(first * second > 0.0F) || most > kSteady * least)
      return std::nullopt;
    return 0.25F * std::abs(first + second);
  }

  /** How far a point, with neighbours on both sides, is from their line. */
  float
  bend(std::size_t cell) const
  {
    const float before = depth_[static_cast<std::size_t>(source_[cell])];
    const float after = depth_[static_cast<std::size_t>(target_[cell])];
    const float here = depth_[cell];
    if (!inverse_)
      return std::abs(0.5F * (before + after) - here);
    return std::abs(0.5F * (1.0F / before + 1.0F / after) - 1.0F / here) * here * here;
  }

private:
  static std::int32_t
  twice(const std::vector<std::int32_t>& next, std::size_t cell)
  {
    const std::int32_t once = next[cell];
    return once == GridGraph::kNone ? once : next[static_cast<std::size_t>(once)];
  }

  const std::vector<float>& depth_;
  const std::vector<std::int32_t>& target_;
  const std::vector<std::int32_t>& source_;
  bool inverse_;
};

/** Share of the change along \a lines that points err by, where the change along the
 * others is small and the sensor's noise too. */
double
measureShare(const GridPoints& points,
             const DepthLines& lines,
             const DepthLines& others,
             const SensorNoise& noise)
{
  constexpr std::size_t kSample = 100000;
  constexpr std::size_t kEnough = 200;
  constexpr float kDominates = 3.0F;
  // The lower quarter: curved surfaces leave the line as well.
  constexpr double kQuantile = 0.25;
  constexpr double kToSigma = 3.1381;
  const double of_three = std::sqrt(1.5); // a point and the mean of two
  const std::size_t stride = points.size() / kSample + 1;
  std::vector<float> shares;
  for (std::size_t cell = 0; cell < points.size(); cell += stride) {
    if (!points.valid(cell))
      continue;
    const std::optional<float> slope = lines.steadySlope(cell);
    if (!slope || kLeastDirectionNoise * *slope < noise.sigma(points.depth[cell]))
      continue;
    const float other = others.slope(cell);
    if (std::isfinite(other) && kDominates * other > *slope)
      continue;
    shares.push_back(lines.bend(cell) / *slope);
  }
  if (shares.size() < kEnough)
    return kLeastDirectionNoise;
  const auto where =
      shares.begin() +
      static_cast<std::ptrdiff_t>(kQuantile * static_cast<double>(shares.size()));
  std::nth_element(shares.begin(), where, shares.end());
  return std::clamp(kToSigma * *where / of_three, kLeastDirectionNoise, kMostShare);
}

void
requireSame(const GridPoints& points, const GridGraph& graph)
{
  if (graph.numCells() != points.size())
    throw std::invalid_argument("direction noise: the graph is not of these points");
}

/** Steady change along the lines, or the mean of that to the neighbours. */
float
slopeAlong(const DepthLines& lines, std::size_t cell)
{
  const std::optional<float> steady = lines.steadySlope(cell);
  const float slope = steady ? *steady : lines.slope(cell);
  return std::isfinite(slope) ? slope : 0.0F;
}

} // namespace

DepthSlopes
measureDepthSlopes(const GridPoints& points, const GridGraph& graph, int threads)
{
  requireSame(points, graph);
  const DepthLines rows(points, graph, GridGraph::kRight);
  const DepthLines columns(points, graph, GridGraph::kDown);
  DepthSlopes slopes;
  slopes.fill(std::vector<float>(points.size(), 0.0F));
#pragma omp parallel for num_threads(threads)
  for (std::size_t i = 0; i < points.size(); ++i)
    if (points.valid(i)) {
      slopes[0][i] = slopeAlong(rows, i);
      slopes[1][i] = slopeAlong(columns, i);
    }
  return slopes;
}

DirectionNoise
measureDirectionNoise(const GridPoints& points,
                      const GridGraph& graph,
                      const SensorNoise& noise,
                      int threads)
{
  requireSame(points, graph);
  const DepthLines rows(points, graph, GridGraph::kRight);
  const DepthLines columns(points, graph, GridGraph::kDown);
  DirectionNoise result;
#pragma omp parallel sections num_threads(threads)
  {
#pragma omp section
    result.along_rows = measureShare(points, rows, columns, noise);
#pragma omp section
    result.along_columns = measureShare(points, columns, rows, noise);
  }
  return result;
}

std::vector<float>
depthNoiseOfDirections(const DepthSlopes& slopes, const DirectionNoise& noise)
{
  const auto rows = static_cast<float>(noise.along_rows);
  const auto columns = static_cast<float>(noise.along_columns);
  std::vector<float> sigmas(slopes[0].size());
  for (std::size_t i = 0; i < sigmas.size(); ++i)
    sigmas[i] = std::max(rows * slopes[0][i], columns * slopes[1][i]);
  return sigmas;
}

} // namespace nurbs
} // namespace pcl
