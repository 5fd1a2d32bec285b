// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

#pragma once

#include <pcl/segmentation/grid_geometry.h>

#include <pcl/point_cloud.h>

#include <cmath>
#include <cstddef>
#include <limits>
#include <vector>

namespace pcl {
namespace nurbs {

/** \brief Points of an organized cloud as separate arrays, row by row; what every grid
 * algorithm reads. Cells without a point hold NaN in every array.
 * \ingroup segmentation
 */
struct GridPoints {
  GridGeometry geometry;
  std::vector<float> x;
  std::vector<float> y;
  std::vector<float> z;
  std::vector<float> depth; /**< by the geometry's projection */

  std::size_t
  size() const
  {
    return x.size();
  }

  bool
  valid(std::size_t cell) const
  {
    return !std::isnan(depth[cell]);
  }

  Eigen::Vector3f
  point(std::size_t cell) const
  {
    return {x[cell], y[cell], z[cell]};
  }
};

/** \brief Spread an organized cloud into arrays.
 * \param[in] cloud organized cloud; not finite points become empty cells
 * \param[in] geometry its raster, of the same width and height
 * \throws std::invalid_argument when the sizes differ
 */
template <typename PointT>
GridPoints
toGridPoints(const pcl::PointCloud<PointT>& cloud, const GridGeometry& geometry);

/** \brief Fill \a depth from the coordinates and drop cells that are not finite or, in
 * a sensor's grid, not in front of the sensor. The result does not depend on the number
 * of threads.
 * \throws std::invalid_argument when sizes and geometry differ */
PCL_NURBS_SEGMENTATION_EXPORT void
completeGridPoints(GridPoints& points, int threads = 1);

template <typename PointT>
GridPoints
toGridPoints(const pcl::PointCloud<PointT>& cloud, const GridGeometry& geometry)
{
  GridPoints points;
  points.geometry = geometry;
  points.x.resize(cloud.size());
  points.y.resize(cloud.size());
  points.z.resize(cloud.size());
  for (std::size_t i = 0; i < cloud.size(); ++i) {
    points.x[i] = cloud[i].x;
    points.y[i] = cloud[i].y;
    points.z[i] = cloud[i].z;
  }
  completeGridPoints(points);
  return points;
}

} // namespace nurbs
} // namespace pcl
