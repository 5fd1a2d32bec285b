// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors
//
// Control points after knot insertion, degree elevation and splitting
// against SISL: they are unique, so they must be equal number by number.

#include <pcl/surface/nurbs/knot_operations.h>

#include "random_nurbs.h"

#include <gtest/gtest.h>

#ifdef PCL_NURBS_HAVE_SISL

extern "C" {
#include <sisl.h>
}

#include <algorithm>
#include <memory>
#include <tuple>
#include <vector>

namespace {

using namespace pcl::nurbs;
using pcl::nurbs::test::KnotKind;
using pcl::nurbs::test::RandomNurbs;

using CurvePtr = std::unique_ptr<SISLCurve, decltype(&freeCurve)>;
using SurfPtr = std::unique_ptr<SISLSurf, decltype(&freeSurf)>;

/** SISL takes arrays it does not change by pointers that are not const. */
CurvePtr
toSisl(const NurbsCurve3& curve)
{
  std::vector<double> knots = curve.knots().values();
  NurbsCurve3::HomogeneousPoints points = curve.homogeneousPoints();
  constexpr int kRational = 2;
  constexpr int kCopy = 1;
  return {newCurve(curve.numControlPoints(),
                   curve.degree() + 1,
                   knots.data(),
                   points.data(),
                   kRational,
                   3,
                   kCopy),
          freeCurve};
}

/** The first parameter of SISL runs fastest, so it is our v. */
SurfPtr
toSisl(const NurbsSurface& surface)
{
  std::vector<double> u = surface.knotsU().values();
  std::vector<double> v = surface.knotsV().values();
  NurbsSurface::HomogeneousPoints points = surface.homogeneousPoints();
  return {newSurf(surface.numControlPointsV(),
                  surface.numControlPointsU(),
                  surface.knotsV().degree() + 1,
                  surface.knotsU().degree() + 1,
                  v.data(),
                  u.data(),
                  points.data(),
                  2,
                  3,
                  1),
          freeSurf};
}

void
expectEqual(const NurbsCurve3& curve, const SISLCurve& sisl, double tolerance)
{
  ASSERT_EQ(sisl.ik, curve.degree() + 1);
  ASSERT_EQ(sisl.in, curve.numControlPoints());
  const Eigen::Map<const Eigen::VectorXd> knots(sisl.et, sisl.in + sisl.ik);
  const Eigen::Map<const Eigen::Matrix4Xd> points(sisl.rcoef, 4, sisl.in);
  for (int i = 0; i < curve.knots().size(); ++i)
    EXPECT_NEAR(curve.knots()[i], knots(i), tolerance);
  EXPECT_LT((curve.homogeneousPoints() - points).cwiseAbs().maxCoeff(), tolerance);
}

std::vector<double>
someParameters(RandomNurbs& random, const KnotVector& knots)
{
  std::vector<double> added;
  for (int i = 0; i < 4; ++i)
    added.insert(
        added.end(), random.integer(1, knots.degree()), random.inDomain(knots));
  std::sort(added.begin(), added.end());
  return added;
}

class SislAgrees : public testing::TestWithParam<std::tuple<int, int>> {
protected:
  RandomNurbs random{53};
  const int degree = std::get<0>(GetParam());
  const KnotKind kind = static_cast<KnotKind>(std::get<1>(GetParam()));
};

TEST_P(SislAgrees, curveKnotInsertion)
{
  const NurbsCurve3 curve = random.curve<3>(degree, true, kind);
  std::vector<double> added = someParameters(random, curve.knots());
  SISLCurve* refined = nullptr;
  int status = 0;
  s1018(toSisl(curve).get(),
        added.data(),
        static_cast<int>(added.size()),
        &refined,
        &status);
  const CurvePtr owner(refined, freeCurve);
  ASSERT_GE(status, 0);
  expectEqual(refineKnots(curve, added), *refined, 1e-12);
}

TEST_P(SislAgrees, surfaceKnotInsertion)
{
  const NurbsSurface surface = random.surface(degree, 3, true, kind);
  std::vector<double> u = someParameters(random, surface.knotsU());
  std::vector<double> v = someParameters(random, surface.knotsV());
  SISLSurf* refined = nullptr;
  int status = 0;
  s1025(toSisl(surface).get(),
        v.data(),
        static_cast<int>(v.size()),
        u.data(),
        static_cast<int>(u.size()),
        &refined,
        &status);
  const SurfPtr owner(refined, freeSurf);
  ASSERT_GE(status, 0);
  const NurbsSurface ours =
      refineKnots(refineKnots(surface, Direction::U, u), Direction::V, v);
  ASSERT_EQ(refined->in1 * refined->in2, ours.numControlPoints());
  const Eigen::Map<const Eigen::Matrix4Xd> points(
      refined->rcoef, 4, ours.numControlPoints());
  EXPECT_LT((ours.homogeneousPoints() - points).cwiseAbs().maxCoeff(), 1e-11);
}

TEST_P(SislAgrees, degreeElevation)
{
  if (degree + 2 > kMaxDegree)
    return;
  const NurbsCurve3 curve = random.curve<3>(degree, true, kind);
  SISLCurve* raised = nullptr;
  int status = 0;
  s1750(toSisl(curve).get(), degree + 3, &raised, &status);
  const CurvePtr owner(raised, freeCurve);
  ASSERT_GE(status, 0);
  expectEqual(elevateDegree(curve, 2), *raised, 1e-12);
}

TEST_P(SislAgrees, split)
{
  const NurbsCurve3 curve = random.curve<3>(degree, true, kind);
  const double u = random.inDomain(curve.knots());
  SISLCurve* left = nullptr;
  SISLCurve* right = nullptr;
  int status = 0;
  s1710(toSisl(curve).get(), u, &left, &right, &status);
  const CurvePtr left_owner(left, freeCurve);
  const CurvePtr right_owner(right, freeCurve);
  ASSERT_GE(status, 0);
  const auto [ours_left, ours_right] = split(curve, u);
  expectEqual(ours_left, *left, 1e-12);
  expectEqual(ours_right, *right, 1e-12);
}

INSTANTIATE_TEST_SUITE_P(Degrees,
                         SislAgrees,
                         testing::Combine(testing::Values(1, 2, 3, 5, 7, 9),
                                          testing::Range(0, 3))); // clamped knots

} // namespace

#else

TEST(SislAgrees, isNotInstalled)
{
  GTEST_SKIP() << "SISL was not found by CMake";
}

#endif
