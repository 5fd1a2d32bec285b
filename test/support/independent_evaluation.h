// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors
//
// Evaluations of surfaces that share no code with the library.

#pragma once

#include <pcl/surface/nurbs/nurbs_surface.h>

#include <gtest/gtest.h>

#ifdef PCL_NURBS_HAVE_SISL
#include <sisl.h>
#endif

#include <algorithm>
#include <memory>
#include <vector>

namespace pcl {
namespace nurbs {
namespace test {

using Homogeneous = Eigen::Matrix<long double, 4, 1>;

/** De Boor's triangle (corner cutting) in extended precision. */
inline Homogeneous
deBoor(const KnotVector& knots, const std::vector<Homogeneous>& points, long double t)
{
  const int p = knots.degree();
  int span = p;
  while (span + 1 < knots.numControlPoints() && knots[span + 1] <= t)
    ++span;
  std::vector<Homogeneous> d(points.begin() + span - p, points.begin() + span + 1);
  for (int r = 1; r <= p; ++r)
    for (int j = p; j >= r; --j) {
      const long double low = knots[j + span - p];
      const long double high = knots[j + 1 + span - r];
      const long double a = (t - low) / (high - low);
      d[j] = (1.0L - a) * d[j - 1] + a * d[j];
    }
  return d[p];
}

inline Eigen::Vector3d
deBoor(const NurbsSurface& surface, double u, double v)
{
  const int n_v = surface.numControlPointsV();
  std::vector<Homogeneous> column;
  for (int i = 0; i < surface.numControlPointsU(); ++i) {
    std::vector<Homogeneous> row;
    for (int j = 0; j < n_v; ++j)
      row.emplace_back(
          surface.homogeneousPoints().col(i * n_v + j).cast<long double>());
    column.push_back(deBoor(surface.knotsV(), row, v));
  }
  const Homogeneous h = deBoor(surface.knotsU(), column, u);
  return (h.head<3>() / h.w()).cast<double>();
}

/** Largest coordinate of the control net: the scale of rounding errors. */
inline double
extent(const NurbsSurface& surface)
{
  double result = 0.0;
  for (int i = 0; i < surface.numControlPointsU(); ++i)
    for (int j = 0; j < surface.numControlPointsV(); ++j)
      result = std::max(result, surface.controlPoint(i, j).cwiseAbs().maxCoeff());
  return result;
}

/** Call \a check(u, v) on a grid over the domain, borders and knots included. */
template <class Check>
void
onGrid(const NurbsSurface& surface, Check check)
{
  constexpr int kSteps = 12;
  const KnotVector& ku = surface.knotsU();
  const KnotVector& kv = surface.knotsV();
  for (int i = 0; i <= kSteps; ++i)
    for (int j = 0; j <= kSteps; ++j)
      check(i == kSteps ? ku.domainMax()
                        : ku.domainMin() + ku.domainLength() * i / kSteps,
            j == kSteps ? kv.domainMax()
                        : kv.domainMin() + kv.domainLength() * j / kSteps);
}

#ifdef PCL_NURBS_HAVE_SISL
using SislSurface = std::unique_ptr<SISLSurf, decltype(&freeSurf)>;

inline SislSurface
toSisl(const NurbsSurface& surface)
{
  const int n_u = surface.numControlPointsU();
  const int n_v = surface.numControlPointsV();
  constexpr int kRational = 2;
  constexpr int kCopy = 1;
  std::vector<double> knots_u = surface.knotsU().values();
  std::vector<double> knots_v = surface.knotsV().values();
  std::vector<double> points;
  for (int j = 0; j < n_v; ++j)
    for (int i = 0; i < n_u; ++i)
      for (int k = 0; k < 4; ++k)
        points.push_back(surface.homogeneousPoints()(k, i * n_v + j));
  return {newSurf(n_u,
                  n_v,
                  surface.knotsU().degree() + 1,
                  surface.knotsV().degree() + 1,
                  knots_u.data(),
                  knots_v.data(),
                  points.data(),
                  kRational,
                  3,
                  kCopy),
          freeSurf};
}

/** Point, S_u, S_v of SISL, in the order of its array: S, S_u, S_v. */
inline Eigen::Matrix3d
evaluateSisl(SISLSurf* surface, double u, double v)
{
  double parameter[2] = {u, v};
  int left_u = 0;
  int left_v = 0;
  Eigen::Matrix3d values;
  Eigen::Vector3d normal;
  int status = 0;
  s1421(surface, 1, parameter, &left_u, &left_v, values.data(), normal.data(), &status);
  EXPECT_GE(status, 0);
  return values;
}
#endif

/** Compare points with de Boor's triangle, and jets with SISL where it is there. */
inline void
expectIndependentEvaluationsAgree(const NurbsSurface& surface)
{
  const double scale = extent(surface);
#ifdef PCL_NURBS_HAVE_SISL
  const SislSurface other = toSisl(surface);
#endif
  onGrid(surface, [&](double u, double v) {
    const SurfaceJet1 jet = surface.evaluateJet1(u, v);
    EXPECT_LT((surface.evaluate(u, v) - deBoor(surface, u, v)).norm(), 1e-13 * scale);
#ifdef PCL_NURBS_HAVE_SISL
    const Eigen::Matrix3d expected = evaluateSisl(other.get(), u, v);
    EXPECT_LT((jet.position - expected.col(0)).norm(), 1e-13 * scale);
    const double scale_u = scale / surface.knotsU().domainLength() + jet.du.norm();
    const double scale_v = scale / surface.knotsV().domainLength() + jet.dv.norm();
    EXPECT_LT((jet.du - expected.col(1)).norm(), 1e-12 * scale_u);
    EXPECT_LT((jet.dv - expected.col(2)).norm(), 1e-12 * scale_v);
#endif
  });
}

} // namespace test
} // namespace nurbs
} // namespace pcl
