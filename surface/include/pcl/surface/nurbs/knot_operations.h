// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors
//
// Operations on knots and degrees (Piegl & Tiller, The NURBS Book, 2nd ed., chapter 5).
// They leave the geometry as it is, but for rounding, unless they take a tolerance.
//
// Knots may be clamped, unclamped or periodic and curves rational everywhere. Weights
// that are all equal stay exactly equal. Costs are given for n control points of degree
// p; a surface pays them once for every control point across the direction.

#pragma once

#include <pcl/surface/nurbs/nurbs_curve.h>
#include <pcl/surface/nurbs/nurbs_surface.h>

#include <utility>
#include <vector>

namespace pcl {
namespace nurbs {

/** \brief Result of an operation that may move the geometry within a tolerance.
 * \ingroup surface */
template <class Geometry>
struct Simplified {
  Geometry geometry;      /**< the input, unchanged, if \a steps is 0 */
  int steps = 0;          /**< how many knots or degrees were removed */
  double max_error = 0.0; /**< no point moved by more (same parameter), in metres */
};

/** \brief Insert the knot \a u several times (algorithm A5.1).
 * \param[in] curve curve to refine
 * \param[in] u knot to insert, in the domain
 * \param[in] times number of copies, at least 1
 * \throws std::invalid_argument if \a u is not in the domain or would get more than
 * degree copies. O(n + p times). */
template <int Dim>
NurbsCurve<Dim>
insertKnot(const NurbsCurve<Dim>& curve, double u, int times = 1);

/** \brief Insert a knot of one direction of a surface (algorithm A5.3).
 * \copydetails insertKnot */
PCL_NURBS_SURFACE_EXPORT NurbsSurface
insertKnot(const NurbsSurface& surface, Direction direction, double u, int times = 1);

/** \brief Insert many knots at once (algorithm A5.4).
 * \param[in] curve curve to refine
 * \param[in] knots non-decreasing knots of the domain, repeated as often as wanted
 * \throws std::invalid_argument if they decrease, leave the domain or if one would get
 * more than degree copies. O(n + p knots.size()). */
template <int Dim>
NurbsCurve<Dim>
refineKnots(const NurbsCurve<Dim>& curve, const std::vector<double>& knots);

/** \brief Insert many knots of one direction of a surface (algorithm A5.5).
 * \copydetails refineKnots */
PCL_NURBS_SURFACE_EXPORT NurbsSurface
refineKnots(const NurbsSurface& surface,
            Direction direction,
            const std::vector<double>& knots);

/** \brief Remove the inner knot \a u up to \a times times while no point moves by more
 * than \a tolerance (task of algorithm A5.8; a smaller error than its, and a bound that
 * holds for rational curves wherever the origin is).
 * \param[in] curve curve to simplify
 * \param[in] u a knot strictly inside of the domain, exactly
 * \param[in] times most copies to remove, at least 1; more than there are means all
 * \param[in] tolerance finite, not negative, in the unit of the control points
 * \throws std::invalid_argument if an argument is not as said above. O(times (n + p²)).
 */
template <int Dim>
Simplified<NurbsCurve<Dim>>
removeKnot(const NurbsCurve<Dim>& curve, double u, int times, double tolerance);

/** \brief Remove a knot of one direction of a surface. \copydetails removeKnot */
PCL_NURBS_SURFACE_EXPORT Simplified<NurbsSurface>
removeKnot(const NurbsSurface& surface,
           Direction direction,
           double u,
           int times,
           double tolerance);

/** \brief Remove as many inner knots as \a tolerance allows, the cheapest first; the
 * error adds up per knot span, so \a tolerance holds for the whole (task of algorithm
 * A9.8). The ends of clamped curves stay where they are.
 * \throws std::invalid_argument if \a tolerance is negative or not finite. O(n²). */
template <int Dim>
Simplified<NurbsCurve<Dim>>
removeRedundantKnots(const NurbsCurve<Dim>& curve, double tolerance);

/** \brief The same for a surface: half of \a tolerance may be spent in u, the rest in
 * v. \copydetails removeRedundantKnots */
PCL_NURBS_SURFACE_EXPORT Simplified<NurbsSurface>
removeRedundantKnots(const NurbsSurface& surface, double tolerance);

/** \brief Raise the degree (task of algorithm A5.9). Every distinct knot gets \a times
 * more copies, so continuity stays; clamped curves stay clamped, others unclamped.
 * \throws std::invalid_argument if \a times is negative or the degree would exceed
 * kMaxDegree. O(times p² n). */
template <int Dim>
NurbsCurve<Dim>
elevateDegree(const NurbsCurve<Dim>& curve, int times = 1);

/** \brief Raise the degree of one direction of a surface (algorithm A5.10).
 * \copydetails elevateDegree */
PCL_NURBS_SURFACE_EXPORT NurbsSurface
elevateDegree(const NurbsSurface& surface, Direction direction, int times = 1);

/** \brief Lower the degree by one if no point has to move by more than \a tolerance
 * (task of algorithm A5.11): least squares of control points with fixed ends. Every
 * inner knot loses one copy, but its last. The result is clamped.
 * \return the curve of lower degree with steps = 1, or the input with steps = 0
 * \throws std::invalid_argument if the degree is 1 or \a tolerance is negative or not
 * finite. O(p n²). */
template <int Dim>
Simplified<NurbsCurve<Dim>>
reduceDegree(const NurbsCurve<Dim>& curve, double tolerance);

/** \brief Lower the degree of one direction of a surface. \copydetails reduceDegree */
PCL_NURBS_SURFACE_EXPORT Simplified<NurbsSurface>
reduceDegree(const NurbsSurface& surface, Direction direction, double tolerance);

/** \brief The same curve with degree + 1 equal knots at both ends of its domain. */
template <int Dim>
NurbsCurve<Dim>
clampKnots(const NurbsCurve<Dim>& curve);

/** \brief The same surface with clamped knots in one direction. */
PCL_NURBS_SURFACE_EXPORT NurbsSurface
clampKnots(const NurbsSurface& surface, Direction direction);

/** \brief The parts before and after \a u, parameters kept; both are clamped there.
 * \throws std::invalid_argument if \a u is not strictly inside of the domain */
template <int Dim>
std::pair<NurbsCurve<Dim>, NurbsCurve<Dim>>
split(const NurbsCurve<Dim>& curve, double u);

/** \brief The parts of a surface before and after a parameter of one direction.
 * \copydetails split */
PCL_NURBS_SURFACE_EXPORT std::pair<NurbsSurface, NurbsSurface>
split(const NurbsSurface& surface, Direction direction, double parameter);

/** \brief The part over [u0, u1], parameters kept, clamped.
 * \throws std::invalid_argument unless u0 < u1, both in the domain */
template <int Dim>
NurbsCurve<Dim>
subCurve(const NurbsCurve<Dim>& curve, double u0, double u1);

/** \brief The part over [u0, u1] x [v0, v1], parameters kept, clamped.
 * \throws std::invalid_argument unless u0 < u1 and v0 < v1, all in the domain */
PCL_NURBS_SURFACE_EXPORT NurbsSurface
subSurface(const NurbsSurface& surface, double u0, double u1, double v0, double v1);

/** \brief The Bézier pieces of the non-empty spans, in order (algorithm A5.6). The
 * domain of a piece is its parameter interval. */
template <int Dim>
std::vector<NurbsCurve<Dim>>
decomposeBezier(const NurbsCurve<Dim>& curve);

/** \brief The Bézier patches of the non-empty spans (algorithm A5.7); the patch of span
 * i in u and j in v is element i * (number of spans in v) + j. The domain of a patch is
 * its parameter rectangle. */
PCL_NURBS_SURFACE_EXPORT std::vector<NurbsSurface>
decomposeBezier(const NurbsSurface& surface);

/** \brief One curve that runs through \a first and then \a second.
 *
 * The lower degree is raised, ends are clamped, the knots of \a second follow on those
 * of \a first with their spacing kept, and its weights are scaled to fit. The joint is
 * a knot with degree copies (C0).
 * \param[in] first first part
 * \param[in] second second part
 * \param[in] tolerance largest gap; the joint is put halfway (unit of control points)
 * \throws std::invalid_argument if the gap is wider than \a tolerance */
template <int Dim>
NurbsCurve<Dim>
join(const NurbsCurve<Dim>& first, const NurbsCurve<Dim>& second, double tolerance);

/** \brief The same curves with one degree and one clamped knot vector, that over the
 * domain of the first curve which has all their knots (section 10.3).
 * \param[in] curves at least one curve
 * \param[in] knot_tolerance knots closer than this share of the domain become one; it
 *            absorbs the rounding of the mapping to one domain
 * \throws std::invalid_argument if there is no curve */
template <int Dim>
std::vector<NurbsCurve<Dim>>
makeCompatible(const std::vector<NurbsCurve<Dim>>& curves,
               double knot_tolerance = 1e-12);

} // namespace nurbs
} // namespace pcl
