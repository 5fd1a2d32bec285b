// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors
//
// Laws of the operations on the knots of curves, over degrees, knot vectors and
// weights.

#include <pcl/surface/nurbs/knot_operations.h>

#include "geometry_distance.h"
#include "random_nurbs.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <tuple>
#include <vector>

namespace {

using namespace pcl::nurbs;
using pcl::nurbs::test::maxDistance;
using pcl::nurbs::test::RandomNurbs;

// Control points are of size 1.
constexpr double kSame = 2e-14;

std::vector<double>
merged(const std::vector<double>& a, const std::vector<double>& b)
{
  std::vector<double> all;
  std::merge(a.begin(), a.end(), b.begin(), b.end(), std::back_inserter(all));
  return all;
}

class CurveLaws : public testing::TestWithParam<std::tuple<int, bool, int>> {
protected:
  RandomNurbs random{29};
  NurbsCurve3 curve =
      random.curve<3>(std::get<0>(GetParam()),
                      std::get<1>(GetParam()),
                      static_cast<test::KnotKind>(std::get<2>(GetParam())));
  const int degree = curve.degree();

  double
  inside()
  {
    return random.inDomain(curve.knots());
  }
};

TEST_P(CurveLaws, insertionKeepsTheCurve)
{
  for (int times = 1; times <= degree; ++times) {
    const double u = inside();
    const NurbsCurve3 refined = insertKnot(curve, u, times);
    EXPECT_EQ(refined.knots().values(),
              merged(curve.knots().values(), std::vector<double>(times, u)));
    EXPECT_LT(maxDistance(refined, curve), kSame);
    EXPECT_EQ(refined.isRational(), curve.isRational());
  }
}

TEST_P(CurveLaws, everyKnotCanGetDegreeCopies)
{
  for (double u : curve.knots().breaks()) {
    const int missing = degree - curve.knots().multiplicity(u);
    if (missing < 1)
      continue;
    const NurbsCurve3 refined = insertKnot(curve, u, missing);
    EXPECT_EQ(refined.knots().multiplicity(u), degree);
    EXPECT_EQ(refined.knots().domainMin(), curve.knots().domainMin());
    EXPECT_EQ(refined.knots().domainMax(), curve.knots().domainMax());
    EXPECT_LT(maxDistance(refined, curve), kSame);
  }
}

TEST_P(CurveLaws, refinementEqualsSingleInsertions)
{
  std::vector<double> added;
  for (int i = 0; i < 6; ++i)
    added.insert(added.end(), random.integer(1, degree), inside());
  std::sort(added.begin(), added.end());
  const NurbsCurve3 refined = refineKnots(curve, added);
  NurbsCurve3 one_by_one = curve;
  for (double u : added)
    one_by_one = insertKnot(one_by_one, u);
  EXPECT_EQ(refined.knots(), one_by_one.knots());
  EXPECT_LT((refined.homogeneousPoints() - one_by_one.homogeneousPoints()).norm(),
            kSame);
  EXPECT_LT(maxDistance(refined, curve), kSame);
}

TEST_P(CurveLaws, removalUndoesInsertion)
{
  for (int times = 1; times <= degree; ++times) {
    const double u = inside();
    const NurbsCurve3 refined = insertKnot(curve, u, times);
    const auto restored = removeKnot(refined, u, degree + 1, 1e-10);
    EXPECT_EQ(restored.steps, times);
    EXPECT_EQ(restored.geometry.knots(), curve.knots());
    EXPECT_LT(restored.max_error, 1e-10);
    EXPECT_LT(maxDistance(restored.geometry, curve), 1e-13);
    EXPECT_EQ(restored.geometry.isRational(), curve.isRational());
  }
}

TEST_P(CurveLaws, removalErrorIsABound)
{
  for (double u : curve.knots().breaks()) {
    if (u == curve.knots().domainMin() || u == curve.knots().domainMax())
      continue;
    const int copies = curve.knots().multiplicity(u);
    const auto removed = removeKnot(curve, u, copies, 1e6);
    if (removed.steps == 0)
      continue; // the weights would not stay positive
    EXPECT_EQ(removed.geometry.knots().multiplicity(u), copies - removed.steps);
    const double moved = maxDistance(removed.geometry, curve);
    EXPECT_LE(moved, removed.max_error + kSame);
    EXPECT_GT(moved, 0.0);
    const auto kept = removeKnot(curve, u, copies, 1e-9);
    EXPECT_EQ(kept.steps, 0);
    EXPECT_EQ(kept.max_error, 0.0);
    EXPECT_EQ(kept.geometry.homogeneousPoints(), curve.homogeneousPoints());
  }
}

TEST_P(CurveLaws, redundantKnotsAreFound)
{
  std::vector<double> added;
  for (int i = 0; i < 5; ++i)
    added.push_back(inside());
  std::sort(added.begin(), added.end());
  const auto simple = removeRedundantKnots(refineKnots(curve, added), 1e-9);
  EXPECT_EQ(simple.steps, 5);
  EXPECT_EQ(simple.geometry.knots(), curve.knots());
  EXPECT_LT(maxDistance(simple.geometry, curve), 1e-10);

  const auto coarse = removeRedundantKnots(curve, 0.5);
  EXPECT_LE(coarse.max_error, 0.5);
  EXPECT_LE(maxDistance(coarse.geometry, curve), coarse.max_error + kSame);
}

TEST_P(CurveLaws, splitPartsAgree)
{
  const double u = inside();
  const auto [left, right] = split(curve, u);
  EXPECT_EQ(left.knots().domainMin(), curve.knots().domainMin());
  EXPECT_EQ(left.knots().domainMax(), u);
  EXPECT_EQ(right.knots().domainMin(), u);
  EXPECT_EQ(right.knots().domainMax(), curve.knots().domainMax());
  EXPECT_LT(maxDistance(left, curve), kSame);
  EXPECT_LT(maxDistance(right, curve), kSame);
  EXPECT_LT((left.controlPoint(left.numControlPoints() - 1) - curve.evaluate(u)).norm(),
            kSame);
  EXPECT_LT((right.controlPoint(0) - curve.evaluate(u)).norm(), kSame);
}

TEST_P(CurveLaws, splitAtAKnotAgrees)
{
  for (double u : curve.knots().breaks()) {
    if (u == curve.knots().domainMin() || u == curve.knots().domainMax())
      continue;
    const auto [left, right] = split(curve, u);
    EXPECT_LT(maxDistance(left, curve), kSame);
    EXPECT_LT(maxDistance(right, curve), kSame);
  }
}

TEST_P(CurveLaws, subCurveIsThePart)
{
  const double a = inside();
  const double b = inside();
  const NurbsCurve3 part = subCurve(curve, std::min(a, b), std::max(a, b));
  EXPECT_TRUE(part.knots().isClamped());
  EXPECT_EQ(part.knots().domainMin(), std::min(a, b));
  EXPECT_EQ(part.knots().domainMax(), std::max(a, b));
  EXPECT_LT(maxDistance(part, curve), kSame);
}

TEST_P(CurveLaws, clampingKeepsTheCurve)
{
  const NurbsCurve3 clamped = clampKnots(curve);
  EXPECT_TRUE(clamped.knots().isClamped());
  EXPECT_EQ(clamped.knots().breaks(), curve.knots().breaks());
  EXPECT_LT(maxDistance(clamped, curve), kSame);
  if (curve.knots().isClamped()) {
    EXPECT_EQ(clamped.homogeneousPoints(), curve.homogeneousPoints());
  }
}

TEST_P(CurveLaws, bezierPiecesAgreeAndMeet)
{
  const std::vector<NurbsCurve3> pieces = decomposeBezier(curve);
  const std::vector<double> breaks = curve.knots().breaks();
  ASSERT_EQ(pieces.size() + 1, breaks.size());
  for (std::size_t i = 0; i < pieces.size(); ++i) {
    EXPECT_EQ(pieces[i].knots(), KnotVector::bezier(degree, breaks[i], breaks[i + 1]));
    EXPECT_LT(maxDistance(pieces[i], curve), kSame);
    if (i > 0) {
      EXPECT_EQ(pieces[i - 1].controlPoint(degree), pieces[i].controlPoint(0));
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Degrees,
                         CurveLaws,
                         testing::Combine(testing::Values(1, 2, 3, 4, 5, 7, 9),
                                          testing::Bool(),
                                          testing::Range(0, 4)));

NurbsCurve3
curveWithAJump()
{
  RandomNurbs random{5};
  Eigen::Matrix3Xd points(3, 8);
  for (int i = 0; i < 8; ++i)
    points.col(i) << random.normal(1.0), random.normal(1.0), random.normal(1.0);
  return NurbsCurve3::fromControlPoints(
      KnotVector(3, {0, 0, 0, 0, 1, 1, 1, 1, 2, 2, 2, 2}), points);
}

TEST(KnotOperations, jumpsAreKeptAndCanBeClosed)
{
  const NurbsCurve3 curve = curveWithAJump();
  const auto [left, right] = split(curve, 1.0);
  EXPECT_EQ(left.controlPoint(3), curve.controlPoint(3));
  EXPECT_EQ(right.controlPoint(0), curve.controlPoint(4));
  const double gap = (curve.controlPoint(3) - curve.controlPoint(4)).norm();
  const auto closed = removeKnot(curve, 1.0, 1, gap);
  EXPECT_EQ(closed.steps, 1);
  EXPECT_NEAR(closed.max_error, 0.5 * gap, 1e-14); // the two ends meet halfway
  EXPECT_NEAR(
      (closed.geometry.evaluate(1.0) - curve.evaluate(1.0)).norm(), 0.5 * gap, 1e-14);
}

TEST(KnotOperations, removalBoundDoesNotDependOnTheOrigin)
{
  RandomNurbs random{7};
  const NurbsCurve3 curve = random.curve<3>(3, true, test::KnotKind::ClampedRandom);
  const double u = curve.knots().breaks()[1];
  const Eigen::Affine3d far(Eigen::Translation3d(1e4, -1e4, 1e4));
  const auto near = removeKnot(curve, u, 1, 1e3);
  const auto moved = removeKnot(curve.transformed(far), u, 1, 1e3);
  ASSERT_EQ(near.steps, 1);
  ASSERT_EQ(moved.steps, 1);
  EXPECT_NEAR(near.max_error, moved.max_error, 1e-8 * near.max_error);
}

TEST(KnotOperations, badInputThrows)
{
  const NurbsCurve3 curve = curveWithAJump();
  EXPECT_THROW(insertKnot(curve, -0.1), std::invalid_argument);
  EXPECT_THROW(insertKnot(curve, std::nan("")), std::invalid_argument);
  EXPECT_THROW(insertKnot(curve, 0.5, 0), std::invalid_argument);
  EXPECT_THROW(insertKnot(curve, 0.5, 4), std::invalid_argument);
  EXPECT_THROW(insertKnot(curve, 0.0), std::invalid_argument);
  EXPECT_THROW(insertKnot(curve, 1.0), std::invalid_argument);
  EXPECT_THROW(refineKnots(curve, {0.6, 0.5}), std::invalid_argument);
  EXPECT_THROW(refineKnots(curve, {0.5, 0.5, 0.5, 0.5}), std::invalid_argument);
  EXPECT_THROW(removeKnot(curve, 0.5, 1, 1.0), std::invalid_argument);
  EXPECT_THROW(removeKnot(curve, 0.0, 1, 1.0), std::invalid_argument);
  EXPECT_THROW(removeKnot(curve, 1.0, 0, 1.0), std::invalid_argument);
  EXPECT_THROW(removeKnot(curve, 1.0, 1, -1.0), std::invalid_argument);
  EXPECT_THROW(removeRedundantKnots(curve, std::nan("")), std::invalid_argument);
  EXPECT_THROW(split(curve, 0.0), std::invalid_argument);
  EXPECT_THROW(split(curve, 2.0), std::invalid_argument);
  EXPECT_THROW(subCurve(curve, 0.5, 0.5), std::invalid_argument);
  EXPECT_THROW(subCurve(curve, 0.5, 2.5), std::invalid_argument);
  EXPECT_THROW(subSurface(NurbsSurface(), 0.0, 1.0, -1.0, 1.0), std::invalid_argument);
}

} // namespace
