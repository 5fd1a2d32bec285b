// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

#pragma once

namespace pcl {
namespace nurbs {

/** Factor the first columns of a symmetric matrix in place: A = L L^T for the square
 * block at the top, and the rows below become those of L.
 * \param[in,out] panel rows x columns, column after column; only its lower trapezoid is
 * read \param[in] rows at least \a columns \param[in] least a pivot is refused if it is no more than this share
 * of the diagonal's entry (or not positive)
 * \return false if a pivot was refused; the panel is then of no use */
bool
factorPanel(double* panel, int rows, int columns, double least);

/** What is left of the matrix when the columns of a panel are eliminated: C -= B B^T,
 * the lower trapezoid, where B's rows are those of the panel below its square.
 * \param[in] panel factored, rows x columns \param[in,out] rest (rows - columns) x
 * rest_columns, column after column; entries above its diagonal become meaningless */
void
subtractPanel(
    const double* panel, int rows, int columns, double* rest, int rest_columns);

} // namespace nurbs
} // namespace pcl
