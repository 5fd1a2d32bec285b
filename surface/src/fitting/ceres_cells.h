// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

#pragma once

#include "cell_equations.h"

#include <Eigen/Core>

#include <string>
#include <vector>

namespace pcl {
namespace nurbs {

/** \brief How a Ceres solve went. */
struct CeresReport {
  bool usable = false;    /**< whether the unknowns hold a solution */
  bool converged = false; /**< whether a convergence criterion was met */
  int iterations = 0;
  double initial_cost = 0.0;
  double final_cost = 0.0;
  std::string message; /**< Ceres' own words */
};

/** \brief Limits of a Ceres solve. */
struct CeresLimits {
  int threads = 1;
  int max_iterations = 50;
  double function_tolerance = 1e-8;
  double parameter_tolerance = 1e-10;
  double trust_radius = 1e4;  /**< initial, of a nonlinear problem */
  double negligible_cost = 0; /**< at which a nonlinear problem is solved */
  int dense_unknowns = 100;   /**< most unknowns for a dense factor */
};

/** \brief Least-squares solution of linear cell equations: one residual block per cell
 * and right-hand side.
 * \param[in] points which control points act on each cell
 * \param[in] cells factorised equations of every cell
 * \param[in] fixed per control point: whether it keeps its value; empty for none
 * \param[in] limits threads; the other limits do not matter for a linear problem
 * \param[in,out] unknowns (control points) x (right-hand sides); the start on input */
CeresReport
solveLinearCells(const CellPoints& points,
                 const std::vector<TriangularCell>& cells,
                 const std::vector<bool>& fixed,
                 const CeresLimits& limits,
                 Eigen::MatrixXd& unknowns);

/** \brief A least-squares problem that is linearised anew wherever Ceres looks. */
class CellLinearizer {
public:
  virtual ~CellLinearizer() = default;

  /** \brief Costs at the present unknowns, and with \a derivatives the equations of the
   * next step.
   * \param[in] unknowns channels x control points
   * \param[in] derivatives whether cell.R and cell.d are needed, or only cell.rest
   * \param[out] cells cell.R step = cell.d is the linearised problem of each cell, with
   *             cell.rest so that |d|^2 + rest is the cost of the cell */
  virtual void
  linearize(const Eigen::MatrixXd& unknowns,
            bool derivatives,
            std::vector<TriangularCell>& cells) = 0;
};

/** \brief Minimise the costs of a CellLinearizer by Ceres' Levenberg-Marquardt: exactly
 * the Gauss-Newton system of all points, though Ceres sees only one block per cell. */
CeresReport
solveNonlinearCells(const CellPoints& points,
                    CellLinearizer& linearizer,
                    const std::vector<bool>& fixed,
                    const CeresLimits& limits,
                    Eigen::MatrixXd& unknowns);

} // namespace nurbs
} // namespace pcl
