// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

#pragma once

#include "knot_cells.h"

#include <Eigen/Core>

#include <vector>

namespace pcl {
namespace nurbs {

/** \brief Parameters of points, sorted by the knot cell that holds them.
 *
 * Cell (a, b) has the number a * cells_v.count() + b. Within a cell points keep their
 * order, so sums over a cell do not depend on the number of threads.
 */
struct CellPoints {
  KnotCells cells_u;
  KnotCells cells_v;
  std::vector<int> begin; /**< first position of each cell; one more than cells */
  std::vector<int> order; /**< index of the point at each position */
  std::vector<double> s;  /**< local parameter in u at each position */
  std::vector<double> t;  /**< local parameter in v at each position */

  CellPoints(const KnotVector& knots_u,
             const KnotVector& knots_v,
             const Eigen::Matrix2Xd& parameters);

  int
  numCells() const
  {
    return cells_u.count() * cells_v.count();
  }

  int
  numControlPoints() const
  {
    return cells_u.numControlPoints() * cells_v.numControlPoints();
  }

  /** \brief Control points that act on a cell, (p + 1)(q + 1) of them, v fastest. */
  std::vector<int>
  controls(int cell) const;
};

/** \brief Rows of a least-squares problem, one per point, in the order of the cells.
 *
 * Point n says: sum over channels a and control points i of m_a B_i x_{i,a} = target_k,
 * with weight w; k counts the right-hand sides. A point's row is a tensor product, so
 * w m_a m_b and w m_a target_k are all that is needed.
 */
struct PointRows {
  int channels = 1; /**< unknowns per control point */
  int right_hand_sides = 1;
  Eigen::MatrixXd gram; /**< points x channels (channels + 1) / 2: w m_a m_b, a <= b */
  Eigen::MatrixXd moments; /**< points x channels * right_hand_sides: w m_a target_k */
  Eigen::MatrixXd squares; /**< points x right_hand_sides: w target_k^2, or the cost */
};

/** \brief What the points of one cell say about its control points: the quadratic
 * x' gram x - 2 rhs' x + constant. Unknown (i, a) is i * channels + a. */
struct CellEquations {
  Eigen::MatrixXd gram;
  Eigen::MatrixXd rhs;
  Eigen::VectorXd constant;
};

/** \brief Reduce the points of every cell, exactly. O(points) + O(cells (pq)^3).
 * \param[in] points sorted parameters
 * \param[in] rows what each point says
 * \param[in] threads number of threads; the result does not depend on it */
std::vector<CellEquations>
reduceCells(const CellPoints& points, const PointRows& rows, int threads);

/** \brief The quadratic of a cell as residuals: |R x - d_k|^2 + rest_k. */
struct TriangularCell {
  Eigen::MatrixXd R;
  Eigen::MatrixXd d;
  Eigen::VectorXd rest;
};

/** \brief Pivoted Cholesky factor of a cell; rows without information are dropped. */
TriangularCell
factorizeCell(const CellEquations& cell);

} // namespace nurbs
} // namespace pcl
