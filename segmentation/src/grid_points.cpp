// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

#include <pcl/segmentation/grid_points.h>

#include <stdexcept>

namespace pcl {
namespace nurbs {
namespace {

float
depthOf(const GridPoints& points, const Eigen::Vector3f& forward, std::size_t cell)
{
  const Eigen::Vector3f p = points.point(cell);
  const bool spherical = points.geometry.projection == GridProjection::spherical;
  const float depth = spherical ? p.norm() : forward.dot(p);
  const bool parallel = points.geometry.projection == GridProjection::plane ||
                        points.geometry.projection == GridProjection::lattice;
  const bool usable = std::isfinite(depth) && (parallel || depth > 0.0F);
  return usable ? depth : std::numeric_limits<float>::quiet_NaN();
}

} // namespace

void
completeGridPoints(GridPoints& points, int threads)
{
  const GridGeometry& grid = points.geometry;
  const auto cells =
      static_cast<std::size_t>(grid.width) * static_cast<std::size_t>(grid.height);
  if (grid.width < 0 || grid.height < 0 || points.x.size() != cells)
    throw std::invalid_argument("GridPoints: cloud and grid have different sizes");
  const Eigen::Vector3f forward = grid.frame.row(2).cast<float>();
  points.depth.resize(cells);
#pragma omp parallel for num_threads(threads)
  for (std::size_t i = 0; i < cells; ++i) {
    points.depth[i] = depthOf(points, forward, i);
    if (!points.valid(i))
      points.x[i] = points.y[i] = points.z[i] = points.depth[i];
  }
}

} // namespace nurbs
} // namespace pcl
