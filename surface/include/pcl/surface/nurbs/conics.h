// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

#pragma once

#include <pcl/surface/nurbs/nurbs_curve.h>

#include <Eigen/Geometry>

namespace pcl {
namespace nurbs {

/** \brief A counter-clockwise range of angles in radians; the default is one full turn.
 * \ingroup surface */
struct AngleRange {
  double first = 0.0;
  double last = 6.283185307179586476925;

  double
  sweep() const
  {
    return last - first;
  }
};

/** \brief Rigid frame whose origin is \a origin and whose z axis has the direction of
 * \a axis; the x and y axes are a fixed, arbitrary choice.
 * \throws std::invalid_argument if a value is not finite or \a axis is zero */
PCL_NURBS_SURFACE_EXPORT Eigen::Isometry3d
frameFromAxis(const Eigen::Vector3d& origin, const Eigen::Vector3d& axis);

/** \brief Exact arc of an ellipse in the plane (algorithm A7.1 under an affine map).
 *
 * C(u) is rational of degree 2 with one segment per quarter turn or part of it. The
 * domain is the range of the angle (eccentric anomaly) and the parameter equals the
 * angle at the joints and in the middle of each segment; in between the two differ by
 * at most 0.0161 rad. O(1).
 * \param[in] frame centre and directions of the two semi-axes
 * \param[in] radius_x semi-axis along the x axis of the frame, metres
 * \param[in] radius_y semi-axis along the y axis of the frame, metres
 * \param[in] range angles of the end points, 0 < sweep <= 2 pi
 * \throws std::invalid_argument if a radius is not positive, the sweep is out of range
 * or the frame is not rigid */
PCL_NURBS_SURFACE_EXPORT NurbsCurve2
ellipticArc(const Eigen::Isometry2d& frame,
            double radius_x,
            double radius_y,
            const AngleRange& range = {});

/** \brief Exact arc of an ellipse in the xy plane of a frame in space. */
PCL_NURBS_SURFACE_EXPORT NurbsCurve3
ellipticArc(const Eigen::Isometry3d& frame,
            double radius_x,
            double radius_y,
            const AngleRange& range = {});

/** \brief Exact circular arc, or circle, in the plane (algorithm A7.1). Parameters and
 * errors as for ellipticArc(). */
PCL_NURBS_SURFACE_EXPORT NurbsCurve2
circularArc(const Eigen::Isometry2d& frame,
            double radius,
            const AngleRange& range = {});

/** \brief Exact circular arc, or circle, in the xy plane of a frame in space. */
PCL_NURBS_SURFACE_EXPORT NurbsCurve3
circularArc(const Eigen::Isometry3d& frame,
            double radius,
            const AngleRange& range = {});

} // namespace nurbs
} // namespace pcl
