// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

#include "town_plots.h"

#include <algorithm>
#include <cmath>

namespace pcl {
namespace nurbs {
namespace {

using Eigen::Vector2d;

constexpr double kCell = 20.0;

/** Whether one of two plots' sides separates them. */
bool
isApart(const Plot& one, const Plot& other)
{
  const auto separates = [](const Plot& a, const Plot& b, const Vector2d& axis) {
    const auto range = [&](const Plot& plot) {
      double low = 1e300;
      double high = -1e300;
      for (const Vector2d& corner : plot.corners()) {
        low = std::min(low, axis.dot(corner));
        high = std::max(high, axis.dot(corner));
      }
      return std::make_pair(low, high);
    };
    const auto ra = range(a);
    const auto rb = range(b);
    return ra.second <= rb.first || rb.second <= ra.first;
  };
  return separates(one, other, one.along) || separates(one, other, one.back()) ||
         separates(one, other, other.along) || separates(one, other, other.back());
}

} // namespace

double
Plot::distance(const Vector2d& place) const
{
  const double x = (place - corner).dot(along);
  const double y = (place - corner).dot(back());
  return std::hypot(std::max({0.0, -x, x - width}), std::max({0.0, -y, y - depth}));
}

/** Keys of the cells that the plot's box, grown by a margin, touches. */
template <typename Visit>
void
TownPlots::visitCells(const Plot& plot, double margin, const Visit& visit) const
{
  Vector2d low = plot.corner;
  Vector2d high = plot.corner;
  for (const Vector2d& corner : plot.corners()) {
    low = low.cwiseMin(corner);
    high = high.cwiseMax(corner);
  }
  const auto cell = [](double coordinate) {
    return static_cast<std::int64_t>(std::floor(coordinate / kCell));
  };
  for (std::int64_t x = cell(low.x() - margin); x <= cell(high.x() + margin); ++x)
    for (std::int64_t y = cell(low.y() - margin); y <= cell(high.y() + margin); ++y)
      visit(static_cast<std::uint64_t>(x) << 32U ^
            (static_cast<std::uint64_t>(y) & 0xFFFFFFFFU));
}

void
TownPlots::add(const Plot& plot)
{
  const auto index = static_cast<std::uint32_t>(plots_.size());
  plots_.push_back(plot);
  visitCells(plot, 0.0, [&](std::uint64_t key) { cells_[key].push_back(index); });
}

bool
TownPlots::isFree(const Plot& plot) const
{
  bool free = true;
  visitCells(plot, 0.0, [&](std::uint64_t key) {
    const auto cell = cells_.find(key);
    if (cell == cells_.end())
      return;
    free = free &&
           std::all_of(cell->second.begin(), cell->second.end(), [&](std::uint32_t i) {
             return isApart(plot, plots_[i]);
           });
  });
  return free;
}

double
TownPlots::clearance(const Vector2d& place, double most) const
{
  Plot point;
  point.corner = place;
  double nearest = most;
  visitCells(point, most, [&](std::uint64_t key) {
    const auto cell = cells_.find(key);
    if (cell == cells_.end())
      return;
    for (const std::uint32_t i : cell->second)
      nearest = std::min(nearest, plots_[i].distance(place));
  });
  return nearest;
}

} // namespace nurbs
} // namespace pcl
