// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

#include "polygon_index.h"

#include "segment_distance.h"

#include <algorithm>
#include <cmath>

namespace pcl {
namespace nurbs {
namespace {

constexpr std::size_t kEntriesPerEdge = 16; // on average, over all bands

double
cross(const Eigen::Vector2d& a, const Eigen::Vector2d& b)
{
  return a.x() * b.y() - a.y() * b.x();
}

} // namespace

PolygonIndex::PolygonIndex(const std::vector<std::vector<Eigen::Vector2d>>& polygons,
                           double border_tolerance)
    : tolerance_(border_tolerance)
{
  std::vector<Edge> edges;
  for (const auto& polygon : polygons)
    for (std::size_t i = 0; i < polygon.size(); ++i)
      edges.push_back({polygon[i], polygon[(i + 1) % polygon.size()]});
  if (edges.empty())
    return;
  v_low_ = v_high_ = edges.front().from.y();
  for (const Edge& edge : edges) {
    v_low_ = std::min(v_low_, edge.from.y());
    v_high_ = std::max(v_high_, edge.from.y());
  }
  v_low_ -= tolerance_;
  v_high_ += tolerance_;
  chooseBands(edges);

  const auto forEachBand = [this](const Edge& edge, auto&& action) {
    const auto [low, high] = std::minmax(edge.from.y(), edge.to.y());
    const std::size_t last = band(high + tolerance_);
    for (std::size_t b = band(low - tolerance_); b <= last; ++b)
      action(b);
  };
  for (const Edge& edge : edges)
    forEachBand(edge, [this](std::size_t b) { ++first_[b + 1]; });
  for (std::size_t b = 1; b < first_.size(); ++b)
    first_[b] += first_[b - 1];
  edges_.resize(first_.back());
  std::vector<std::size_t> next(first_.begin(), first_.end() - 1);
  for (const Edge& edge : edges)
    forEachBand(edge, [&](std::size_t b) { edges_[next[b]++] = edge; });
}

void
PolygonIndex::chooseBands(const std::vector<Edge>& edges)
{
  double extent = 0.0;
  for (const Edge& edge : edges)
    extent += std::abs(edge.to.y() - edge.from.y()) + 2.0 * tolerance_;
  const double height = std::max(v_high_ - v_low_, 1e-300);
  const double n = static_cast<double>(edges.size());
  // An edge meets one band more than its extent fills.
  const double bands = std::min(n, (kEntriesPerEdge - 1) * n * height / extent);
  const auto count = static_cast<std::size_t>(std::max(1.0, bands));
  first_.assign(count + 1, 0);
  bands_per_v_ = static_cast<double>(count) / height;
}

std::size_t
PolygonIndex::band(double v) const
{
  const double position = std::max(0.0, (v - v_low_) * bands_per_v_);
  return std::min(static_cast<std::size_t>(position), first_.size() - 2);
}

bool
PolygonIndex::isNear(const Edge& edge, const Eigen::Vector2d& point) const
{
  const Eigen::Array2d low = edge.from.cwiseMin(edge.to).array() - tolerance_;
  const Eigen::Array2d high = edge.from.cwiseMax(edge.to).array() + tolerance_;
  return (point.array() >= low).all() && (point.array() <= high).all() &&
         segmentDistance<2>(point, edge.from, edge.to) <= tolerance_;
}

bool
PolygonIndex::isOnBorder(const Eigen::Vector2d& point) const
{
  if (!(point.y() >= v_low_ && point.y() <= v_high_))
    return false;
  const std::size_t b = band(point.y());
  return std::any_of(edges_.begin() + static_cast<std::ptrdiff_t>(first_[b]),
                     edges_.begin() + static_cast<std::ptrdiff_t>(first_[b + 1]),
                     [&](const Edge& edge) { return isNear(edge, point); });
}

bool
PolygonIndex::contains(const Eigen::Vector2d& point) const
{
  if (!(point.y() >= v_low_ && point.y() <= v_high_))
    return false;
  const std::size_t b = band(point.y());
  int winding = 0;
  for (std::size_t i = first_[b]; i < first_[b + 1]; ++i) {
    const Edge& edge = edges_[i];
    if (std::max(edge.from.x(), edge.to.x()) < point.x() - tolerance_)
      continue; // the ray runs towards greater u
    const auto [low, high] = std::minmax(edge.from.y(), edge.to.y());
    if (point.y() < low - tolerance_ || point.y() > high + tolerance_)
      continue;
    const Eigen::Vector2d along = edge.to - edge.from;
    const double side = cross(along, point - edge.from);
    if (side * side <= tolerance_ * tolerance_ * along.squaredNorm() &&
        isNear(edge, point))
      return true;
    const bool from_below = edge.from.y() <= point.y();
    if (from_below == (edge.to.y() <= point.y()))
      continue;
    if (from_below && side > 0.0)
      ++winding;
    else if (!from_below && side < 0.0)
      --winding;
  }
  return winding != 0;
}

} // namespace nurbs
} // namespace pcl
