// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

#pragma once

#include "cell_equations.h"

#include <Eigen/Core>
#include <Eigen/SparseCore>

#include <vector>

namespace pcl {
namespace nurbs {

/** \brief Sum of the cells' quadratics over one unknown per control point.
 *
 * Used where a linear problem is solved often (each trial of a knot search) or for
 * several right-hand sides at once: they share one factor, which a Ceres problem cannot
 * do.
 */
class NormalEquations {
public:
  NormalEquations(const CellPoints& points, const std::vector<CellEquations>& cells);

  /** \brief Minimiser of the sum of quadratics.
   * \param[in] fixed per control point: whether it keeps its value; empty for none
   * \param[in,out] unknowns (control points) x (right-hand sides); the fixed values on
   *                input
   * \return false if the equations do not determine the unknowns */
  bool
  solve(const std::vector<bool>& fixed, Eigen::MatrixXd& unknowns) const;

  /** \brief Value of the quadratic, one per right-hand side. */
  Eigen::VectorXd
  value(const Eigen::MatrixXd& unknowns) const;

  const Eigen::SparseMatrix<double>&
  gram() const
  {
    return gram_;
  }

private:
  Eigen::SparseMatrix<double> gram_; // both triangles
  Eigen::MatrixXd rhs_;
  Eigen::VectorXd constant_;
};

} // namespace nurbs
} // namespace pcl
