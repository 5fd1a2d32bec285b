// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

#pragma once

#include <pcl/surface/nurbs/knot_vector.h>

namespace pcl {
namespace nurbs {

/** \brief Raise a row of derivatives by one degree (equation 2.7): \a scaled holds
 * degree * row[r] / (length of the support of function r). */
template <int Degree, typename Real, typename Row>
[[gnu::always_inline]] inline void
differences(const Real* scaled, Row& row)
{
  row[0] = -scaled[0];
  for (int r = 1; r < Degree; ++r)
    row[r] = scaled[r - 1] - scaled[r];
  row[Degree] = scaled[Degree - 1];
}

/** \brief Basis functions of a degree known at compile time and their derivatives up to
 * \a Order <= 2 (algorithm A2.3 unrolled; each knot difference is divided by once).
 * \tparam Real double, or a pack of doubles for as many parameters at once
 * \param[in] knot pointer to the first knot of the span
 * \param[in] u parameter
 * \param[out] basis basis[k][r] is the k-th derivative of the r-th function; an array
 */
template <int Degree, int Order, typename Real, typename Basis>
[[gnu::always_inline]] inline void
fixedDegreeBasis(const Real* knot, const Real& u, Basis& basis)
{
  Real values[Degree + 1] = {Real{} + 1.0};
  Real low_slopes[Degree + 1] = {}; // of the functions one degree below
  for (int d = 1; d <= Degree; ++d) {
    const double degree = d;
    Real inverse[Degree];
    Real scaled[Degree];
    for (int r = 0; r < d; ++r) {
      inverse[r] = 1.0 / (knot[r + 1] - knot[1 - d + r]);
      scaled[r] = degree * values[r] * inverse[r];
    }
    if constexpr (Order >= 2 && Degree >= 2)
      if (d == Degree - 1)
        differences<Degree - 1>(scaled, low_slopes);
    if (d == Degree) {
      if constexpr (Order >= 1)
        differences<Degree>(scaled, basis[1]);
      if constexpr (Order >= 2) {
        for (int r = 0; r < d; ++r)
          scaled[r] = degree * low_slopes[r] * inverse[r];
        differences<Degree>(scaled, basis[2]);
      }
    }
    Real saved = {};
    for (int r = 0; r < d; ++r) {
      const Real ratio = values[r] * inverse[r];
      values[r] = saved + (knot[r + 1] - u) * ratio;
      saved = (u - knot[1 - d + r]) * ratio;
    }
    values[d] = saved;
  }
  for (int r = 0; r <= Degree; ++r)
    basis[0][r] = values[r];
}

/** \brief The same for a degree known at run time: 1..kMaxDegree. */
template <int Order, typename Real, typename Basis>
[[gnu::always_inline]] inline void
anyDegreeBasis(int degree, const Real* knot, const Real& u, Basis& basis)
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
