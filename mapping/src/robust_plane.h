// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

#pragma once

#include <Eigen/Geometry>

namespace pcl {
namespace nurbs {

/** \brief Space between two parallel planes. */
struct Slab {
  Eigen::Hyperplane<double, 3> middle;
  double reach = 0.0; /**< half the thickness, metres */

  bool
  contains(const Eigen::Vector3d& point) const
  {
    return middle.absDistance(point) <= reach;
  }
};

/** \brief Slab around the plane that most points are near to, whatever the others do
 * (M-estimator sample consensus: Torr and Zisserman, "MLESAC", CVIU 2000), refined by
 * the principal axes of the points inside. The same result for the same points.
 * O(points).
 * \param[in] positions at least three points, metres
 * \param[in] reach half the thickness of the slab, metres, > 0 */
Slab
robustSlab(const Eigen::Matrix3Xd& positions, double reach);

} // namespace nurbs
} // namespace pcl
