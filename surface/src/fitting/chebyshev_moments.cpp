// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

#include "chebyshev_moments.h"

#include <pcl/surface/nurbs/knot_vector.h>
#include <pcl/surface/nurbs/runtime_simd.h>

#include <algorithm>
#include <array>

namespace pcl {
namespace nurbs {
namespace {

constexpr int kMaxMoment = 2 * kMaxDegree;
constexpr int kMaxStride = momentStride(kMaxMoment);

/** T_0(x)..T_{Count-1}(x) by the three-term recurrence; padding is zero. */
template <int Count, int Stride>
[[gnu::always_inline]] inline void
chebyshevValues(double x, double* values)
{
  values[0] = 1.0;
  values[1] = x;
  for (int k = 2; k < Count; ++k)
    values[k] = 2.0 * x * values[k - 1] - values[k - 2];
  for (int k = Count; k < Stride; ++k)
    values[k] = 0.0;
}

/** The sums with the degree known to the compiler: the table stays in registers. */
template <int Degree>
[[gnu::always_inline]] inline void
addFixed(int count, const double* s, const double* t, const double* w, double* table)
{
  constexpr int kStride = momentStride(Degree);
  double sums[Degree + 1][kStride] = {};
  for (int n = 0; n < count; ++n) {
    double row[Degree + 1];
    double column[kStride];
    chebyshevValues<Degree + 1, Degree + 1>(s[n], row);
    chebyshevValues<Degree + 1, kStride>(t[n], column);
    for (int a = 0; a <= Degree; ++a) {
      const double factor = w[n] * row[a];
      for (int b = 0; b < kStride; ++b)
        sums[a][b] += factor * column[b];
    }
  }
  for (int a = 0; a <= Degree; ++a)
    for (int b = 0; b < kStride; ++b)
      table[a * kStride + b] += sums[a][b];
}

#define PCL_NURBS_MOMENTS(DEGREE)                                                      \
  PCL_NURBS_RUNTIME_SIMD void addMoments##DEGREE(                                      \
      int count, const double* s, const double* t, const double* w, double* table)     \
  {                                                                                    \
    addFixed<DEGREE>(count, s, t, w, table);                                           \
  }
PCL_NURBS_MOMENTS(1)
PCL_NURBS_MOMENTS(2)
PCL_NURBS_MOMENTS(3)
PCL_NURBS_MOMENTS(4)
PCL_NURBS_MOMENTS(5)
PCL_NURBS_MOMENTS(6)
PCL_NURBS_MOMENTS(10)
#undef PCL_NURBS_MOMENTS

PCL_NURBS_RUNTIME_SIMD void
addGeneral(int degree,
           int count,
           const double* s,
           const double* t,
           const double* w,
           double* table)
{
  const int stride = momentStride(degree);
  std::array<double, kMaxMoment + 1> row;
  std::array<double, kMaxStride> column;
  for (int n = 0; n < count; ++n) {
    chebyshevValues<kMaxMoment + 1, kMaxMoment + 1>(s[n], row.data());
    chebyshevValues<kMaxMoment + 1, kMaxStride>(t[n], column.data());
    for (int a = 0; a <= degree; ++a) {
      const double factor = w[n] * row[static_cast<std::size_t>(a)];
      double* sums = table + a * stride;
      for (int b = 0; b < stride; ++b)
        sums[b] += factor * column[static_cast<std::size_t>(b)];
    }
  }
}

using MomentFunction =
    void (*)(int, const double*, const double*, const double*, double*);

MomentFunction
fixedDegreeFunction(int degree)
{
  switch (degree) {
  case 1:
    return addMoments1;
  case 2:
    return addMoments2;
  case 3:
    return addMoments3;
  case 4:
    return addMoments4;
  case 5:
    return addMoments5;
  case 6:
    return addMoments6;
  case 10:
    return addMoments10;
  default:
    return nullptr;
  }
}

} // namespace

void
addChebyshevMoments(int degree,
                    int count,
                    const double* s,
                    const double* t,
                    const double* weights,
                    double* table)
{
  if (const MomentFunction fixed = fixedDegreeFunction(degree))
    fixed(count, s, t, weights, table);
  else
    addGeneral(degree, count, s, t, weights, table);
}

} // namespace nurbs
} // namespace pcl
