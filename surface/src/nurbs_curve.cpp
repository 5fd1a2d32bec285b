// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

#include <pcl/surface/nurbs/nurbs_curve.h>

#include "rational_derivatives.h"

#include <stdexcept>
#include <string>
#include <utility>

namespace pcl {
namespace nurbs {

template <int Dim>
NurbsCurve<Dim>::NurbsCurve() : points_(Dim + 1, 2)
{
  points_.setZero();
  points_(0, 1) = 1.0;
  points_.row(Dim).setOnes();
}

template <int Dim>
NurbsCurve<Dim>::NurbsCurve(KnotVector knots, HomogeneousPoints homogeneous_points)
    : knots_(std::move(knots)), points_(std::move(homogeneous_points))
{
  if (points_.cols() != knots_.numControlPoints())
    throw std::invalid_argument("NurbsCurve: " + std::to_string(points_.cols()) +
                                " control points for knots that need " +
                                std::to_string(knots_.numControlPoints()));
  if (!points_.allFinite())
    throw std::invalid_argument("NurbsCurve: a control point is not finite");
  if (!(points_.row(Dim).minCoeff() > 0.0))
    throw std::invalid_argument("NurbsCurve: a weight is not positive");
}

template <int Dim>
NurbsCurve<Dim>
NurbsCurve<Dim>::fromControlPoints(KnotVector knots,
                                   const Points& points,
                                   const Eigen::VectorXd& weights)
{
  if (weights.size() != 0 && weights.size() != points.cols())
    throw std::invalid_argument("NurbsCurve: one weight per control point is needed");
  HomogeneousPoints homogeneous = points.colwise().homogeneous();
  if (weights.size() != 0)
    homogeneous = homogeneous * weights.asDiagonal();
  return {std::move(knots), std::move(homogeneous)};
}

template <int Dim>
bool
NurbsCurve<Dim>::isRational() const
{
  return (points_.row(Dim).array() != points_(Dim, 0)).any();
}

template <int Dim>
typename NurbsCurve<Dim>::Point
NurbsCurve<Dim>::evaluate(double u) const
{
  const int span = knots_.findSpan(u);
  BasisValues basis;
  knots_.evaluateBasis(span, u, basis);
  HomogeneousPoint sum = HomogeneousPoint::Zero();
  for (int r = 0; r <= degree(); ++r)
    sum += basis[r] * points_.col(span - degree() + r);
  return sum.template head<Dim>() / sum(Dim);
}

template <int Dim>
std::vector<typename NurbsCurve<Dim>::Point>
NurbsCurve<Dim>::derivatives(double u, int order) const
{
  const int span = knots_.findSpan(u);
  BasisDerivatives basis;
  knots_.evaluateBasisDerivatives(span, u, order, basis);
  std::vector<HomogeneousPoint> homogeneous(static_cast<std::size_t>(order) + 1);
  for (int k = 0; k <= order; ++k) {
    homogeneous[k].setZero();
    for (int r = 0; r <= degree(); ++r)
      homogeneous[k] += basis[k][r] * points_.col(span - degree() + r);
  }
  return rationalCurveDerivatives<Dim>(homogeneous);
}

template <int Dim>
NurbsCurve<Dim>
NurbsCurve<Dim>::transformed(
    const Eigen::Transform<double, Dim, Eigen::Affine>& transform) const
{
  return {knots_, HomogeneousPoints(transform.matrix() * points_)};
}

template <int Dim>
NurbsCurve<Dim>
NurbsCurve<Dim>::reversed() const
{
  return {knots_.reversed(), HomogeneousPoints(points_.rowwise().reverse())};
}

template class NurbsCurve<2>;
template class NurbsCurve<3>;

} // namespace nurbs
} // namespace pcl
