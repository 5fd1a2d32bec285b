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
namespace {

/** Homogeneous point and partial derivatives, named like SurfaceJet2. */
struct HomogeneousJet {
  Eigen::Vector4d value = Eigen::Vector4d::Zero();
  Eigen::Vector4d du = Eigen::Vector4d::Zero();
  Eigen::Vector4d dv = Eigen::Vector4d::Zero();
  Eigen::Vector4d duu = Eigen::Vector4d::Zero();
  Eigen::Vector4d duv = Eigen::Vector4d::Zero();
  Eigen::Vector4d dvv = Eigen::Vector4d::Zero();
};

/** Tensor-product sum with derivatives up to \a Order (0, 1 or 2) in each direction. */
template <int Order>
void
sumJet(const NurbsSurface& surface,
       int span_u,
       int span_v,
       const BasisDerivatives& basis_u,
       const BasisDerivatives& basis_v,
       HomogeneousJet& jet)
{
  const int p = surface.knotsU().degree();
  const int q = surface.knotsV().degree();
  const int stride = surface.numControlPointsV();
  for (int i = 0; i <= p; ++i) {
    const double* column =
        surface.homogeneousPoints().data() +
        4 * (static_cast<std::ptrdiff_t>(span_u - p + i) * stride + (span_v - q));
    Eigen::Vector4d row = Eigen::Vector4d::Zero();
    Eigen::Vector4d row_v = Eigen::Vector4d::Zero();
    Eigen::Vector4d row_vv = Eigen::Vector4d::Zero();
    for (int j = 0; j <= q; ++j, column += 4) {
      const Eigen::Map<const Eigen::Vector4d> point(column);
      row += basis_v[0][j] * point;
      if constexpr (Order >= 1)
        row_v += basis_v[1][j] * point;
      if constexpr (Order >= 2)
        row_vv += basis_v[2][j] * point;
    }
    jet.value += basis_u[0][i] * row;
    if constexpr (Order >= 1) {
      jet.du += basis_u[1][i] * row;
      jet.dv += basis_u[0][i] * row_v;
    }
    if constexpr (Order >= 2) {
      jet.duu += basis_u[2][i] * row;
      jet.duv += basis_u[1][i] * row_v;
      jet.dvv += basis_u[0][i] * row_vv;
    }
  }
}

/** Values and first derivatives of a basis without the general triangle of A2.3: the
 * derivative row is a difference of the values one degree below (equation 2.7). */
void
evaluateBasisAndSlope(const KnotVector& knots,
                      int span,
                      double u,
                      BasisDerivatives& basis)
{
  const int p = knots.degree();
  const double* knot = knots.values().data() + span;
  BasisValues& values = basis[0];
  BasisValues& slopes = basis[1];
  values[0] = 1.0;
  for (int d = 1; d <= p; ++d) {
    double saved = 0.0;
    double saved_slope = 0.0;
    for (int r = 0; r < d; ++r) {
      const double ratio = values[r] / (knot[r + 1] - knot[1 - d + r]);
      if (d == p) {
        slopes[r] = saved_slope - p * ratio;
        saved_slope = p * ratio;
      }
      values[r] = saved + (knot[r + 1] - u) * ratio;
      saved = (u - knot[1 - d + r]) * ratio;
    }
    values[d] = saved;
    if (d == p)
      slopes[d] = saved_slope;
  }
}

} // namespace

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
  if (!points_.allFinite())
    throw std::invalid_argument("NurbsSurface: a control point is not finite");
  if (!(points_.row(3).minCoeff() > 0.0))
    throw std::invalid_argument("NurbsSurface: a weight is not positive");
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

bool
NurbsSurface::isRational() const
{
  return (points_.row(3).array() != points_(3, 0)).any();
}

Eigen::Vector3d
NurbsSurface::evaluate(double u, double v) const
{
  const int span_u = knots_u_.findSpan(u);
  const int span_v = knots_v_.findSpan(v);
  BasisDerivatives basis_u;
  BasisDerivatives basis_v;
  knots_u_.evaluateBasis(span_u, u, basis_u[0]);
  knots_v_.evaluateBasis(span_v, v, basis_v[0]);
  HomogeneousJet jet;
  sumJet<0>(*this, span_u, span_v, basis_u, basis_v, jet);
  return jet.value.head<3>() / jet.value(3);
}

SurfaceJet1
NurbsSurface::evaluateJet1(double u, double v) const
{
  const int span_u = knots_u_.findSpan(u);
  const int span_v = knots_v_.findSpan(v);
  BasisDerivatives basis_u;
  BasisDerivatives basis_v;
  evaluateBasisAndSlope(knots_u_, span_u, u, basis_u);
  evaluateBasisAndSlope(knots_v_, span_v, v, basis_v);
  HomogeneousJet jet;
  sumJet<1>(*this, span_u, span_v, basis_u, basis_v, jet);
  const double scale = 1.0 / jet.value(3);
  SurfaceJet1 result;
  result.position = scale * jet.value.head<3>();
  result.du = scale * (jet.du.head<3>() - jet.du(3) * result.position);
  result.dv = scale * (jet.dv.head<3>() - jet.dv(3) * result.position);
  return result;
}

SurfaceJet2
NurbsSurface::evaluateJet2(double u, double v) const
{
  const int span_u = knots_u_.findSpan(u);
  const int span_v = knots_v_.findSpan(v);
  BasisDerivatives basis_u;
  BasisDerivatives basis_v;
  knots_u_.evaluateBasisDerivatives(span_u, u, 2, basis_u);
  knots_v_.evaluateBasisDerivatives(span_v, v, 2, basis_v);
  HomogeneousJet h;
  sumJet<2>(*this, span_u, span_v, basis_u, basis_v, h);
  const double scale = 1.0 / h.value(3);
  SurfaceJet2 s; // quotient rule, equation 4.20
  s.position = scale * h.value.head<3>();
  s.du = scale * (h.du.head<3>() - h.du(3) * s.position);
  s.dv = scale * (h.dv.head<3>() - h.dv(3) * s.position);
  s.duu = scale * (h.duu.head<3>() - 2.0 * h.du(3) * s.du - h.duu(3) * s.position);
  s.dvv = scale * (h.dvv.head<3>() - 2.0 * h.dv(3) * s.dv - h.dvv(3) * s.position);
  s.duv = scale *
          (h.duv.head<3>() - h.du(3) * s.dv - h.dv(3) * s.du - h.duv(3) * s.position);
  return s;
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
