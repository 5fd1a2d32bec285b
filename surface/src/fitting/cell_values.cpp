// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

#include "cell_values.h"

#include <array>

namespace pcl {
namespace nurbs {
namespace {

using ChebyshevValues = std::array<double, kMaxDegree + 1>;

/** T_0(x)..T_degree(x), degree >= 1. */
void
chebyshevValues(int degree, double x, ChebyshevValues& values)
{
  values[0] = 1.0;
  values[1] = x;
  for (std::size_t k = 2; k <= static_cast<std::size_t>(degree); ++k)
    values[k] = 2.0 * x * values[k - 1] - values[k - 2];
}

/** Sum of polynomial(j, i) T_i(s) T_j(t). */
double
chebyshevSum(const Eigen::MatrixXd& polynomial,
             const ChebyshevValues& u,
             const ChebyshevValues& v)
{
  double sum = 0.0;
  const double* coefficient = polynomial.data();
  for (std::size_t i = 0; i < static_cast<std::size_t>(polynomial.cols()); ++i) {
    double row = 0.0;
    for (std::size_t j = 0; j < static_cast<std::size_t>(polynomial.rows()); ++j)
      row += *coefficient++ * v[j];
    sum += row * u[i];
  }
  return sum;
}

/** Chebyshev coefficients of one spline on a cell, the direction of v along columns. */
Eigen::MatrixXd
cellPolynomial(const CellPoints& points,
               int cell,
               const Eigen::Ref<const Eigen::VectorXd>& coefficients)
{
  const int b = points.cells_v.count();
  const Eigen::Index n_v = points.cells_v.numControlPoints();
  const Eigen::Index first = points.cells_u.firstControl(cell / b) * n_v +
                             points.cells_v.firstControl(cell % b);
  const Eigen::Map<const Eigen::MatrixXd, 0, Eigen::OuterStride<>> net(
      coefficients.data() + first,
      points.cells_v.degree() + 1,
      points.cells_u.degree() + 1,
      Eigen::OuterStride<>(n_v));
  const Eigen::MatrixXd half =
      points.cells_v.chebyshev(cell % b).transpose().lazyProduct(net);
  return half.lazyProduct(points.cells_u.chebyshev(cell / b));
}

} // namespace

Eigen::MatrixXd
evaluateCells(const CellPoints& points, const Eigen::MatrixXd& coefficients)
{
  Eigen::MatrixXd result(static_cast<Eigen::Index>(points.order.size()),
                         coefficients.cols());
  ChebyshevValues u;
  ChebyshevValues v;
  for (int cell = 0; cell < points.numCells(); ++cell) {
    const auto begin =
        static_cast<std::size_t>(points.begin[static_cast<std::size_t>(cell)]);
    const auto end =
        static_cast<std::size_t>(points.begin[static_cast<std::size_t>(cell) + 1]);
    if (begin == end)
      continue;
    for (Eigen::Index column = 0; column < coefficients.cols(); ++column) {
      const Eigen::MatrixXd polynomial =
          cellPolynomial(points, cell, coefficients.col(column));
      for (std::size_t at = begin; at < end; ++at) {
        chebyshevValues(points.cells_u.degree(), points.s[at], u);
        chebyshevValues(points.cells_v.degree(), points.t[at], v);
        result(points.order[at], column) = chebyshevSum(polynomial, u, v);
      }
    }
  }
  return result;
}

} // namespace nurbs
} // namespace pcl
