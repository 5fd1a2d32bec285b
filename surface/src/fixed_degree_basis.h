// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

#pragma once

#include <pcl/surface/nurbs/knot_vector.h>

namespace pcl {
namespace nurbs {

/** \brief Raise a row of derivatives by one degree (equation 2.7): \a scaled holds
 * degree * row[r] / (length of the support of function r). */
template <int Degree>
inline void
differences(const double* scaled, double* row)
{
  row[0] = -scaled[0];
  for (int r = 1; r < Degree; ++r)
    row[r] = scaled[r - 1] - scaled[r];
  row[Degree] = scaled[Degree - 1];
}

/** \brief Basis functions of a degree known at compile time and their derivatives up to
 * \a Order <= 2 (algorithm A2.3 unrolled; each knot difference is divided by once).
 * \param[in] knot pointer to the first knot of the span
 * \param[in] u parameter
 * \param[out] basis basis[k][r] is the k-th derivative of the r-th function; an array
 *             or pointers to rows
 */
template <int Degree, int Order, typename Basis>
inline void
fixedDegreeBasis(const double* knot, double u, Basis& basis)
{
  double values[Degree + 1] = {1.0};
  double low_slopes[Degree + 1] = {0.0}; // of the functions one degree below
  for (int d = 1; d <= Degree; ++d) {
    double inverse[Degree];
    double scaled[Degree];
    for (int r = 0; r < d; ++r) {
      inverse[r] = 1.0 / (knot[r + 1] - knot[1 - d + r]);
      scaled[r] = d * values[r] * inverse[r];
    }
    if constexpr (Order >= 2 && Degree >= 2)
      if (d == Degree - 1)
        differences<Degree - 1>(scaled, low_slopes);
    if (d == Degree) {
      if constexpr (Order >= 1)
        differences<Degree>(scaled, basis[1]);
      if constexpr (Order >= 2) {
        for (int r = 0; r < d; ++r)
          scaled[r] = d * low_slopes[r] * inverse[r];
        differences<Degree>(scaled, basis[2]);
      }
    }
    double saved = 0.0;
    for (int r = 0; r < d; ++r) {
      const double ratio = values[r] * inverse[r];
      values[r] = saved + (knot[r + 1] - u) * ratio;
      saved = (u - knot[1 - d + r]) * ratio;
    }
    values[d] = saved;
  }
  for (int r = 0; r <= Degree; ++r)
    basis[0][r] = values[r];
}

/** \brief The same for a degree known at run time: 1..kMaxDegree. */
template <int Order, typename Basis>
inline void
anyDegreeBasis(int degree, const double* knot, double u, Basis& basis)
{
  static_assert(kMaxDegree == 9, "one case per degree");
  switch (degree) {
  case 1:
    return fixedDegreeBasis<1, Order>(knot, u, basis);
  case 2:
    return fixedDegreeBasis<2, Order>(knot, u, basis);
  case 3:
    return fixedDegreeBasis<3, Order>(knot, u, basis);
  case 4:
    return fixedDegreeBasis<4, Order>(knot, u, basis);
  case 5:
    return fixedDegreeBasis<5, Order>(knot, u, basis);
  case 6:
    return fixedDegreeBasis<6, Order>(knot, u, basis);
  case 7:
    return fixedDegreeBasis<7, Order>(knot, u, basis);
  case 8:
    return fixedDegreeBasis<8, Order>(knot, u, basis);
  default:
    return fixedDegreeBasis<9, Order>(knot, u, basis);
  }
}

} // namespace nurbs
} // namespace pcl
