// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

#include "occupancy_grid.h"

#include <algorithm>

namespace pcl {
namespace nurbs {
namespace {

constexpr std::size_t kRow = OccupancyGrid::kEdge;
constexpr std::size_t kCells = kRow * kRow * kRow;

} // namespace

OccupancyGrid::OccupancyGrid(const std::vector<Eigen::Vector3d>& points,
                             const Eigen::Vector3d& center,
                             double cell_size)
    : cell_size_(cell_size),
      corner_(center.array() - 0.5 * kEdge * cell_size),
      levels_(kCells, 0)
{
  for (const Eigen::Vector3d& point : points)
    mark(point);
  for (int level = 1; level < kLevels; ++level)
    spread();
}

void
OccupancyGrid::mark(const Eigen::Vector3d& point)
{
  const Eigen::Array3d place = (point - corner_).array() / cell_size_;
  if (!(place >= 0.0).all() || !(place < kEdge).all())
    return;
  const Eigen::Array<std::size_t, 3, 1> cell = place.cast<std::size_t>();
  levels_[(cell.z() * kRow + cell.y()) * kRow + cell.x()] = kLevels;
}

void
OccupancyGrid::spreadAlong(std::size_t stride, std::vector<std::uint8_t>& levels) const
{
  const std::vector<std::uint8_t> before = levels;
  for (std::size_t i = stride; i + stride < kCells; ++i)
    levels[i] = std::max({before[i - stride], before[i], before[i + stride]});
}

void
OccupancyGrid::spread()
{
  std::vector<std::uint8_t> highest = levels_;
  for (const std::size_t stride : {std::size_t{1}, kRow, kRow * kRow})
    spreadAlong(stride, highest);
  for (std::size_t i = 0; i < kCells; ++i)
    if (highest[i] > levels_[i] + 1)
      levels_[i] = static_cast<std::uint8_t>(highest[i] - 1);
}

ScanPoints
OccupancyGrid::placed(const ScanPoints& scan, const Eigen::Isometry3d& pose) const
{
  const Eigen::Matrix3f turn = (pose.linear() / cell_size_).cast<float>();
  const Eigen::Vector3f shift =
      ((pose.translation() - corner_) / cell_size_).cast<float>();
  ScanPoints places;
  places.reserve(scan.size());
  for (const Eigen::Vector3f& point : scan)
    places.emplace_back(turn * point + shift);
  return places;
}

int
OccupancyGrid::fit(const ScanPoints& scan, const Eigen::Isometry3d& pose) const
{
  constexpr auto kLast = static_cast<float>(kEdge);
  int sum = 0;
  for (const Eigen::Vector3f& point : placed(scan, pose))
    if (point.x() >= 0.0F && point.y() >= 0.0F && point.z() >= 0.0F &&
        point.x() < kLast && point.y() < kLast && point.z() < kLast)
      sum += level(static_cast<std::size_t>(point.x()),
                   static_cast<std::size_t>(point.y()),
                   static_cast<std::size_t>(point.z()));
  return sum;
}

} // namespace nurbs
} // namespace pcl
