// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

#pragma once

#include <pcl/surface/nurbs/conics.h>
#include <pcl/surface/nurbs/nurbs_surface.h>

namespace pcl {
namespace nurbs {

/** \file
 * Exact analytic surfaces. Each is placed by a rigid frame (frameFromAxis() makes one
 * from an origin and an axis), lengths are in metres and angles in radians. Parameters
 * carry the same units: a length parameter is exact, an angle parameter equals the
 * angle at the knots and in the middle of each span and is within 0.0161 rad of it in
 * between. The normal S_u x S_v points away from the axis or centre. Surfaces of
 * revolution start at the x axis of the frame and turn counter-clockwise about z. All
 * are O(1) and throw std::invalid_argument for a frame that is not rigid, a size that
 * is not positive and finite, or a range outside of the one stated. Construction:
 * Piegl & Tiller, sections 7.5 and 8.2 to 8.5.
 */

/** \brief Bilinear patch through four corners; domain [0, 1]².
 * \throws std::invalid_argument if a corner is not finite \ingroup surface */
PCL_NURBS_SURFACE_EXPORT NurbsSurface
bilinearPatch(const Eigen::Vector3d& corner_00,
              const Eigen::Vector3d& corner_10,
              const Eigen::Vector3d& corner_01,
              const Eigen::Vector3d& corner_11);

/** \brief Rectangle of the xy plane of \a frame with one corner at its origin: degree 1
 * x 1, four control points, S(u, v) = origin + u x + v y on [0, size_x] x [0, size_y];
 * the normal is z.
 * \ingroup surface */
PCL_NURBS_SURFACE_EXPORT NurbsSurface
planePatch(const Eigen::Isometry3d& frame, double size_x, double size_y);

/** \brief Cylinder about the z axis of \a frame: u is the angle, v in [0, height] the
 * height above the origin. Degree 2 x 1.
 * \ingroup surface */
PCL_NURBS_SURFACE_EXPORT NurbsSurface
cylinder(const Eigen::Isometry3d& frame,
         double radius,
         double height,
         const AngleRange& sweep = {});

/** \brief Frustum of a cone about the z axis of \a frame: u is the angle, v in [0,
 * height] the height above the origin. Degree 2 x 1.
 * \param[in] frame axis
 * \param[in] radius_bottom radius at height 0
 * \param[in] radius_top radius at \a height; one of the two radii may be 0 (an apex)
 * \param[in] height distance of the two circles, positive
 * \param[in] sweep range of u
 * \ingroup surface */
PCL_NURBS_SURFACE_EXPORT NurbsSurface
frustum(const Eigen::Isometry3d& frame,
        double radius_bottom,
        double radius_top,
        double height,
        const AngleRange& sweep = {});

/** \brief Cone with its base circle around the origin of \a frame and its apex at
 * \a height on the z axis, a frustum with top radius 0. \ingroup surface */
PCL_NURBS_SURFACE_EXPORT NurbsSurface
cone(const Eigen::Isometry3d& frame,
     double radius,
     double height,
     const AngleRange& sweep = {});

/** \brief The latitudes from pole to pole. */
constexpr AngleRange kAllLatitudes{-1.570796326794896619231, 1.570796326794896619231};

/** \brief Sphere around the origin of \a frame, or a part of it: u is the longitude, v
 * the latitude. Degree 2 x 2; a latitude of +-pi/2 is a degenerate border (pole).
 * \param[in] frame centre, poles along +-z
 * \param[in] radius radius
 * \param[in] longitude range of u, sweep at most 2 pi
 * \param[in] latitude range of v inside of [-pi/2, pi/2]
 * \ingroup surface */
PCL_NURBS_SURFACE_EXPORT NurbsSurface
sphere(const Eigen::Isometry3d& frame,
       double radius,
       const AngleRange& longitude = {},
       const AngleRange& latitude = kAllLatitudes);

/** \brief Torus around the z axis of \a frame, or a part of it: u is the angle about
 * the axis, v the angle about the tube's centre line, 0 on the outside. Degree 2 x 2.
 * \param[in] frame centre and axis
 * \param[in] radius_major radius of the tube's centre line
 * \param[in] radius_minor radius of the tube
 * \param[in] around range of u
 * \param[in] tube range of v
 * \throws std::invalid_argument also if that part of the tube crosses the axis
 * \ingroup surface */
PCL_NURBS_SURFACE_EXPORT NurbsSurface
torus(const Eigen::Isometry3d& frame,
      double radius_major,
      double radius_minor,
      const AngleRange& around = {},
      const AngleRange& tube = {});

} // namespace nurbs
} // namespace pcl
