// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

#pragma once

#include <Eigen/Core>

namespace pcl {
namespace nurbs {
namespace detail {

/** \brief Least squares by Givens rotations for rows with few neighbouring
 * coefficients.
 *
 * Rows are rotated into a banded triangle as they come, so memory does not grow with
 * them and accuracy is that of a QR decomposition. Sorted rows cost
 * O(bandwidth (bandwidth + right sides)) each. */
class BandedLeastSquares {
public:
  /** \brief Empty system.
   * \param[in] unknowns number of unknowns, each a column of the solution
   * \param[in] bandwidth most neighbouring coefficients of one row
   * \param[in] right_sides number of right-hand sides */
  BandedLeastSquares(Eigen::Index unknowns,
                     Eigen::Index bandwidth,
                     Eigen::Index right_sides);

  /** \brief Add the equation sum_k coefficients(k) x_{first + k} = value. */
  void
  add(Eigen::Index first, Eigen::VectorXd coefficients, Eigen::VectorXd value);

  /** \brief The solution, one column per unknown.
   * \throws std::domain_error if the rows do not determine an unknown */
  Eigen::MatrixXd
  solve() const;

private:
  Eigen::MatrixXd band_;  // (k, j) holds R(j, j + k)
  Eigen::MatrixXd right_; // column j belongs to row j of R
};

} // namespace detail
} // namespace nurbs
} // namespace pcl
