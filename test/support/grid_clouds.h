// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

#pragma once

#include <pcl/segmentation/grid_points.h>

#include <pcl/point_types.h>

#include <random>

namespace pcl {
namespace nurbs {
namespace test {

/** A camera's view of a depth function of (column, row); NaN where it returns NaN. */
template <typename Depth>
pcl::PointCloud<pcl::PointXYZ>
cameraCloud(const GridGeometry& grid, const Depth& depth)
{
  pcl::PointCloud<pcl::PointXYZ> cloud(static_cast<std::uint32_t>(grid.width),
                                       static_cast<std::uint32_t>(grid.height));
  for (int row = 0; row < grid.height; ++row)
    for (int column = 0; column < grid.width; ++column) {
      const Eigen::Vector3d ray(
          grid.first_u + column * grid.step_u, grid.first_v + row * grid.step_v, 1.0);
      const Eigen::Vector3d point = depth(column, row) * ray;
      cloud(column, row).getVector3fMap() = point.cast<float>();
    }
  return cloud;
}

/** Ranges of a laser over (column, row) as an organized cloud. */
template <typename Range>
pcl::PointCloud<pcl::PointXYZ>
laserCloud(const GridGeometry& grid, const Range& range)
{
  pcl::PointCloud<pcl::PointXYZ> cloud(static_cast<std::uint32_t>(grid.width),
                                       static_cast<std::uint32_t>(grid.height));
  for (int row = 0; row < grid.height; ++row)
    for (int column = 0; column < grid.width; ++column) {
      const Eigen::Vector3d point = range(column, row) * grid.direction(column, row);
      cloud(column, row).getVector3fMap() = point.cast<float>();
    }
  return cloud;
}

/** A laser of the given raster that turns all around (columns to the right). */
inline GridGeometry
turningLaser(int width, int height)
{
  GridGeometry grid;
  grid.projection = GridProjection::spherical;
  grid.frame = GridGeometry::vehicleFrame();
  grid.width = width;
  grid.height = height;
  grid.wrap = true;
  grid.step_u = 2.0 * M_PI / width;
  grid.first_u = -M_PI + 0.5 * grid.step_u;
  grid.step_v = 0.4 / height;
  grid.first_v = -0.1;
  return grid;
}

} // namespace test
} // namespace nurbs
} // namespace pcl
