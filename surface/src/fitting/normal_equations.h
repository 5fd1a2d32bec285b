// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

#pragma once

#include "band_cholesky.h"
#include "cell_equations.h"

#include <Eigen/Core>

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
   * \return false if the equations do not determine the unknowns; the unknowns then are
   *         as before */
  bool
  solve(const std::vector<bool>& fixed, Eigen::MatrixXd& unknowns) const;

private:
  /** Position of a control point: the shorter side of the net runs fastest, which makes
   * the band narrow. */
  Eigen::Index
  position(Eigen::Index control) const
  {
    return u_fastest_ ? control % n_v_ * n_u_ + control / n_v_ : control;
  }

  static void
  fix(Eigen::Index at, BandMatrix& gram, Eigen::MatrixXd& rhs);

  Eigen::Index n_u_;
  Eigen::Index n_v_;
  bool u_fastest_;
  BandMatrix gram_;
  Eigen::MatrixXd rhs_;
};

} // namespace nurbs
} // namespace pcl
