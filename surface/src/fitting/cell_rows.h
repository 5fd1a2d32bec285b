// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

#pragma once

#include "cell_equations.h"

#include <Eigen/Core>

#include <vector>

namespace pcl {
namespace nurbs {

/** \brief Rows of a least-squares problem, several per point, as they are: row r of
 * point n says that the sum over channels a and control points i of
 * factors(a, r) B_i x_{i,a} = target(r). */
struct PlainRows {
  int per_point = 1;
  Eigen::MatrixXd
      factors; /**< channels x (per_point * points), points in their order */
  Eigen::VectorXd targets; /**< per_point * points */
};

/** \brief Reduce the rows of every cell by orthogonal transformations.
 *
 * Unlike reduceCells() this does not square the condition of the problem: what it costs
 * in time, O(points (channels p q)^2), buys the second half of the digits in directions
 * that the points hardly determine.
 * \param[in] points sorted parameters
 * \param[in] rows what each point says
 * \param[in] threads number of threads; the result does not depend on it */
std::vector<TriangularCell>
reduceRows(const CellPoints& points, const PlainRows& rows, int threads);

/** \brief One factor of the sum of two quadratics over the same unknowns. */
TriangularCell
stackCells(const TriangularCell& first, const TriangularCell& second);

} // namespace nurbs
} // namespace pcl
