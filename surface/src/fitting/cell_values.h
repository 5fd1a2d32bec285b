// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

#pragma once

#include "cell_equations.h"

#include <Eigen/Core>

namespace pcl {
namespace nurbs {

/** \brief Values of splines at points, from the Chebyshev form of each cell's
 * polynomial. O(p q) per point.
 * \param[in] points sorted parameters
 * \param[in] coefficients one row per control point, one column per spline
 * \return one row per point, in the order in which the points were given */
Eigen::MatrixXd
evaluateCells(const CellPoints& points, const Eigen::MatrixXd& coefficients);

} // namespace nurbs
} // namespace pcl
