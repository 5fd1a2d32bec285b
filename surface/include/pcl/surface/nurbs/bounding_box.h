// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

#pragma once

#include <pcl/surface/nurbs/nurbs_curve.h>
#include <pcl/surface/nurbs/nurbs_surface.h>

#include <Eigen/Geometry>

namespace pcl {
namespace nurbs {

/** \brief Box of the control points, which holds the surface (weights are positive).
 * O(n). */
PCL_NURBS_SURFACE_EXPORT Eigen::AlignedBox3d
controlBox(const NurbsSurface& surface);

/** \brief Box of the control points of a curve. O(n). */
template <int Dim>
Eigen::AlignedBox<double, Dim>
controlBox(const NurbsCurve<Dim>& curve);

/** \brief Box that holds the surface and exceeds its exact box by at most
 * \a relative_tolerance times the diagonal of the control box on each side.
 *
 * Branch and bound per side: Bézier pieces whose control points reach beyond the
 * farthest point known are halved.
 * \throws std::invalid_argument if the tolerance is below 1e-13 */
PCL_NURBS_SURFACE_EXPORT Eigen::AlignedBox3d
tightBox(const NurbsSurface& surface, double relative_tolerance = 1e-9);

/** \brief The same for a curve. */
template <int Dim>
Eigen::AlignedBox<double, Dim>
tightBox(const NurbsCurve<Dim>& curve, double relative_tolerance = 1e-9);

extern template PCL_NURBS_SURFACE_EXPORT Eigen::AlignedBox<double, 2>
controlBox<2>(const NurbsCurve<2>&);
extern template PCL_NURBS_SURFACE_EXPORT Eigen::AlignedBox<double, 3>
controlBox<3>(const NurbsCurve<3>&);
extern template PCL_NURBS_SURFACE_EXPORT Eigen::AlignedBox<double, 2>
tightBox<2>(const NurbsCurve<2>&, double);
extern template PCL_NURBS_SURFACE_EXPORT Eigen::AlignedBox<double, 3>
tightBox<3>(const NurbsCurve<3>&, double);

} // namespace nurbs
} // namespace pcl
