// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

#include "banded_least_squares.h"

#include <Eigen/Jacobi>

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>

namespace pcl {
namespace nurbs {
namespace detail {

BandedLeastSquares::BandedLeastSquares(Eigen::Index unknowns,
                                       Eigen::Index bandwidth,
                                       Eigen::Index right_sides)
    : band_(Eigen::MatrixXd::Zero(bandwidth, unknowns)),
      right_(Eigen::MatrixXd::Zero(right_sides, unknowns))
{
}

void
BandedLeastSquares::add(Eigen::Index first,
                        Eigen::VectorXd coefficients,
                        Eigen::VectorXd value)
{
  coefficients.conservativeResizeLike(Eigen::VectorXd::Zero(band_.rows()));
  for (Eigen::Index j = first; j < band_.cols() && !coefficients.isZero(0.0); ++j) {
    if (coefficients(0) != 0.0) {
      Eigen::JacobiRotation<double> rotation;
      rotation.makeGivens(band_(0, j), coefficients(0));
      const double c = rotation.c();
      const double s = rotation.s();
      const Eigen::VectorXd row = band_.col(j);
      band_.col(j) = c * row - s * coefficients;
      coefficients = s * row + c * coefficients;
      const Eigen::VectorXd right = right_.col(j);
      right_.col(j) = c * right - s * value;
      value = s * right + c * value;
    }
    coefficients.head(band_.rows() - 1) = coefficients.tail(band_.rows() - 1).eval();
    coefficients.tail<1>().setZero();
  }
}

Eigen::MatrixXd
BandedLeastSquares::solve() const
{
  // Rank is judged against rounding, not against how even the data are spread.
  const double smallest = 1e-13 * band_.cwiseAbs().maxCoeff();
  Eigen::MatrixXd x = right_;
  for (Eigen::Index j = x.cols() - 1; j >= 0; --j) {
    if (!(std::abs(band_(0, j)) > smallest))
      throw std::domain_error("least squares: the data do not determine coefficient " +
                              std::to_string(j));
    const Eigen::Index reach = std::min(band_.rows(), x.cols() - j);
    for (Eigen::Index k = 1; k < reach; ++k)
      x.col(j) -= band_(k, j) * x.col(j + k);
    x.col(j) /= band_(0, j);
  }
  return x;
}

} // namespace detail
} // namespace nurbs
} // namespace pcl
