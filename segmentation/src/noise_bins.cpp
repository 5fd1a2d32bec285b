// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

#include "noise_bins.h"

#include "grid_steps.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace pcl {
namespace nurbs {
namespace {

constexpr int kBins = 16;

/** Gathers deviations of points from the line of their neighbours. */
class NoiseSampler {
public:
  NoiseSampler(const GridPoints& points, float nearest, float farthest)
      : points_(points),
        camera_(points.geometry.projection == GridProjection::perspective),
        laser_(points.geometry.projection == GridProjection::spherical),
        inverse_(isInverseDepthGrid(points.geometry)),
        nearest_(nearest),
        scale_(kBins / std::max(farthest - nearest, 1e-6F)),
        bins_(inverse_ ? kBins : 1)
  {
  }

  /** One part of the lines along rows (0) or columns (1). */
  std::vector<NoiseBin>
  run(int direction, std::size_t part, std::size_t parts)
  {
    constexpr std::size_t kSample = 100000;
    const auto width = static_cast<std::size_t>(points_.geometry.width);
    const auto height = static_cast<std::size_t>(points_.geometry.height);
    const std::size_t stride = points_.size() / kSample + 1;
    const std::size_t lines = (direction == 0 ? height : width) / stride + 1;
    for (std::size_t k = part * lines / parts; k < (part + 1) * lines / parts; ++k) {
      const std::size_t line = k * stride;
      if (direction == 0 && line < height)
        walk(line * width, 1, width, 0);
      else if (direction == 1 && line < width)
        walk(line, width, height, 1);
    }
    return std::move(bins_);
  }

private:
  void
  walk(std::size_t first, std::size_t stride, std::size_t count, int direction)
  {
    const bool regular = camera_ && points_.geometry.max_gap == 1;
    regular ? walkCamera(first, count) : walkSamples(first, stride, count, direction);
  }

  void
  walkCamera(std::size_t first, std::size_t count)
  {
    constexpr std::size_t kStep = 4;
    for (std::size_t i = first + kStep; i + kStep < first + count; ++i)
      add(i, i - kStep, i + kStep, 0.5F, 0);
  }

  /** Triples of neighbours with the places they really have. */
  void
  walkSamples(std::size_t first, std::size_t stride, std::size_t count, int direction)
  {
    const auto gap = static_cast<std::size_t>(points_.geometry.max_gap);
    std::array<Sample, 3> last; // the newest one at the end
    for (std::size_t k = 0; k < count; ++k) {
      const std::size_t cell = first + k * stride;
      if (!points_.valid(cell))
        continue;
      last = {last[1], last[2], {cell, k, placeOf(cell, direction), true}};
      if (!last[0].known || last[2].at - last[1].at > gap ||
          last[1].at - last[0].at > gap)
        continue;
      const double whole = difference(last[0].place, last[2].place);
      const double share = difference(last[0].place, last[1].place) / whole;
      if (whole != 0.0 && share >= 0.0 && share <= 1.0)
        add(last[1].cell,
            last[0].cell,
            last[2].cell,
            static_cast<float>(share),
            direction);
    }
  }

  struct Sample {
    std::size_t cell = 0;
    std::size_t at = 0;
    Eigen::Vector2d place = {0.0, 0.0};
    bool known = false;
  };

  /** Where a point is along the lines of a direction: legs of an angle for a laser,
   * (0, coordinate) for others. */
  Eigen::Vector2d
  placeOf(std::size_t cell, int direction) const
  {
    const GridGeometry& grid = points_.geometry;
    if (laser_) {
      const Eigen::Vector3d local = grid.frame * points_.point(cell).cast<double>();
      if (direction == 0)
        return {local.z(), local.x()};
      return {std::sqrt(local.x() * local.x() + local.z() * local.z()), local.y()};
    }
    const auto width = static_cast<std::size_t>(grid.width);
    if (grid.projection == GridProjection::lattice)
      return {0.0, static_cast<double>(direction == 0 ? cell % width : cell / width)};
    return {0.0, grid.chart(points_.point(cell).cast<double>())(direction)};
  }

  /** The tangent of an angle will do for the angle: neighbours are close. NaN for those
   * that are not. */
  double
  difference(const Eigen::Vector2d& from, const Eigen::Vector2d& to) const
  {
    if (!laser_)
      return to.y() - from.y();
    const double cosine = from.dot(to);
    return cosine > 0.0 ? (from.x() * to.y() - from.y() * to.x()) / cosine
                        : std::numeric_limits<double>::quiet_NaN();
  }

  /** Depth deviation of the middle of three samples from their common line; \a share is
   * how far along the way it is. */
  void
  add(std::size_t middle,
      std::size_t before,
      std::size_t after,
      float share,
      int direction)
  {
    const float depth = points_.depth[middle];
    const float a = points_.depth[before];
    const float b = points_.depth[after];
    const float bend =
        inverse_ ? depth * depth * ((1.0F - share) / a - 1.0F / depth + share / b)
                 : (1.0F - share) * a - depth + share * b;
    if (std::isnan(bend))
      return;
    const float unit =
        std::sqrt((1.0F - share) * (1.0F - share) + 1.0F + share * share);
    const float where = (depth - nearest_) * scale_;
    const float last = static_cast<float>(bins_.size()) - 1.0F;
    NoiseBin& bin = bins_[static_cast<std::size_t>(std::clamp(where, 0.0F, last))];
    if (bins_.size() > 1)
      bin.depths.push_back(depth);
    bin.deviations[static_cast<std::size_t>(direction)].push_back(std::abs(bend) /
                                                                  unit);
    const float change = std::abs(points_.depth[middle + 1] - depth);
    if (change > 0.0F)
      bin.steps.push_back(change);
    else if (change == 0.0F)
      ++bin.ties;
  }

  const GridPoints& points_;
  bool camera_;
  bool laser_;
  bool inverse_;
  float nearest_;
  float scale_;
  std::vector<NoiseBin> bins_;
};

void
append(const std::vector<float>& from, std::vector<float>& to)
{
  to.insert(to.end(), from.begin(), from.end());
}

void
append(const NoiseBin& from, NoiseBin& to)
{
  append(from.depths, to.depths);
  for (std::size_t direction = 0; direction < to.deviations.size(); ++direction)
    append(from.deviations[direction], to.deviations[direction]);
  append(from.steps, to.steps);
  to.ties += from.ties;
}

} // namespace

std::vector<NoiseBin>
sampleNoise(const GridPoints& points, float nearest, float farthest, int threads)
{
  // A camera matches windows: its rows say all. The rings of a laser are aligned to
  // each other less well than the pulses of a ring.
  const bool camera = points.geometry.projection == GridProjection::perspective;
  constexpr std::size_t kParts = 8; // of each direction
  std::vector<std::vector<NoiseBin>> found((camera ? 1 : 2) * kParts);
#pragma omp parallel for schedule(dynamic, 1) num_threads(threads)
  for (std::size_t k = 0; k < found.size(); ++k)
    found[k] = NoiseSampler(points, nearest, farthest)
                   .run(static_cast<int>(k / kParts), k % kParts, kParts);
  for (std::size_t k = 1; k < found.size(); ++k)
    for (std::size_t bin = 0; bin < found[k].size(); ++bin)
      append(found[k][bin], found[0][bin]);
  return std::move(found[0]);
}

} // namespace nurbs
} // namespace pcl
