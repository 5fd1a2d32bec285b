// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

#pragma once

#include <pcl/surface/nurbs/nurbs_curve.h>
#include <pcl/surface/nurbs/nurbs_surface.h>

#include <algorithm>

namespace pcl {
namespace nurbs {
namespace test {

/** Parameter i of n that spread evenly over a domain, its ends included. */
inline double
sampleParameter(const KnotVector& knots, int i, int n)
{
  const double share = static_cast<double>(i) / (n - 1);
  return knots.clampToDomain(knots.domainMin() + share * knots.domainLength());
}

/** Largest distance of two curves at equal parameters of the domain of \a part. */
template <int Dim>
double
maxDistance(const NurbsCurve<Dim>& part, const NurbsCurve<Dim>& whole)
{
  constexpr int kSamples = 201;
  double worst = 0.0;
  for (int i = 0; i < kSamples; ++i) {
    const double u = sampleParameter(part.knots(), i, kSamples);
    worst = std::max(worst, (part.evaluate(u) - whole.evaluate(u)).norm());
  }
  return worst;
}

/** Largest distance of two surfaces at equal parameters of the domain of \a part. */
inline double
maxDistance(const NurbsSurface& part, const NurbsSurface& whole)
{
  constexpr int kSamples = 23;
  double worst = 0.0;
  for (int i = 0; i < kSamples; ++i)
    for (int j = 0; j < kSamples; ++j) {
      const double u = sampleParameter(part.knotsU(), i, kSamples);
      const double v = sampleParameter(part.knotsV(), j, kSamples);
      worst = std::max(worst, (part.evaluate(u, v) - whole.evaluate(u, v)).norm());
    }
  return worst;
}

} // namespace test
} // namespace nurbs
} // namespace pcl
