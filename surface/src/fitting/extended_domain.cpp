// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

#include "orthogonal_problem.h"

#include <Eigen/LU>

#include <algorithm>
#include <stdexcept>
#include <utility>
#include <vector>

namespace pcl {
namespace nurbs {
namespace {

/** Knots of the same spline over a wider domain, and the matrix that takes its
 * coefficients there: both splines agree at the Greville points of the new knots. */
std::pair<KnotVector, Eigen::MatrixXd>
extendKnots(const KnotVector& knots, double low, double high)
{
  const int p = knots.degree();
  std::vector<double> values = knots.values();
  std::fill(values.begin(), values.begin() + p + 1, std::min(low, knots.domainMin()));
  std::fill(values.end() - p - 1, values.end(), std::max(high, knots.domainMax()));
  KnotVector wider(p, std::move(values));
  const int n = knots.numControlPoints();
  const auto collocation = [&](const KnotVector& basis_knots, bool extrapolate) {
    Eigen::MatrixXd matrix = Eigen::MatrixXd::Zero(n, n);
    for (int row = 0; row < n; ++row) {
      const double u = wider.greville(row);
      const int span = extrapolate ? knots.findSpan(u) : basis_knots.findSpan(u);
      BasisValues basis;
      basis_knots.evaluateBasis(span, u, basis);
      for (int r = 0; r <= p; ++r)
        matrix(row, span - p + r) = basis[static_cast<std::size_t>(r)];
    }
    return matrix;
  };
  return {wider,
          collocation(wider, false).partialPivLu().solve(collocation(knots, true))};
}

} // namespace

NurbsSurface
extendedDomain(const NurbsSurface& surface, const Eigen::Matrix2Xd& parameters)
{
  const Eigen::Vector2d low = parameters.rowwise().minCoeff();
  const Eigen::Vector2d high = parameters.rowwise().maxCoeff();
  const auto [knots_u, matrix_u] = extendKnots(surface.knotsU(), low.x(), high.x());
  const auto [knots_v, matrix_v] = extendKnots(surface.knotsV(), low.y(), high.y());
  const int n_v = surface.numControlPointsV();
  NurbsSurface::HomogeneousPoints points(4, surface.numControlPoints());
  for (int row = 0; row < 4; ++row) {
    Eigen::MatrixXd net(surface.numControlPointsU(), n_v);
    for (int k = 0; k < surface.numControlPoints(); ++k)
      net(k / n_v, k % n_v) = surface.homogeneousPoints()(row, k);
    net = matrix_u * net * matrix_v.transpose();
    for (int k = 0; k < surface.numControlPoints(); ++k)
      points(row, k) = net(k / n_v, k % n_v);
  }
  if (!(points.row(3).minCoeff() > 0.0))
    throw std::domain_error("surface fit: a weight is not positive");
  return {knots_u, knots_v, std::move(points)};
}

} // namespace nurbs
} // namespace pcl
