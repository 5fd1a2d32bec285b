// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

#pragma once

#include <pcl/surface/nurbs/knot_vector.h>

#include <Eigen/Core>

#include <vector>

namespace pcl {
namespace nurbs {

/** \brief The polynomial pieces of a B-spline basis: one cell per non-empty knot span.
 *
 * In a cell the parameter is mapped to x in [-1, 1] and each of the p + 1 basis
 * functions is a combination of the Chebyshev polynomials T_0(x)..T_p(x).
 */
class KnotCells {
public:
  explicit KnotCells(const KnotVector& knots);

  int
  count() const
  {
    return static_cast<int>(first_control_.size());
  }

  int
  degree() const
  {
    return degree_;
  }

  int
  numControlPoints() const
  {
    return num_control_points_;
  }

  double
  begin(int cell) const
  {
    return breaks_[static_cast<std::size_t>(cell)];
  }

  double
  end(int cell) const
  {
    return breaks_[static_cast<std::size_t>(cell) + 1];
  }

  /** \brief Cell that holds \a u; the first or last one outside of the domain. */
  int
  locate(double u) const;

  /** \brief \a u relative to a cell: -1 at its begin, 1 at its end. */
  double
  local(int cell, double u) const
  {
    return (2.0 * u - begin(cell) - end(cell)) / (end(cell) - begin(cell));
  }

  /** \brief Index of the first control point that acts on a cell. */
  int
  firstControl(int cell) const
  {
    return first_control_[static_cast<std::size_t>(cell)];
  }

  /** \brief Row r holds the Chebyshev coefficients of basis function
   * firstControl(cell) + r on the cell. */
  const Eigen::MatrixXd&
  chebyshev(int cell) const
  {
    return chebyshev_[static_cast<std::size_t>(cell)];
  }

private:
  void
  fillBuckets();

  int degree_;
  int num_control_points_;
  std::vector<double> breaks_;
  std::vector<int> first_control_;
  double buckets_per_length_ = 0.0;
  std::vector<int> bucket_; // equal parts of the domain: the cell each begins in
  std::vector<Eigen::MatrixXd> chebyshev_;
};

} // namespace nurbs
} // namespace pcl
