// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

#pragma once

#include <pcl/surface/nurbs/nurbs_curve.h>
#include <pcl/surface/nurbs/segment_fitter.h>

#include <Eigen/Core>

namespace pcl {
namespace nurbs {

/** \brief Points around a cylinder: parameters on an exact rational arc. */
struct ArcPoints {
  NurbsCurve3 arc;             /**< unit circle; its weights make circles exact */
  Eigen::Matrix2Xd parameters; /**< arc parameter, height along the axis */
  Eigen::VectorXd radii;       /**< distance from the axis */
};

/** \brief Parameters of points about an axis.
 * \param[in] positions points, metres
 * \param[in] frame z is the axis
 * \param[in] closed full turn; otherwise the arc is cut at the widest gap
 * \throws std::domain_error if the points lie on one half-plane of the axis */
ArcPoints
arcParameters(const Eigen::Matrix3Xd& positions,
              const Eigen::Isometry3d& frame,
              bool closed);

} // namespace nurbs
} // namespace pcl
