// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

#pragma once

#include <pcl/surface/nurbs/knot_vector.h>

#include <Eigen/Core>
#include <Eigen/Geometry>

#include <vector>

namespace pcl {
namespace nurbs {

/** \brief A rational B-spline curve in the plane (\a Dim = 2, trimming curves) or in
 * space (\a Dim = 3).
 *
 * Control points are held in homogeneous form (w P, w), one column each. All const
 * members are safe to call from several threads.
 * \ingroup surface
 */
template <int Dim>
class NurbsCurve {
public:
  using Point = Eigen::Matrix<double, Dim, 1>;
  using Points = Eigen::Matrix<double, Dim, Eigen::Dynamic>;
  using HomogeneousPoint = Eigen::Matrix<double, Dim + 1, 1>;
  using HomogeneousPoints = Eigen::Matrix<double, Dim + 1, Eigen::Dynamic>;

  /** \brief The segment from the origin to the first unit vector. */
  NurbsCurve();

  /** \brief Take over knots and homogeneous control points.
   * \throws std::invalid_argument if the counts do not match, a value is not finite or
   * a weight is not positive */
  NurbsCurve(KnotVector knots, HomogeneousPoints homogeneous_points);

  /** \brief Curve from Cartesian control points; no weights mean all are 1. */
  static NurbsCurve
  fromControlPoints(KnotVector knots,
                    const Points& points,
                    const Eigen::VectorXd& weights = Eigen::VectorXd());

  const KnotVector&
  knots() const
  {
    return knots_;
  }

  int
  degree() const
  {
    return knots_.degree();
  }

  int
  numControlPoints() const
  {
    return knots_.numControlPoints();
  }

  const HomogeneousPoints&
  homogeneousPoints() const
  {
    return points_;
  }

  Point
  controlPoint(int i) const
  {
    return points_.col(i).template head<Dim>() / points_(Dim, i);
  }

  double
  weight(int i) const
  {
    return points_(Dim, i);
  }

  /** \brief Whether the weights are not all equal. */
  bool
  isRational() const;

  /** \brief Point at parameter \a u (algorithm A4.1). Outside of the domain the end
   * span is extrapolated. */
  Point
  evaluate(double u) const;

  /** \brief Point and derivatives 0..order (algorithm A4.2); element k is the k-th. */
  std::vector<Point>
  derivatives(double u, int order) const;

  /** \brief The same curve under an affine map (exact, equation 4.2 and section 3.1).
   */
  NurbsCurve
  transformed(const Eigen::Transform<double, Dim, Eigen::Affine>& transform) const;

  /** \brief The same curve traversed backwards, domain unchanged. */
  NurbsCurve
  reversed() const;

private:
  KnotVector knots_;
  HomogeneousPoints points_;
};

using NurbsCurve2 = NurbsCurve<2>;
using NurbsCurve3 = NurbsCurve<3>;

extern template class PCL_NURBS_SURFACE_EXPORT NurbsCurve<2>;
extern template class PCL_NURBS_SURFACE_EXPORT NurbsCurve<3>;

} // namespace nurbs
} // namespace pcl
