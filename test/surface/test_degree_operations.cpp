// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors
//
// Laws of raising and lowering degrees, and of what needs it: joining curves and
// giving them common knots.

#include <pcl/surface/nurbs/knot_operations.h>

#include "geometry_distance.h"
#include "random_nurbs.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <tuple>
#include <vector>

namespace {

using namespace pcl::nurbs;
using pcl::nurbs::test::maxDistance;
using pcl::nurbs::test::RandomNurbs;

constexpr double kSame = 1e-13;

class CurveDegreeLaws : public testing::TestWithParam<std::tuple<int, bool, int>> {
protected:
  RandomNurbs random{37};
  NurbsCurve3 curve =
      random.curve<3>(std::get<0>(GetParam()),
                      std::get<1>(GetParam()),
                      static_cast<test::KnotKind>(std::get<2>(GetParam())));
  const int degree = curve.degree();
};

TEST_P(CurveDegreeLaws, elevationKeepsTheCurve)
{
  for (int times = 0; degree + times <= kMaxDegree; ++times) {
    const NurbsCurve3 raised = elevateDegree(curve, times);
    EXPECT_EQ(raised.degree(), degree + times);
    EXPECT_EQ(raised.knots().domainMin(), curve.knots().domainMin());
    EXPECT_EQ(raised.knots().domainMax(), curve.knots().domainMax());
    EXPECT_EQ(raised.knots().breaks(), curve.knots().breaks());
    EXPECT_EQ(raised.knots().isClamped(), curve.knots().isClamped());
    EXPECT_EQ(raised.isRational(), curve.isRational());
    EXPECT_LT(maxDistance(raised, curve), kSame);
  }
}

TEST_P(CurveDegreeLaws, elevationKeepsContinuity)
{
  if (degree == kMaxDegree)
    return;
  const NurbsCurve3 raised = elevateDegree(curve);
  const std::vector<double> breaks = curve.knots().breaks();
  for (std::size_t i = 1; i + 1 < breaks.size(); ++i)
    EXPECT_EQ(raised.knots().multiplicity(breaks[i]),
              curve.knots().multiplicity(breaks[i]) + 1);
}

TEST_P(CurveDegreeLaws, reductionUndoesElevation)
{
  if (degree == kMaxDegree)
    return;
  const auto restored = reduceDegree(elevateDegree(curve), 1e-10);
  ASSERT_EQ(restored.steps, 1);
  EXPECT_EQ(restored.geometry.knots(), clampKnots(curve).knots());
  EXPECT_LT(restored.max_error, 1e-11);
  EXPECT_LT(maxDistance(restored.geometry, curve), 1e-13);
  EXPECT_EQ(restored.geometry.isRational(), curve.isRational());
}

TEST_P(CurveDegreeLaws, reductionErrorIsABound)
{
  if (degree == 1)
    return;
  const auto lower = reduceDegree(curve, 1e6);
  if (lower.steps == 0) { // the weights would not stay positive
    EXPECT_TRUE(curve.isRational());
    return;
  }
  EXPECT_EQ(lower.geometry.degree(), degree - 1);
  const double moved = maxDistance(lower.geometry, curve);
  EXPECT_LE(moved, lower.max_error + kSame);
  EXPECT_GT(moved, 0.02 * lower.max_error);
  const double first = curve.knots().domainMin();
  const double last = curve.knots().domainMax();
  EXPECT_LT((lower.geometry.evaluate(first) - curve.evaluate(first)).norm(), kSame);
  EXPECT_LT((lower.geometry.evaluate(last) - curve.evaluate(last)).norm(), kSame);

  const auto refused = reduceDegree(curve, 0.5 * lower.max_error);
  EXPECT_EQ(refused.steps, 0);
  EXPECT_EQ(refused.geometry.knots(), curve.knots());
}

TEST_P(CurveDegreeLaws, joiningSplitPartsRestoresTheCurve)
{
  const auto [left, right] = split(curve, random.inDomain(curve.knots()));
  const NurbsCurve3 joined = join(left, right, 1e-12);
  EXPECT_LT(maxDistance(joined, curve), 5e-13);
  EXPECT_EQ(joined.knots().multiplicity(left.knots().domainMax()), degree);
  EXPECT_EQ(joined.isRational(), curve.isRational());
}

TEST_P(CurveDegreeLaws, compatibleCurvesKeepTheirPoints)
{
  const std::vector<NurbsCurve3> curves{
      curve,
      random.curve<3>(3, false, test::KnotKind::ClampedRepeated),
      random.curve<3>(2, true, test::KnotKind::Periodic)};
  const std::vector<NurbsCurve3> same = makeCompatible(curves);
  ASSERT_EQ(same.size(), 3u);
  for (std::size_t i = 0; i < same.size(); ++i) {
    EXPECT_EQ(same[i].knots(), same[0].knots());
    EXPECT_EQ(same[i].isRational(), curves[i].isRational());
    const KnotVector& domain = curve.knots();
    const NurbsCurve3 mapped(
        curves[i].knots().rescaled(domain.domainMin(), domain.domainMax()),
        curves[i].homogeneousPoints());
    EXPECT_LT(maxDistance(same[i], mapped), 1e-12);
  }
}

INSTANTIATE_TEST_SUITE_P(Degrees,
                         CurveDegreeLaws,
                         testing::Combine(testing::Values(1, 2, 3, 4, 5, 7, 9),
                                          testing::Bool(),
                                          testing::Range(0, 4)));

class SurfaceDegreeLaws
    : public testing::TestWithParam<std::tuple<int, int, bool, int>> {
protected:
  RandomNurbs random{41};
  NurbsSurface surface =
      random.surface(std::get<0>(GetParam()),
                     std::get<1>(GetParam()),
                     std::get<2>(GetParam()),
                     static_cast<test::KnotKind>(std::get<3>(GetParam())));
};

TEST_P(SurfaceDegreeLaws, elevationKeepsTheSurfaceAndReductionUndoesIt)
{
  for (Direction direction : {Direction::U, Direction::V}) {
    const NurbsSurface raised = elevateDegree(surface, direction);
    EXPECT_EQ(raised.knots(direction).degree(), surface.knots(direction).degree() + 1);
    EXPECT_LT(maxDistance(raised, surface), 6e-13);
    const auto restored = reduceDegree(raised, direction, 1e-10);
    ASSERT_EQ(restored.steps, 1);
    EXPECT_EQ(restored.geometry.knots(direction),
              clampKnots(surface, direction).knots(direction));
    EXPECT_LT(maxDistance(restored.geometry, surface), 6e-12);
    EXPECT_EQ(restored.geometry.isRational(), surface.isRational());
  }
}

TEST_P(SurfaceDegreeLaws, reductionErrorIsABound)
{
  for (Direction direction : {Direction::U, Direction::V}) {
    if (surface.knots(direction).degree() == 1)
      continue;
    const auto lower = reduceDegree(surface, direction, 1e6);
    EXPECT_TRUE(lower.steps == 1 || surface.isRational());
    EXPECT_LE(maxDistance(lower.geometry, surface), lower.max_error + 1e-12);
  }
}

INSTANTIATE_TEST_SUITE_P(Degrees,
                         SurfaceDegreeLaws,
                         testing::Combine(testing::Values(1, 2, 5),
                                          testing::Values(1, 3, 8),
                                          testing::Bool(),
                                          testing::Range(0, 4)));

TEST(DegreeOperations, elevationKeepsJumps)
{
  RandomNurbs random{43};
  Eigen::Matrix2Xd points(2, 7);
  for (int i = 0; i < 7; ++i)
    points.col(i) << random.normal(1.0), random.normal(1.0);
  const auto curve = NurbsCurve2::fromControlPoints(
      KnotVector(2, {-1, 0, 0, 1, 1, 1, 2, 2, 3, 4}), points);
  const NurbsCurve2 raised = elevateDegree(curve, 3);
  EXPECT_EQ(raised.knots().multiplicity(1.0), 6);
  EXPECT_LT(maxDistance(raised, curve), kSame);
}

TEST(DegreeOperations, unusedControlPointsDoNotMatter)
{
  // The run of zeros puts P_0 out of the domain.
  const KnotVector knots(2, {-1, 0, 0, 0, 1, 2, 2, 2, 3});
  ASSERT_EQ(knots.numControlPoints(), 6);
  Eigen::Matrix2Xd points(2, 6);
  points << 99, 0, 1, 2, 3, 99, //
      99, 0, 1, -1, 0, 99;
  const auto curve = NurbsCurve2::fromControlPoints(knots, points);
  EXPECT_LT(maxDistance(elevateDegree(curve, 2), curve), kSame);
  EXPECT_LT(maxDistance(clampKnots(curve), curve), kSame);
}

TEST(DegreeOperations, circleKeepsItsRadius)
{
  const double h = std::sqrt(0.5);
  Eigen::Matrix2Xd points(2, 9);
  points << 1, 1, 0, -1, -1, -1, 0, 1, 1, //
      0, 1, 1, 1, 0, -1, -1, -1, 0;
  Eigen::VectorXd weights(9);
  weights << 1, h, 1, h, 1, h, 1, h, 1;
  const auto circle = NurbsCurve2::fromControlPoints(
      KnotVector(2, {0, 0, 0, 1, 1, 2, 2, 3, 3, 4, 4, 4}), points, weights);
  const NurbsCurve2 raised = insertKnot(elevateDegree(circle, 3), 0.3, 5);
  for (int i = 0; i <= 100; ++i)
    EXPECT_NEAR(raised.evaluate(0.04 * i).norm(), 1.0, 1e-14);
}

TEST(DegreeOperations, joinRaisesTheLowerDegreeAndScalesWeights)
{
  RandomNurbs random{47};
  const NurbsCurve3 first = random.curve<3>(2, true, test::KnotKind::Periodic);
  const NurbsCurve3 loose = random.curve<3>(4, true, test::KnotKind::ClampedRandom);
  const double end = first.knots().domainMax();
  const Eigen::Vector3d gap =
      first.evaluate(end) - loose.evaluate(loose.knots().domainMin());
  const NurbsCurve3 second =
      loose.transformed(Eigen::Affine3d(Eigen::Translation3d(gap)));
  const NurbsCurve3 joined = join(first, second, 1e-12);
  EXPECT_EQ(joined.degree(), 4);
  const double length = second.knots().domainLength();
  EXPECT_NEAR(joined.knots().domainMax(), end + length, 1e-14);
  for (double t = 0.05; t < 1.0; t += 0.1) {
    const double u = first.knots().domainMin() + t * first.knots().domainLength();
    EXPECT_LT((joined.evaluate(u) - first.evaluate(u)).norm(), 1e-13);
    const double v = second.knots().domainMin() + t * length;
    EXPECT_LT((joined.evaluate(end + t * length) - second.evaluate(v)).norm(), 1e-13);
  }
}

TEST(DegreeOperations, badInputThrows)
{
  const NurbsCurve3 line;
  EXPECT_THROW(elevateDegree(line, -1), std::invalid_argument);
  EXPECT_THROW(elevateDegree(line, kMaxDegree), std::invalid_argument);
  EXPECT_THROW(reduceDegree(line, 1.0), std::invalid_argument);
  EXPECT_THROW(
      reduceDegree(elevateDegree(line), std::numeric_limits<double>::infinity()),
      std::invalid_argument);
  EXPECT_THROW(join(line, line, 0.5), std::invalid_argument);
  EXPECT_THROW(makeCompatible(std::vector<NurbsCurve3>()), std::invalid_argument);
}

} // namespace
