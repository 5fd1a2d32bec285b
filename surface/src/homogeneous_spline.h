// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

#pragma once

#include <pcl/surface/nurbs/knot_vector.h>

#include <Eigen/Core>

#include <utility>
#include <vector>

namespace pcl {
namespace nurbs {
namespace detail {

/** \brief Knots with one column of coefficients per control point.
 *
 * A column stacks one or more homogeneous points of \a point_rows rows each (weight
 * last): a curve has one per column, a surface one per control point across the
 * direction it is worked on. So curves and both directions of surfaces share every
 * algorithm below. */
struct HomogeneousSpline {
  KnotVector knots;
  Eigen::MatrixXd points;
  int point_rows;
};

/** \brief What a lossy operation did, and how far it moved the geometry at most. */
struct SimplifiedSpline {
  HomogeneousSpline spline;
  int steps;
  double max_error;
};

/** \brief Insert sorted knots of the domain (algorithm A5.4); no knot may end with
 * more than degree + 1 copies. Each new point is a convex combination of old ones. */
HomogeneousSpline
refined(const HomogeneousSpline& spline, const std::vector<double>& added);

/** \brief Both sides of an inner parameter; the cut ends are clamped. */
std::pair<HomogeneousSpline, HomogeneousSpline>
splitAt(const HomogeneousSpline& spline, double u);

/** \brief The part over [first, last] with clamped ends. */
HomogeneousSpline
restricted(const HomogeneousSpline& spline, double first, double last);

/** \brief Clamped single-span pieces, one per non-empty span. */
std::vector<HomogeneousSpline>
bezierPieces(const HomogeneousSpline& spline);

/** \brief Put \a right behind \a left; both are clamped at the common knot.
 * \param[in] left spline whose domain ends at the common knot
 * \param[in] right spline of the same degree whose domain starts there
 * \param[in] shares_point keep only left's copy of the point at the joint */
HomogeneousSpline
concatenated(const HomogeneousSpline& left,
             const HomogeneousSpline& right,
             bool shares_point);

/** \brief Raise the degree by one; every distinct knot gets one more copy, so that
 * continuity stays. */
HomogeneousSpline
elevated(const HomogeneousSpline& spline);

/** \brief Lower the degree by one if that moves the geometry by no more than
 * \a tolerance. */
SimplifiedSpline
reduced(const HomogeneousSpline& spline, double tolerance);

/** \brief Remove up to \a times copies of the inner knot \a u. */
SimplifiedSpline
withoutKnot(const HomogeneousSpline& spline, double u, int times, double tolerance);

/** \brief Remove inner knots, cheapest first, as long as \a tolerance allows. */
SimplifiedSpline
withoutRedundantKnots(const HomogeneousSpline& spline, double tolerance);

/** \brief Bound of the distance between two rational splines over the same basis.
 *
 * With defects (dA, dw) the curves differ by (dA - C dw) / w, C being the old curve;
 * so |dA - c dw| + r |dw| over the least weight bounds the distance for any ball
 * (c, r) that holds C. Unlike equation 5.30 this does not depend on where the origin
 * is.
 * \param[in] defects difference of the control columns
 * \param[in] old_points control columns whose hull holds the old curve
 * \param[in] least_weight least weight of the new curve
 * \param[in] point_rows rows of one homogeneous point
 * \return the bound, infinity if the least weight is not positive */
double
deviationBound(const Eigen::Ref<const Eigen::MatrixXd>& defects,
               const Eigen::Ref<const Eigen::MatrixXd>& old_points,
               double least_weight,
               int point_rows);

/** \brief Least weight among control columns. */
double
leastWeight(const Eigen::Ref<const Eigen::MatrixXd>& points, int point_rows);

} // namespace detail
} // namespace nurbs
} // namespace pcl
