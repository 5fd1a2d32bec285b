// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

#pragma once

#include <pcl/surface/nurbs/nurbs_curve.h>

#include <gtest/gtest.h>

namespace pcl {
namespace nurbs {
namespace test {

/** The parameter at the share \a t of a domain. */
inline double
at(const KnotVector& knots, double t)
{
  return knots.domainMin() + t * knots.domainLength();
}

/** The iso-curve of a surface is the curve, parameters mapped affinely. */
inline void
expectSameCurve(const NurbsCurve3& iso, const NurbsCurve3& curve)
{
  for (int k = 0; k <= 100; ++k)
    EXPECT_LT((iso.evaluate(at(iso.knots(), 0.01 * k)) -
               curve.evaluate(at(curve.knots(), 0.01 * k)))
                  .norm(),
              2e-13);
}

} // namespace test
} // namespace nurbs
} // namespace pcl
