// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

#include <pcl/surface/nurbs/nurbs_surface.h>

#include "rational_derivatives.h"

#include <algorithm>
#include <stdexcept>
#include <string>
#include <utility>

namespace pcl {
namespace nurbs {

NurbsSurface::NurbsSurface() : points_(4, 4)
{
  points_ << 0, 0, 1, 1, //
      0, 1, 0, 1,        //
      0, 0, 0, 0,        //
      1, 1, 1, 1;
}

NurbsSurface::NurbsSurface(KnotVector knots_u,
                           KnotVector knots_v,
                           HomogeneousPoints homogeneous_points)
    : knots_u_(std::move(knots_u)),
      knots_v_(std::move(knots_v)),
      points_(std::move(homogeneous_points))
{
  const auto needed = static_cast<Eigen::Index>(knots_u_.numControlPoints()) *
                      knots_v_.numControlPoints();
  if (points_.cols() != needed)
    throw std::invalid_argument("NurbsSurface: " + std::to_string(points_.cols()) +
                                " control points for knots that need " +
                                std::to_string(needed));
  Eigen::Array4d zero = Eigen::Array4d::Zero(); // NaN unless all are finite
  double least = points_(3, 0);
  double largest = points_(3, 0);
  for (const auto point : points_.colwise()) {
    zero += 0.0 * point.array();
    least = std::min(least, point(3));
    largest = std::max(largest, point(3));
  }
  if (!(zero == 0.0).all())
    throw std::invalid_argument("NurbsSurface: a control point is not finite");
  if (!(least > 0.0))
    throw std::invalid_argument("NurbsSurface: a weight is not positive");
  rational_ = least != largest;
}

NurbsSurface
NurbsSurface::fromControlPoints(KnotVector knots_u,
                                KnotVector knots_v,
                                const Eigen::Matrix3Xd& points,
                                const Eigen::VectorXd& weights)
{
  if (weights.size() != 0 && weights.size() != points.cols())
    throw std::invalid_argument("NurbsSurface: one weight per control point is needed");
  HomogeneousPoints homogeneous = points.colwise().homogeneous();
  if (weights.size() != 0)
    homogeneous = homogeneous * weights.asDiagonal();
  return {std::move(knots_u), std::move(knots_v), std::move(homogeneous)};
}

SurfaceDerivatives
NurbsSurface::derivatives(double u, double v, int order) const
{
  const int p = knots_u_.degree();
  const int q = knots_v_.degree();
  const int span_u = knots_u_.findSpan(u);
  const int span_v = knots_v_.findSpan(v);
  BasisDerivatives basis_u;
  BasisDerivatives basis_v;
  knots_u_.evaluateBasisDerivatives(span_u, u, order, basis_u);
  knots_v_.evaluateBasisDerivatives(span_v, v, order, basis_v);
  const auto homogeneous = [&](int k, int l) {
    Eigen::Vector4d sum = Eigen::Vector4d::Zero();
    for (int i = 0; i <= p; ++i)
      for (int j = 0; j <= q; ++j)
        sum += basis_u[k][i] * basis_v[l][j] *
               points_.col((span_u - p + i) * numControlPointsV() + span_v - q + j);
    return sum;
  };
  Eigen::MatrixXd weights(order + 1, order + 1);
  SurfaceDerivatives result(order);
  for (int k = 0; k <= order; ++k)
    for (int l = 0; l <= order; ++l) {
      result(k, l).setZero();
      if (k + l > order)
        continue;
      const Eigen::Vector4d a = homogeneous(k, l);
      weights(k, l) = a(3);
      Eigen::Vector3d value = a.head<3>();
      for (int i = 0; i <= k; ++i)
        for (int j = i == 0 ? 1 : 0; j <= l; ++j)
          value -=
              binomial(k, i) * binomial(l, j) * weights(i, j) * result(k - i, l - j);
      result(k, l) = value / weights(0, 0);
    }
  return result;
}

NurbsCurve3
NurbsSurface::isoCurve(Direction fixed, double parameter) const
{
  const KnotVector& along = fixed == Direction::U ? knots_v_ : knots_u_;
  const KnotVector& across = knots(fixed);
  const int span = across.findSpan(parameter);
  BasisValues basis;
  across.evaluateBasis(span, parameter, basis);
  NurbsCurve3::HomogeneousPoints points =
      NurbsCurve3::HomogeneousPoints::Zero(4, along.numControlPoints());
  for (int k = 0; k < along.numControlPoints(); ++k)
    for (int r = 0; r <= across.degree(); ++r) {
      const int a = span - across.degree() + r;
      const int column = fixed == Direction::U ? a * numControlPointsV() + k
                                               : k * numControlPointsV() + a;
      points.col(k) += basis[r] * points_.col(column);
    }
  return {along, std::move(points)};
}

NurbsSurface
NurbsSurface::transformed(const Eigen::Affine3d& transform) const
{
  return {knots_u_, knots_v_, HomogeneousPoints(transform.matrix() * points_)};
}

NurbsSurface
NurbsSurface::transposed() const
{
  HomogeneousPoints points(4, points_.cols());
  for (int i = 0; i < numControlPointsU(); ++i)
    for (int j = 0; j < numControlPointsV(); ++j)
      points.col(j * numControlPointsU() + i) =
          points_.col(i * numControlPointsV() + j);
  return {knots_v_, knots_u_, std::move(points)};
}

NurbsSurface
NurbsSurface::reversed(Direction direction) const
{
  const int n_u = numControlPointsU();
  const int n_v = numControlPointsV();
  HomogeneousPoints points(4, points_.cols());
  for (int i = 0; i < n_u; ++i)
    for (int j = 0; j < n_v; ++j)
      points.col(direction == Direction::U ? (n_u - 1 - i) * n_v + j
                                           : i * n_v + n_v - 1 - j) =
          points_.col(i * n_v + j);
  if (direction == Direction::U)
    return {knots_u_.reversed(), knots_v_, std::move(points)};
  return {knots_u_, knots_v_.reversed(), std::move(points)};
}

} // namespace nurbs
} // namespace pcl
