// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

#include "creases.h"

#include "grid_steps.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

namespace pcl {
namespace nurbs {
namespace {

using Run = std::vector<std::size_t>;
using Vectors = std::vector<Eigen::Vector3f>;

/** Wanted standard deviation (radians) of a normal. */
constexpr float kNormalNoise = 0.1F;
/** Neighbouring depths err together: so many make one independent reading. */
constexpr float kCorrelation = 2.0F;
constexpr int kLeastHalfWidth = 2;
constexpr int kMostHalfWidth = 12;

/** Half-width, in cells, of the window that brings the noise of a normal down. */
class Window {
public:
  Window(const GridPoints& points, const SensorNoise& noise, int direction)
      : depth_(points.depth), noise_(noise), spacing_(points.geometry, direction)
  {
  }

  /** The slope of a line fit over m points errs by noise sqrt(12 / m^3), and averaging
   * m such lines divides by sqrt(m). */
  int
  operator()(std::size_t cell) const
  {
    const float spacing = std::max(spacing_(depth_[cell]), 1e-9F);
    const float ratio =
        static_cast<float>(noise_.sigma(depth_[cell])) / (spacing * kNormalNoise);
    const float width = std::sqrt(std::sqrt(12.0F * kCorrelation) * ratio);
    return static_cast<int>(std::clamp(0.5F * width,
                                       static_cast<float>(kLeastHalfWidth),
                                       static_cast<float>(kMostHalfWidth)));
  }

private:
  const std::vector<float>& depth_;
  SensorNoise noise_;
  GridSpacing spacing_;
};

/** Slopes of line fits along the runs of a direction. */
Vectors
tangents(const GridPoints& points,
         const KeptEdges& edges,
         const Window& window,
         int direction)
{
  Vectors result(points.size(), Eigen::Vector3f::Zero());
  std::vector<Eigen::Vector3d> sums;    // of the points before
  std::vector<Eigen::Vector3d> moments; // of position times point before
  edges.forEachRun(direction, [&](const Run& run) {
    const int last = static_cast<int>(run.size()) - 1;
    if (last < kLeastHalfWidth)
      return;
    sums.assign(1, Eigen::Vector3d::Zero());
    moments.assign(1, Eigen::Vector3d::Zero());
    for (std::size_t k = 0; k < run.size(); ++k) {
      const Eigen::Vector3d point = points.point(run[k]).cast<double>();
      sums.emplace_back(sums.back() + point);
      moments.emplace_back(moments.back() + static_cast<double>(k) * point);
    }
    for (int k = 0; k <= last; ++k) {
      const std::size_t cell = run[static_cast<std::size_t>(k)];
      const int half = window(cell);
      const int a = std::max(k - half, 0);
      const auto b = static_cast<std::size_t>(std::min(k + half, last) + 1);
      const double n = static_cast<double>(b) - a;
      const double middle = a + 0.5 * (n - 1.0);
      const auto start = static_cast<std::size_t>(a);
      const Eigen::Vector3d slope =
          moments[b] - moments[start] - middle * (sums[b] - sums[start]);
      result[cell] = (slope * (12.0 / (n * (n * n - 1.0)))).cast<float>();
    }
  });
  return result;
}

/** Mean of vectors over windows along the runs of a direction. */
Vectors
smoothed(const Vectors& vectors,
         const KeptEdges& edges,
         const Window& window,
         int direction)
{
  Vectors result(vectors.size(), Eigen::Vector3f::Zero());
  std::vector<Eigen::Vector3d> sums;
  edges.forEachRun(direction, [&](const Run& run) {
    sums.assign(1, Eigen::Vector3d::Zero());
    for (const std::size_t cell : run)
      sums.emplace_back(sums.back() + vectors[cell].cast<double>());
    const int last = static_cast<int>(run.size()) - 1;
    for (int k = 0; k <= last; ++k) {
      const std::size_t cell = run[static_cast<std::size_t>(k)];
      if (last == 0) {
        result[cell] = vectors[cell];
        continue;
      }
      const int half = window(cell);
      const auto a = static_cast<std::size_t>(std::max(k - half, 0));
      const auto b = static_cast<std::size_t>(std::min(k + half, last) + 1);
      result[cell] = ((sums[b] - sums[a]) / static_cast<double>(b - a)).cast<float>();
    }
  });
  return result;
}

/** Chord between the unit normals of two places of a run. */
float
turn(const Vectors& normals, const Run& run, int a, int b)
{
  const Eigen::Vector3f& first = normals[run[static_cast<std::size_t>(a)]];
  const Eigen::Vector3f& second = normals[run[static_cast<std::size_t>(b)]];
  if (first.squaredNorm() == 0.0F || second.squaredNorm() == 0.0F)
    return 0.0F;
  return (first - second).norm();
}

/** Turn of the normals across position k of a run less the mean turn, over a stretch of
 * the same length, on either side; zero when the turn itself is not above \a enough. */
float
excessTurn(const Vectors& normals, const Run& run, int k, int half, float enough)
{
  const int last = static_cast<int>(run.size()) - 1;
  const auto inside = [last](int where) { return std::clamp(where, 0, last); };
  const int a = inside(k - half);
  const int b = inside(k + half);
  const float across = turn(normals, run, a, b);
  if (across <= enough)
    return 0.0F; // whatever the sides say, it is no fold
  const auto length = static_cast<float>(b - a);
  float beside = 0.0F;
  int sides = 0;
  const auto count = [&](int from, int to) {
    if (to - from < kLeastHalfWidth)
      return;
    beside += turn(normals, run, from, to) * length / static_cast<float>(to - from);
    ++sides;
  };
  count(inside(a - 2 * half), a);
  count(b, inside(b + 2 * half));
  return sides == 0 ? across : across - beside / static_cast<float>(sides);
}

} // namespace

Vectors
gridNormals(const GridPoints& points,
            const KeptEdges& edges,
            const SensorNoise& noise,
            int threads)
{
  constexpr std::array<int, 2> directions = {GridGraph::kRight, GridGraph::kDown};
  const std::array<Window, 2> windows = {Window(points, noise, directions[0]),
                                         Window(points, noise, directions[1])};
  std::array<Vectors, 2> slopes;
#pragma omp parallel for schedule(static, 1) num_threads(threads)
  for (std::size_t k = 0; k < 2; ++k)
    slopes[k] = smoothed(tangents(points, edges, windows[k], directions[k]),
                         edges,
                         windows[1 - k],
                         directions[1 - k]);
  Vectors normals = std::move(slopes[1]);
#pragma omp parallel for num_threads(threads)
  for (std::size_t i = 0; i < normals.size(); ++i)
    normals[i] = normals[i].cross(slopes[0][i]).eval().normalized();
  return normals;
}

std::vector<std::uint8_t>
findCreases(const GridPoints& points,
            const KeptEdges& edges,
            const SensorNoise& noise,
            const ConnectedGroupsOptions& options)
{
  const Vectors normals = gridNormals(points, edges, noise, options.threads);
  const float chord = 2.0F * std::sin(0.5F * options.crease_angle);
  std::array<std::vector<std::uint8_t>, 2> marks;
#pragma omp parallel for schedule(static, 1) num_threads(options.threads)
  for (std::size_t m = 0; m < 2; ++m) {
    const int direction = m == 0 ? GridGraph::kRight : GridGraph::kDown;
    std::vector<std::uint8_t>& crease = marks[m];
    crease.assign(points.size(), 0);
    const Window window(points, noise, direction);
    edges.forEachRun(direction, [&](const Run& run) {
      for (std::size_t k = 0; k < run.size(); ++k)
        if (points.valid(run[k]) &&
            excessTurn(normals, run, static_cast<int>(k), window(run[k]), chord) >
                chord)
          crease[run[k]] = 1;
    });
  }
  for (std::size_t i = 0; i < marks[0].size(); ++i)
    marks[0][i] |= marks[1][i];
  return std::move(marks[0]);
}

std::vector<std::uint8_t>
nearBreaks(const GridGeometry& grid,
           const KeptEdges& edges,
           const std::vector<std::uint8_t>& crease,
           int radius)
{
  std::vector<std::uint8_t> steps(crease.size());
  const auto far = static_cast<std::uint8_t>(radius + 1);
  for (std::size_t i = 0; i < steps.size(); ++i)
    steps[i] = crease[i] != 0 || edges.isCut(i) ? 0 : far;
  // Chessboard distance in two sweeps.
  const auto width = static_cast<std::size_t>(grid.width);
  const auto sweep = [&](std::size_t i, std::size_t column, bool inner, auto at) {
    std::uint8_t least = steps[i];
    const auto look = [&](std::size_t j) {
      least = std::min<std::uint8_t>(least, static_cast<std::uint8_t>(steps[j] + 1));
    };
    if (column > 0)
      look(at(i, 1, 0));
    if (inner)
      look(at(i, 0, 1));
    if (inner && column > 0)
      look(at(i, 1, 1));
    if (inner && column + 1 < width)
      look(at(i, -1, 1));
    steps[i] = least;
  };
  const auto offset = [width](int columns, int rows) {
    return static_cast<std::ptrdiff_t>(width) * rows + columns;
  };
  const auto back = [&](std::size_t i, int columns, int rows) {
    return static_cast<std::size_t>(static_cast<std::ptrdiff_t>(i) -
                                    offset(columns, rows));
  };
  const auto ahead = [&](std::size_t i, int columns, int rows) {
    return static_cast<std::size_t>(static_cast<std::ptrdiff_t>(i) +
                                    offset(columns, rows));
  };
  const std::size_t cells = steps.size();
  for (std::size_t i = 0; i < cells; ++i)
    sweep(i, i % width, i >= width, back);
  for (std::size_t i = cells; i-- > 0;)
    sweep(i, width - 1 - i % width, i + width < cells, ahead);
  for (std::uint8_t& step : steps)
    step = step <= radius ? 1 : 0;
  return steps;
}

} // namespace nurbs
} // namespace pcl
