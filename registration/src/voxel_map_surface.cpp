// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

#include <pcl/registration/voxel_map.h>

#include "voxel_key.h"

namespace pcl {
namespace nurbs {

std::optional<Eigen::Vector3i>
VoxelMap::blockAt(const Eigen::Vector3d& place) const
{
  const double half = 0.5 * options_.voxel_size;
  return voxelCell((place.array() - half).matrix(), inverse_size_);
}

PointMoments
VoxelMap::surface(const Eigen::Vector3d& place) const
{
  const auto block = blockAt(place);
  return block ? surfaceOfBlock(*block) : PointMoments();
}

PointMoments
VoxelMap::surfaceOfBlock(const Cell& block) const
{
  const Eigen::Vector3d middle =
      (block.cast<double>().array() + 1.0) * options_.voxel_size;
  MomentSums sums;
  for (int i = 0; i < 8; ++i) {
    const Cell corner = block + Cell(i & 1, (i >> 1) & 1, (i >> 2) & 1);
    const std::int32_t voxel = find(corner);
    if (voxel >= 0)
      sums.add(voxels_[static_cast<std::size_t>(voxel)].sums, center(corner) - middle);
  }
  return sums.moments(middle);
}

VoxelMap
VoxelMap::coarsened() const
{
  VoxelMapOptions options = options_;
  options.voxel_size *= 2.0;
  options.min_spacing *= 2.0;
  VoxelMap coarse(options);
  for (std::size_t i = 0; i < voxels_.size(); ++i) {
    const Cell cell(voxels_[i].cell.array().unaryExpr([](int c) { return c >> 1; }));
    const std::int32_t target = coarse.findOrAdd(cell);
    const Eigen::Vector3d shift = center(voxels_[i].cell) - coarse.center(cell);
    coarse.voxels_[static_cast<std::size_t>(target)].sums.add(voxels_[i].sums, shift);
    const Eigen::Vector3f* const first = &points_[firstPoint(static_cast<int>(i))];
    for (const Eigen::Vector3f* p = first; p != first + voxels_[i].count; ++p)
      coarse.keep(target, *p + shift.cast<float>());
  }
  return coarse;
}

} // namespace nurbs
} // namespace pcl
