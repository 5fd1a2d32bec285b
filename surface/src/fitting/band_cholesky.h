// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

#pragma once

#include <Eigen/Core>

namespace pcl {
namespace nurbs {

/** \brief Symmetric positive definite equations with a band of entries around the
 * diagonal, factored in place by Cholesky.
 *
 * Row d of a column j of the storage is entry (j + d, j). Tensor-product splines have
 * such a band as wide as a few rows of the net; without fill outside of it and with
 * columns that are contiguous this is faster than a general sparse factor up to nets of
 * some thousand control points. */
class BandMatrix {
public:
  /** \param[in] size number of unknowns
   * \param[in] width entries below the diagonal */
  BandMatrix(Eigen::Index size, Eigen::Index width)
      : columns_(Eigen::MatrixXd::Zero(width + 1, size))
  {
  }

  Eigen::Index
  size() const
  {
    return columns_.cols();
  }

  Eigen::Index
  width() const
  {
    return columns_.rows() - 1;
  }

  /** \brief Entry of the lower triangle, row - width() <= column <= row. */
  double&
  operator()(Eigen::Index row, Eigen::Index column)
  {
    return columns_(row - column, column);
  }

  double
  operator()(Eigen::Index row, Eigen::Index column) const
  {
    return columns_(row - column, column);
  }

  /** \brief Replace the matrix by its lower Cholesky factor. O(size width^2).
   * \return false, with the matrix undefined, if it is not positive definite */
  bool
  factorize();

  /** \brief Solve L L' x = \a x after factorize(), for every column of \a x. */
  void
  solveInPlace(Eigen::MatrixXd& x) const;

private:
  Eigen::MatrixXd columns_;
};

} // namespace nurbs
} // namespace pcl
