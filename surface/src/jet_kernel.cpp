// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors
//
// Point and low derivatives of a surface, the inner loop of everything else: equal
// degrees 1 to 3 and 5 run through code unrolled for that degree, on processors with
// AVX2 through code for these. Everything is inlined into the entry points, so nothing
// compiled for AVX2 can be picked by the linker for other processors.

#include "jet_kernel.h"

#include "fixed_degree_basis.h"

#include <cstring>

namespace pcl {
namespace nurbs {
namespace {

/** What every processor holds in one register: a parameter in u and one in v, or half
 * of a homogeneous point. */
using Pair = double __attribute__((vector_size(2 * sizeof(double))));

/** A homogeneous point; one register with AVX2. */
using Quad = double __attribute__((vector_size(4 * sizeof(double))));

template <typename Vector>
[[gnu::always_inline]] inline void
store(const Vector& vector, double* to)
{
  std::memcpy(to, &vector, sizeof(Vector));
}

/** Tensor-product sum with derivatives up to \a Order in each direction.
 * \tparam Vector as many coordinates as one register holds: then all sums fit into
 *         registers
 * \param[in] basis_u,basis_v called as (k, r): k-th derivative of basis function r
 * \param[in] points first of these coordinates of the first control point
 * \param[in] p,q degrees; constants after inlining where the caller knows them
 * \param[out] jet the same coordinates of the results */
template <int Order, typename Vector, typename BasisU, typename BasisV>
[[gnu::always_inline]] inline void
sumCoordinates(const double* points,
               std::ptrdiff_t stride,
               int p,
               int q,
               const BasisU& basis_u,
               const BasisV& basis_v,
               double* jet)
{
  Vector value = {}, du = {}, dv = {}, duu = {}, duv = {}, dvv = {};
  for (int i = 0; i <= p; ++i, points += 4 * stride) {
    Vector row = {}, row_v = {}, row_vv = {};
    for (int j = 0; j <= q; ++j) {
      Vector point;
      std::memcpy(&point, points + 4 * j, sizeof(Vector));
      row += basis_v(0, j) * point;
      if constexpr (Order >= 1)
        row_v += basis_v(1, j) * point;
      if constexpr (Order >= 2)
        row_vv += basis_v(2, j) * point;
    }
    value += basis_u(0, i) * row;
    if constexpr (Order >= 1) {
      du += basis_u(1, i) * row;
      dv += basis_u(0, i) * row_v;
    }
    if constexpr (Order >= 2) {
      duu += basis_u(2, i) * row;
      duv += basis_u(1, i) * row_v;
      dvv += basis_u(0, i) * row_vv;
    }
  }
  store(value, jet + 4 * kValue);
  if constexpr (Order >= 1) {
    store(du, jet + 4 * kDu);
    store(dv, jet + 4 * kDv);
  }
  if constexpr (Order >= 2) {
    store(duu, jet + 4 * kDuu);
    store(duv, jet + 4 * kDuv);
    store(dvv, jet + 4 * kDvv);
  }
}

/** All four coordinates, in as many passes as a register needs. */
template <int Order, typename Vector, typename BasisU, typename BasisV>
[[gnu::always_inline]] inline void
sumAll(const PlainSpan& at,
       int p,
       int q,
       const BasisU& basis_u,
       const BasisV& basis_v,
       double (*jet)[4])
{
  constexpr int kCoordinates = sizeof(Vector) / sizeof(double);
  for (int first = 0; first < 4; first += kCoordinates)
    sumCoordinates<Order, Vector>(
        at.points + first, at.stride, p, q, basis_u, basis_v, jet[0] + first);
}

/** Both directions have the same degree: their basis functions are computed side by
 * side, one in each half of the registers. */
template <int Degree, int Order, typename Vector>
[[gnu::always_inline]] inline void
sameDegreeJet(const PlainSpan& at, double u, double v, double (*jet)[4])
{
  Pair knots[2 * Degree];
  for (int r = 0; r < 2 * Degree; ++r)
    knots[r] = Pair{at.knots_u[1 - Degree + r], at.knots_v[1 - Degree + r]};
  Pair basis[Order + 1][Degree + 1];
  fixedDegreeBasis<Degree, Order>(knots + Degree - 1, Pair{u, v}, basis);
  // Read in place: copies of each direction would be written and read back in
  // different widths, which stalls processors.
  const auto basis_u = [&](int k, int r) { return basis[k][r][0]; };
  const auto basis_v = [&](int k, int r) { return basis[k][r][1]; };
  sumAll<Order, Vector>(at, Degree, Degree, basis_u, basis_v, jet);
}

template <int Order, typename Vector>
[[gnu::always_inline]] inline void
anyDegreeJet(const PlainSpan& at, double u, double v, double (*jet)[4])
{
  double basis[2][Order + 1][kMaxDegree + 1];
  for (int direction : {0, 1}) // a loop, so that every degree is compiled once
    anyDegreeBasis<Order>(direction == 0 ? at.p : at.q,
                          direction == 0 ? at.knots_u : at.knots_v,
                          direction == 0 ? u : v,
                          basis[direction]);
  const auto basis_u = [&](int k, int r) { return basis[0][k][r]; };
  const auto basis_v = [&](int k, int r) { return basis[1][k][r]; };
  sumAll<Order, Vector>(at, at.p, at.q, basis_u, basis_v, jet);
}

template <int Order, typename Vector>
[[gnu::always_inline]] inline void
jetOfOrder(const PlainSpan& at, double u, double v, double (*jet)[4])
{
  switch (at.p == at.q ? at.p : 0) {
  case 1:
    return sameDegreeJet<1, Order, Vector>(at, u, v, jet);
  case 2:
    return sameDegreeJet<2, Order, Vector>(at, u, v, jet);
  case 3:
    return sameDegreeJet<3, Order, Vector>(at, u, v, jet);
  case 5:
    return sameDegreeJet<5, Order, Vector>(at, u, v, jet);
  default:
    return anyDegreeJet<Order, Vector>(at, u, v, jet);
  }
}

template <typename Vector>
[[gnu::always_inline]] inline void
jetBy(const PlainSpan& at, double u, double v, int order, double (*jet)[4])
{
  if (order == 0)
    jetOfOrder<0, Vector>(at, u, v, jet);
  else if (order == 1)
    jetOfOrder<1, Vector>(at, u, v, jet);
  else
    jetOfOrder<2, Vector>(at, u, v, jet);
}

// The choice below stays out of the frames of these large functions.
[[gnu::noinline]] void
jetBaseline(const PlainSpan& at, double u, double v, int order, double (*jet)[4])
{
  jetBy<Pair>(at, u, v, order, jet);
}

#if defined(__x86_64__)
[[gnu::noinline]] __attribute__((target("avx2,fma"))) void
jetAvx2(const PlainSpan& at, double u, double v, int order, double (*jet)[4])
{
  jetBy<Quad>(at, u, v, order, jet);
}
#endif

} // namespace

void
evaluatePlainJet(const PlainSpan& at, double u, double v, int order, double (*jet)[4])
{
#if defined(__x86_64__)
  if (__builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma"))
    return jetAvx2(at, u, v, order, jet);
#endif
  jetBaseline(at, u, v, order, jet);
}

} // namespace nurbs
} // namespace pcl
