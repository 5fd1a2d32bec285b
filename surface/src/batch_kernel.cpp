// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors
//
// The one translation unit with code for particular processors. Everything below the
// entry points is inlined into them, so nothing compiled for AVX2 can be picked by the
// linker for other processors.

#include "batch_kernel.h"

#include "fixed_degree_basis.h"

#include <algorithm>
#include <cstring>

namespace pcl {
namespace nurbs {
namespace {

constexpr int kLanes = 4;

/** Four doubles: in basis functions one for each parameter, in sums the homogeneous
 * coordinates of a point. */
using Pack = double __attribute__((vector_size(kLanes * sizeof(double))));

/** The spans of four parameters, as KnotVector::findSpan(). */
[[gnu::always_inline]] inline void
findSpans(const PlainSurface::Knots& knots, const double* u, int* span)
{
  const int first = knots.degree;
  for (int k = 0; k < kLanes; ++k) {
    int base = first;
    for (int count = knots.count - first; count > 1;) {
      const int half = count / 2;
      base += knots.values[base + half] <= u[k] ? half : 0;
      count -= half;
    }
    span[k] = std::clamp(base, knots.first_span, knots.last_span);
  }
}

template <int Degree, int Order>
[[gnu::always_inline]] inline void
basisOf(const PlainSurface::Knots& knots,
        const int* span,
        const double* u,
        Pack (&basis)[Order + 1][kMaxDegree + 1])
{
  const int p = Degree > 0 ? Degree : knots.degree;
  Pack gathered[2 * (Degree > 0 ? Degree : kMaxDegree)];
  for (int r = 0; r < 2 * p; ++r) {
    const double* knot = knots.values + 1 - p + r;
    const double lanes[kLanes] = {
        knot[span[0]], knot[span[1]], knot[span[2]], knot[span[3]]};
    std::memcpy(&gathered[r], lanes, sizeof(Pack));
  }
  Pack parameters;
  std::memcpy(&parameters, u, sizeof(Pack));
  const Pack* knot = gathered + p - 1;
  if constexpr (Degree > 0)
    fixedDegreeBasis<Degree, Order>(knot, parameters, basis);
  else
    anyDegreeBasis<Order>(p, knot, parameters, basis);
}

/** Four parameters; the results of derivative k go to out[k][lane]. */
template <int Degree, int Order>
[[gnu::always_inline]] inline void
evaluateFour(const PlainSurface& surface,
             const double* u,
             const double* v,
             Pack (&out)[3][kLanes])
{
  int span_u[kLanes];
  int span_v[kLanes];
  findSpans(surface.u, u, span_u);
  findSpans(surface.v, v, span_v);
  Pack basis_u[Order + 1][kMaxDegree + 1];
  Pack basis_v[Order + 1][kMaxDegree + 1];
  basisOf<Degree, Order>(surface.u, span_u, u, basis_u);
  basisOf<Degree, Order>(surface.v, span_v, v, basis_v);
  const int p = Degree > 0 ? Degree : surface.u.degree;
  const int q = Degree > 0 ? Degree : surface.v.degree;
  const std::ptrdiff_t stride = surface.v.count;
  for (int k = 0; k < kLanes; ++k) {
    const double* points =
        surface.points + 4 * ((span_u[k] - p) * stride + span_v[k] - q);
    Pack value = {};
    Pack du = {};
    Pack dv = {};
    for (int i = 0; i <= p; ++i, points += 4 * stride) {
      Pack row = {};
      Pack row_v = {};
      for (int j = 0; j <= q; ++j) {
        Pack point;
        std::memcpy(&point, points + 4 * j, sizeof(Pack));
        row += basis_v[0][j][k] * point;
        if constexpr (Order > 0)
          row_v += basis_v[1][j][k] * point;
      }
      value += basis_u[0][i][k] * row;
      if constexpr (Order > 0) {
        du += basis_u[1][i][k] * row;
        dv += basis_u[0][i][k] * row_v;
      }
    }
    const double scale = 1.0 / value[3];
    value *= scale;
    out[0][k] = value;
    if constexpr (Order > 0) { // quotient rule, equation 4.20
      out[1][k] = scale * (du - du[3] * value);
      out[2][k] = scale * (dv - dv[3] * value);
    }
  }
}

template <int Degree, int Order>
[[gnu::always_inline]] inline void
evaluateAll(const PlainSurface& surface, const PlainBatch& batch)
{
  for (std::size_t first = 0; first < batch.n; first += kLanes) {
    const std::size_t count = std::min<std::size_t>(kLanes, batch.n - first);
    double u[kLanes];
    double v[kLanes];
    for (std::size_t k = 0; k < kLanes; ++k) { // the last block repeats its last one
      u[k] = batch.u[first + std::min(k, count - 1)];
      v[k] = batch.v[first + std::min(k, count - 1)];
    }
    Pack out[3][kLanes];
    evaluateFour<Degree, Order>(surface, u, v, out);
    for (int d = 0; d <= 2 * Order; ++d)
      for (std::size_t k = 0; k < count; ++k)
        for (int c = 0; c < 3; ++c)
          batch.out[3 * d + c][first + k] = out[d][k][c];
  }
}

template <int Order>
[[gnu::always_inline]] inline void
evaluateOrder(const PlainSurface& surface, const PlainBatch& batch)
{
  const int degree = surface.u.degree == surface.v.degree ? surface.u.degree : 0;
  if (degree == 3)
    evaluateAll<3, Order>(surface, batch);
  else if (degree == 2)
    evaluateAll<2, Order>(surface, batch);
  else if (degree == 1)
    evaluateAll<1, Order>(surface, batch);
  else
    evaluateAll<0, Order>(surface, batch);
}

void
evaluateBaseline(const PlainSurface& surface, const PlainBatch& batch, int order)
{
  if (order == 0)
    evaluateOrder<0>(surface, batch);
  else
    evaluateOrder<1>(surface, batch);
}

#if defined(__x86_64__)
__attribute__((target("avx2,fma"))) void
evaluateAvx2(const PlainSurface& surface, const PlainBatch& batch, int order)
{
  if (order == 0)
    evaluateOrder<0>(surface, batch);
  else
    evaluateOrder<1>(surface, batch);
}
#endif

using Kernel = void (*)(const PlainSurface&, const PlainBatch&, int);

Kernel
chooseKernel()
{
#if defined(__x86_64__)
  if (__builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma"))
    return evaluateAvx2;
#endif
  return evaluateBaseline;
}

} // namespace

void
evaluatePlain(const PlainSurface& surface, const PlainBatch& batch, int order)
{
  static const Kernel kernel = chooseKernel();
  kernel(surface, batch, order);
}

} // namespace nurbs
} // namespace pcl
