// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

#include "point_welder.h"

#include <cmath>

namespace pcl {
namespace nurbs {

std::uint64_t
PointWelder::cellOf(const Eigen::Vector3d& point) const
{
  constexpr double kCellsPerDistance = 1.0 / 1024.0;
  std::uint64_t key = 0;
  for (int d = 0; d < 3; ++d) {
    const double cell = std::floor(point(d) / distance_ * kCellsPerDistance);
    const auto bits = static_cast<std::uint64_t>(std::llround(std::fmod(cell, 0x1p60)));
    key = (key ^ bits) * 0x9e3779b97f4a7c15U; // cells may share a key: only slower
    key ^= key >> 29U;
  }
  return key;
}

int
PointWelder::add(const Eigen::Vector3d& point)
{
  std::uint64_t last = ~cellOf(point);
  for (int corner = 0; corner < 8; ++corner) {
    Eigen::Vector3d probe = point;
    for (int d = 0; d < 3; ++d)
      probe(d) += (corner >> d & 1) != 0 ? distance_ : -distance_;
    const std::uint64_t cell = cellOf(probe);
    if (cell == last)
      continue;
    last = cell;
    const auto found = cells_.find(cell);
    if (found == cells_.end())
      continue;
    for (const int index : found->second)
      if ((points_[static_cast<std::size_t>(index)] - point).norm() <= distance_)
        return index;
  }
  const int index = static_cast<int>(points_.size());
  points_.push_back(point);
  cells_[cellOf(point)].push_back(index);
  return index;
}

} // namespace nurbs
} // namespace pcl
