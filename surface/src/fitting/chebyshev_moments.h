// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

#pragma once

namespace pcl {
namespace nurbs {

/** \brief Sums over points of weight * T_a(s) * T_b(t), the sufficient statistics of a
 * least-squares problem in one knot cell.
 *
 * A product of two polynomials of degree p is one of degree 2p, so the whole Gram
 * matrix of the (p + 1)(q + 1) basis functions follows from (2p + 1)(2q + 1) such sums:
 * several times less work per point than a QR of its rows, and exact because Chebyshev
 * products are sums: T_i T_k = (T_{i+k} + T_{|i-k|}) / 2.
 *
 * \param[in] degree highest a and highest b
 * \param[in] count number of points
 * \param[in] s local parameters in [-1, 1]
 * \param[in] t local parameters in [-1, 1]
 * \param[in] weights weight of each point
 * \param[in,out] table row a at a * momentStride(degree), entry b; sums are added
 */
void
addChebyshevMoments(int degree,
                    int count,
                    const double* s,
                    const double* t,
                    const double* weights,
                    double* table);

/** \brief Length of a row of a moment table: degree + 1 rounded up to whole vectors. */
constexpr int
momentStride(int degree)
{
  return (degree + 4) / 4 * 4;
}

} // namespace nurbs
} // namespace pcl
