// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors
//
// Circular and elliptic arcs against their closed forms.

#include <pcl/surface/nurbs/conics.h>

#include "random_nurbs.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <stdexcept>

namespace {

using namespace pcl::nurbs;
using pcl::nurbs::test::RandomNurbs;

constexpr double kPi = 3.14159265358979323846;

class ArcLaws : public testing::TestWithParam<double> {
protected:
  RandomNurbs random{41};
  double first = random.uniform(-7.0, 7.0);
  AngleRange range{first, first + GetParam()};
  Eigen::Isometry2d frame = Eigen::Translation2d(0.3, -0.4) * Eigen::Rotation2Dd(0.8);

  Eigen::Vector2d
  onCircle(double angle) const
  {
    return frame * Eigen::Vector2d(std::cos(angle), std::sin(angle));
  }
};

TEST_P(ArcLaws, everyPointHasTheRadius)
{
  for (const double radius : {1e-6, 1.0, 1e6}) {
    Eigen::Isometry2d placed = frame;
    placed.translation() *= radius;
    const NurbsCurve2 arc = circularArc(placed, radius, range);
    for (int n = 0; n < 200; ++n) {
      const Eigen::Vector2d point = arc.evaluate(random.inDomain(arc.knots()));
      EXPECT_NEAR((point - placed.translation()).norm(), radius, 1e-14 * radius);
    }
  }
}

TEST_P(ArcLaws, parameterIsTheAngleAtJointsAndMiddles)
{
  const NurbsCurve2 arc = circularArc(frame, 1.0, range);
  const std::vector<double> breaks = arc.knots().breaks();
  for (std::size_t i = 0; i + 1 < breaks.size(); ++i) {
    const double middle = 0.5 * (breaks[i] + breaks[i + 1]);
    EXPECT_LT((arc.evaluate(breaks[i]) - onCircle(breaks[i])).norm(), 1e-14);
    EXPECT_LT((arc.evaluate(middle) - onCircle(middle)).norm(), 1e-14);
  }
  EXPECT_LT((arc.evaluate(range.last) - onCircle(range.last)).norm(), 1e-14);
  for (int n = 0; n < 500; ++n) {
    const double u = random.inDomain(arc.knots());
    EXPECT_LT((arc.evaluate(u) - onCircle(u)).norm(), 0.0161);
  }
}

TEST_P(ArcLaws, curveInSpaceIsThatOfThePlane)
{
  Eigen::Isometry3d space = frameFromAxis({1, 2, 3}, {0.2, -0.5, 0.7});
  const NurbsCurve2 flat = ellipticArc(Eigen::Isometry2d::Identity(), 2.0, 0.5, range);
  const NurbsCurve3 arc = ellipticArc(space, 2.0, 0.5, range);
  for (int n = 0; n < 100; ++n) {
    const double u = random.inDomain(arc.knots());
    const Eigen::Vector3d p = space.inverse() * arc.evaluate(u);
    EXPECT_NEAR(p.z(), 0.0, 1e-14);
    EXPECT_LT((p.head<2>() - flat.evaluate(u)).norm(), 1e-14);
    EXPECT_NEAR(std::hypot(p.x() / 2.0, p.y() / 0.5), 1.0, 1e-14);
  }
}

TEST_P(ArcLaws, usesOneSegmentPerQuarter)
{
  const NurbsCurve2 arc = circularArc(frame, 1.0, range);
  const int quarters = static_cast<int>(std::ceil(GetParam() / (0.5 * kPi) - 1e-9));
  EXPECT_EQ(arc.numControlPoints(), 2 * quarters + 1);
}

INSTANTIATE_TEST_SUITE_P(
    Sweeps,
    ArcLaws,
    testing::Values(1e-3, 0.5, 0.5 * kPi, 2.0, kPi, 4.0, 1.5 * kPi, 6.0, 2.0 * kPi));

TEST(Conics, circleClosesExactly)
{
  for (const double first : {0.0, 0.3, -5.0, 100.0}) {
    const NurbsCurve3 circle = circularArc(
        frameFromAxis({5, 6, 7}, {1, 1, 1}), 3.0, {first, first + 2.0 * kPi});
    EXPECT_EQ(circle.homogeneousPoints().col(0), circle.homogeneousPoints().col(8));
  }
}

TEST(Conics, frameFromAxisIsRigid)
{
  RandomNurbs random(3);
  for (int n = 0; n < 100; ++n) {
    const Eigen::Vector3d axis = std::pow(10.0, random.uniform(-300.0, 300.0)) *
                                 Eigen::Vector3d(random.uniform(-1, 1),
                                                 random.uniform(-1, 1),
                                                 random.uniform(-1, 1));
    const Eigen::Isometry3d frame = frameFromAxis({1, 2, 3}, axis);
    EXPECT_TRUE(frame.linear().isUnitary(1e-14));
    EXPECT_NEAR(frame.linear().determinant(), 1.0, 1e-14);
    EXPECT_LT((frame.linear().col(2) - axis.stableNormalized()).norm(), 1e-14);
    EXPECT_EQ(frame.translation(), Eigen::Vector3d(1, 2, 3));
  }
}

TEST(Conics, badInputThrows)
{
  const Eigen::Isometry2d plane = Eigen::Isometry2d::Identity();
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const double infinity = std::numeric_limits<double>::infinity();
  EXPECT_THROW(frameFromAxis({0, 0, 0}, {0, 0, 0}), std::invalid_argument);
  EXPECT_THROW(frameFromAxis({0, 0, 0}, {0, nan, 0}), std::invalid_argument);
  EXPECT_THROW(frameFromAxis({0, infinity, 0}, {0, 1, 0}), std::invalid_argument);
  for (const double bad : {0.0, -1.0, nan, infinity}) {
    EXPECT_THROW(circularArc(plane, bad), std::invalid_argument);
    EXPECT_THROW(ellipticArc(plane, 1.0, bad), std::invalid_argument);
    EXPECT_THROW(circularArc(plane, 1.0, {1.0, 1.0 + bad}), std::invalid_argument);
  }
  EXPECT_THROW(circularArc(plane, 1.0, {0.0, -1.0}), std::invalid_argument);
  EXPECT_THROW(circularArc(plane, 1.0, {0.0, 6.284}), std::invalid_argument);
  Eigen::Isometry2d sheared = plane;
  sheared.linear()(0, 1) = 0.1;
  EXPECT_THROW(circularArc(sheared, 1.0), std::invalid_argument);
}

} // namespace
