// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

#pragma once

#include <pcl/surface/nurbs/conics.h>
#include <pcl/surface/nurbs/nurbs_surface.h>

#include <vector>

namespace pcl {
namespace nurbs {

/** \file
 * Surfaces from curves. Where several curves run in the same direction they may differ
 * in degree, knots and domain; they are made compatible exactly and the result has the
 * domain of the first. Lengths are in the unit of the control points (metres).
 */

/** \brief Ruled surface S(u, v) = (1 - v) C0(u) + v C1(u) for polynomial curves; for
 * rational ones the same in homogeneous space, so rulings are straight lines between
 * points of equal parameter (section 8.4). v in [0, 1], degree 1.
 * \ingroup surface */
PCL_NURBS_SURFACE_EXPORT NurbsSurface
ruledSurface(const NurbsCurve3& start, const NurbsCurve3& end);

/** \brief Surface of revolution (algorithm A8.1): the generatrix turned about the z
 * axis of \a axis_frame (see frameFromAxis()) by every angle of \a sweep, 0 being where
 * it stands.
 *
 * u is the angle as in circularArc(), degree 2; v is the parameter of the generatrix.
 * Control points of the generatrix on the axis give a degenerate border. O(n).
 * \throws std::invalid_argument if the sweep is not in (0, 2 pi] or the frame is not
 * rigid
 * \ingroup surface */
PCL_NURBS_SURFACE_EXPORT NurbsSurface
revolvedSurface(const NurbsCurve3& generatrix,
                const Eigen::Isometry3d& axis_frame,
                const AngleRange& sweep = {});

/** \brief The profile moved without turning along a trajectory: S(u, v) = C(u) + T(v) -
 * T(v_0) (section 10.4, exact). v is the parameter of the trajectory. O(n m).
 * \ingroup surface */
PCL_NURBS_SURFACE_EXPORT NurbsSurface
translationalSurface(const NurbsCurve3& profile, const NurbsCurve3& trajectory);

/** \brief General cylinder (section 8.3): the profile extruded by \a direction; v in
 * [0, |direction|] is a length, degree 1.
 * \throws std::invalid_argument if the direction is zero or not finite
 * \ingroup surface */
PCL_NURBS_SURFACE_EXPORT NurbsSurface
extrudedSurface(const NurbsCurve3& profile, const Eigen::Vector3d& direction);

/** \brief Skinned surface through section curves (section 10.3).
 *
 * u is the parameter of the sections; S(u, v_k) is section k exactly. Without
 * parameters, v_k are averaged chord lengths on [0, 1] (equation 10.8); knots follow
 * from them by averaging (9.8). Rational sections are scaled to a mean weight of 1 and
 * interpolated in homogeneous space, where neighbours with very different weights can
 * ask for a negative one in between; a lower degree helps. O(k³ + k² n) for k sections
 * of n control points.
 * \param[in] sections at least degree + 1 curves, in order
 * \param[in] degree degree across the sections, v
 * \param[in] parameters one increasing v_k per section, or none
 * \throws std::invalid_argument if there are too few sections, neighbours coincide,
 * parameters do not increase, or the interpolation needs a weight that is not positive
 * \ingroup surface */
PCL_NURBS_SURFACE_EXPORT NurbsSurface
loftedSurface(const std::vector<NurbsCurve3>& sections,
              int degree,
              const std::vector<double>& parameters = {});

/** \brief The profile moved along a trajectory and turned with it (section 10.4,
 * algorithm A10.2 with rotation-minimising frames by double reflection).
 *
 * The profile stands in space at the start of the trajectory; it is carried along
 * rigidly to \a sections parameters spaced evenly over each span, and these copies are
 * skinned with degree 3 (fewer than 4 copies: degree sections - 1). Exact at the
 * copies; between them the error falls with the fourth power of their spacing if the
 * trajectory is smooth. v is the parameter of the trajectory.
 * \param[in] profile curve that is moved
 * \param[in] trajectory path with a tangent everywhere
 * \param[in] sections number of copies, at least 2
 * \throws std::invalid_argument for fewer than 2 sections
 * \throws std::domain_error if the trajectory has no tangent at a section
 * \ingroup surface */
PCL_NURBS_SURFACE_EXPORT NurbsSurface
sweptSurface(const NurbsCurve3& profile, const NurbsCurve3& trajectory, int sections);

/** \brief Bilinearly blended Coons patch, the boolean sum of two ruled surfaces and the
 * bilinear one (section 10.6), on [0, 1]².
 *
 * S(u, 0) = \a bottom, S(u, 1) = \a top, S(0, v) = \a left, S(1, v) = \a right. The sum
 * is taken in homogeneous space, where curves are first scaled so that their weights
 * agree at the corners; polynomial curves and arcs always allow that.
 * \param[in] bottom border v = 0
 * \param[in] top border v = 1
 * \param[in] left border u = 0
 * \param[in] right border u = 1
 * \param[in] corner_tolerance largest gap at a corner, in metres
 * \throws std::invalid_argument if the borders do not meet, or weights cannot agree at
 * the corners
 * \ingroup surface */
PCL_NURBS_SURFACE_EXPORT NurbsSurface
coonsSurface(const NurbsCurve3& bottom,
             const NurbsCurve3& top,
             const NurbsCurve3& left,
             const NurbsCurve3& right,
             double corner_tolerance = 1e-9);

} // namespace nurbs
} // namespace pcl
