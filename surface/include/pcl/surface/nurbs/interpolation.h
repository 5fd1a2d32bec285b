// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors
//
// Curves and surfaces through, or near to, ordered points (Piegl & Tiller, The NURBS
// Book, 2nd ed., chapter 9). The results are polynomial (all weights 1).
//
// Every fit is one banded QR decomposition per direction: O(m p (p + d)) for m points
// with d coordinates in all (a surface counts those of one line across).

#pragma once

#include <pcl/surface/nurbs/nurbs_curve.h>
#include <pcl/surface/nurbs/nurbs_surface.h>

#include <Eigen/Core>

#include <vector>

namespace pcl {
namespace nurbs {

/** \brief How parameters are spread over a sequence of points. */
enum class Parameterization {
  Uniform,     /**< equal steps (equation 9.3) */
  ChordLength, /**< steps as the distances of the points (equation 9.5) */
  Centripetal  /**< steps as the roots of the distances (equation 9.6): for sharp turns
                */
};

/** \brief Points of a sequence, one column each. */
template <int Dim>
using PointSequence = Eigen::Matrix<double, Dim, Eigen::Dynamic>;

/** \brief A rectangular grid of points in space: (i, j) is column i * count_v + j. */
struct PointGrid {
  Eigen::Matrix3Xd points;
  int count_u = 0;
  int count_v = 0;
};

/** \brief What a least-squares fit of a curve takes into account. */
struct CurveFitOptions {
  Eigen::VectorXd weights; /**< one positive weight per point; none means all 1 */
  bool fix_ends = true;    /**< run exactly through the first and last point */
};

/** \brief Parameters on [0, 1] for a sequence of points.
 * \throws std::invalid_argument for fewer than two points, values that are not finite,
 * or points that all coincide (unless the parameterization is uniform) */
template <int Dim>
std::vector<double>
spreadParameters(const PointSequence<Dim>& points, Parameterization parameterization);

/** \brief Parameters on [0, 1] of one direction of a grid: mean over its lines
 * (algorithm A9.3). Lines whose points all coincide, as at a pole, do not count.
 * \throws std::invalid_argument as for a sequence, or if no line counts */
PCL_NURBS_SURFACE_EXPORT std::vector<double>
spreadParameters(const PointGrid& grid,
                 Direction direction,
                 Parameterization parameterization);

/** \brief Clamped knots with as many control points as parameters, inner knots being
 * means of degree parameters (equation 9.8): interpolation with them is always
 * possible.
 * \param[in] degree polynomial degree
 * \param[in] parameters at least degree + 1, strictly increasing
 * \throws std::invalid_argument if they are not */
PCL_NURBS_SURFACE_EXPORT KnotVector
interpolationKnots(int degree, const std::vector<double>& parameters);

/** \brief Clamped knots for a least-squares fit: equation 9.8 over \a control_points
 * parameters picked at even steps of their index. The fit is always determined, and
 * well-conditioned up to as many control points as points, where equations 9.68 and
 * 9.69 are not.
 * \param[in] degree polynomial degree
 * \param[in] parameters at least \a control_points, strictly increasing
 * \param[in] control_points at least degree + 1
 * \throws std::invalid_argument if they are not */
PCL_NURBS_SURFACE_EXPORT KnotVector
approximationKnots(int degree,
                   const std::vector<double>& parameters,
                   int control_points);

/** \brief Curve through points at given parameters (algorithm A9.1).
 * \param[in] points one column each
 * \param[in] parameters one per point, strictly increasing, in the domain of \a knots
 * \param[in] knots as many control points as points
 * \throws std::invalid_argument if that does not hold
 * \throws std::domain_error if a control point has no parameter in its support, so that
 * no such curve need exist (Schoenberg-Whitney) */
template <int Dim>
NurbsCurve<Dim>
interpolateCurve(const PointSequence<Dim>& points,
                 const std::vector<double>& parameters,
                 const KnotVector& knots);

/** \brief Curve through points with parameters and knots chosen from them.
 * \throws std::invalid_argument for fewer than degree + 1 points, or neighbours that
 * coincide (unless the parameterization is uniform) */
template <int Dim>
NurbsCurve<Dim>
interpolateCurve(const PointSequence<Dim>& points,
                 int degree,
                 Parameterization parameterization = Parameterization::ChordLength);

/** \brief Curve with the least sum of weighted squared distances to points at given
 * parameters (section 9.4.1, algorithm A9.6 without its derivatives).
 * \param[in] points one column each
 * \param[in] parameters one per point, non-decreasing, in the domain of \a knots
 * \param[in] knots clamped, and the first and last parameter its ends, if ends are
 * fixed
 * \param[in] options weights and what is fixed
 * \throws std::invalid_argument if that does not hold
 * \throws std::domain_error if the points do not determine every control point */
template <int Dim>
NurbsCurve<Dim>
approximateCurve(const PointSequence<Dim>& points,
                 const std::vector<double>& parameters,
                 const KnotVector& knots,
                 const CurveFitOptions& options = {});

/** \brief Least-squares curve with parameters and knots chosen from the points.
 * \throws std::invalid_argument unless degree < control_points <= number of points, or
 * if neighbours coincide (unless the parameterization is uniform) */
template <int Dim>
NurbsCurve<Dim>
approximateCurve(const PointSequence<Dim>& points,
                 int degree,
                 int control_points,
                 Parameterization parameterization = Parameterization::ChordLength);

/** \brief Surface through a grid of points at given parameters (algorithm A9.4).
 * \param[in] grid points
 * \param[in] parameters_u count_u parameters, conditions as for interpolateCurve()
 * \param[in] parameters_v count_v parameters
 * \param[in] knots_u count_u control points
 * \param[in] knots_v count_v control points
 * \throws std::invalid_argument, std::domain_error as interpolateCurve() */
PCL_NURBS_SURFACE_EXPORT NurbsSurface
interpolateSurface(const PointGrid& grid,
                   const std::vector<double>& parameters_u,
                   const std::vector<double>& parameters_v,
                   const KnotVector& knots_u,
                   const KnotVector& knots_v);

/** \brief Surface through a grid of points with parameters and knots chosen from them.
 */
PCL_NURBS_SURFACE_EXPORT NurbsSurface
interpolateSurface(const PointGrid& grid,
                   int degree_u,
                   int degree_v,
                   Parameterization parameterization = Parameterization::ChordLength);

/** \brief Least-squares surface of a grid of points at given parameters. The grid makes
 * the problem separable: lines in u, then their control points in v (algorithm A9.7).
 * \param[in] grid points
 * \param[in] parameters_u count_u parameters, conditions as for approximateCurve()
 * \param[in] parameters_v count_v parameters
 * \param[in] knots_u knots of the first direction
 * \param[in] knots_v knots of the second direction
 * \param[in] fix_ends run exactly through the four corners, each border being fitted to
 *            the border points alone; otherwise the exact least-squares surface
 * \throws std::invalid_argument, std::domain_error as approximateCurve() */
PCL_NURBS_SURFACE_EXPORT NurbsSurface
approximateSurface(const PointGrid& grid,
                   const std::vector<double>& parameters_u,
                   const std::vector<double>& parameters_v,
                   const KnotVector& knots_u,
                   const KnotVector& knots_v,
                   bool fix_ends = true);

} // namespace nurbs
} // namespace pcl
