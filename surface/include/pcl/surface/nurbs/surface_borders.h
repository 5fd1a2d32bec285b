// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

#pragma once

#include <pcl/surface/nurbs/nurbs_surface.h>

#include <array>

namespace pcl {
namespace nurbs {

/** \brief The four borders of a surface's domain. */
enum class SurfaceBorder { UMin, UMax, VMin, VMax };

/** \brief All borders, for loops. */
constexpr std::array<SurfaceBorder, 4> kSurfaceBorders{
    SurfaceBorder::UMin, SurfaceBorder::UMax, SurfaceBorder::VMin, SurfaceBorder::VMax};

/** \brief The iso-curve along a border, in the sense of growing parameter. */
PCL_NURBS_SURFACE_EXPORT NurbsCurve3
borderCurve(const NurbsSurface& surface, SurfaceBorder border);

/** \brief Whether a border has shrunk to a point (a pole or an apex).
 *
 * True if all control points of the border lie within \a tolerance metres of their
 * first; by the convex hull property so does the border then. Exact for tolerance 0 up
 * to rounding. O(n).
 * \ingroup surface */
PCL_NURBS_SURFACE_EXPORT bool
isDegenerate(const NurbsSurface& surface, SurfaceBorder border, double tolerance);

/** \brief Whether the surface closes on itself in a direction: both ends of the domain
 * map to the same border curve, within \a tolerance metres at equal parameters.
 *
 * The borders are compared at 2 q + 1 parameters of each span, as many as it takes to
 * tell two rational curves of degree q apart. O(n q).
 * \ingroup surface */
PCL_NURBS_SURFACE_EXPORT bool
isClosed(const NurbsSurface& surface, Direction direction, double tolerance);

} // namespace nurbs
} // namespace pcl
