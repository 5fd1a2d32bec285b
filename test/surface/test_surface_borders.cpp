// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors
//
// Borders of surfaces: poles, seams and the normal at a pole.

#include <pcl/surface/nurbs/constructions.h>
#include <pcl/surface/nurbs/primitives.h>
#include <pcl/surface/nurbs/surface_borders.h>

#include "random_nurbs.h"

#include <gtest/gtest.h>

#include <cmath>

namespace {

using namespace pcl::nurbs;
using pcl::nurbs::test::RandomNurbs;

constexpr double kPi = 3.14159265358979323846;

TEST(SurfaceBorders, polesAreDegenerateAndHaveANormal)
{
  RandomNurbs random(5);
  const Eigen::Isometry3d frame =
      frameFromAxis(Eigen::Vector3d(1, 2, 3), Eigen::Vector3d(1, -1, 0.5));
  const Eigen::Vector3d axis = frame.linear().col(2);
  const NurbsSurface ball = sphere(frame, 2.0);
  EXPECT_TRUE(isDegenerate(ball, SurfaceBorder::VMin, 1e-14));
  EXPECT_TRUE(isDegenerate(ball, SurfaceBorder::VMax, 1e-14));
  EXPECT_FALSE(isDegenerate(ball, SurfaceBorder::UMin, 0.1));
  const NurbsSurface hat = cone(frame, 2.0, 1.0);
  EXPECT_FALSE(isDegenerate(hat, SurfaceBorder::VMin, 0.1));
  EXPECT_TRUE(isDegenerate(hat, SurfaceBorder::VMax, 1e-14));
  for (int n = 0; n < 50; ++n) {
    const double u = random.inDomain(ball.knotsU());
    EXPECT_LT((ball.normal(u, 0.5 * kPi) - axis).norm(), 1e-12);
    EXPECT_LT((ball.normal(u, -0.5 * kPi) + axis).norm(), 1e-12);
    EXPECT_NEAR(hat.normal(u, 1.0).dot(axis), 2.0 / std::sqrt(5.0), 1e-12);
  }
  EXPECT_FALSE(
      isDegenerate(sphere(frame, 2.0, {}, {-1.0, 1.0}), SurfaceBorder::VMax, 0.1));
}

TEST(SurfaceBorders, fullTurnsCloseAndPartsDoNot)
{
  const Eigen::Isometry3d frame =
      frameFromAxis(Eigen::Vector3d(1, 2, 3), Eigen::Vector3d(1, -1, 0.5));
  const AngleRange shifted{0.7, 0.7 + 2.0 * kPi};
  for (const AngleRange& turn : {AngleRange{}, shifted}) {
    EXPECT_TRUE(isClosed(cylinder(frame, 2.0, 5.0, turn), Direction::U, 1e-14));
    EXPECT_FALSE(isClosed(cylinder(frame, 2.0, 5.0, turn), Direction::V, 1.0));
    EXPECT_TRUE(isClosed(torus(frame, 2.0, 1.0, turn), Direction::U, 1e-14));
    EXPECT_TRUE(isClosed(torus(frame, 2.0, 1.0, {0, 1}, turn), Direction::V, 1e-14));
  }
  EXPECT_FALSE(isClosed(cylinder(frame, 2.0, 5.0, {0.0, 6.28}), Direction::U, 1e-3));
  // Two poles are two points: closed only within the diameter.
  EXPECT_FALSE(isClosed(sphere(frame, 2.0), Direction::V, 3.9));
  EXPECT_TRUE(isClosed(sphere(frame, 2.0), Direction::V, 4.1));
}

TEST(SurfaceBorders, commonEndsAloneDoNotClose)
{
  // Half of a circle and its diameter.
  const NurbsCurve3 arc = circularArc(Eigen::Isometry3d::Identity(), 1.0, {0.0, kPi});
  Eigen::Matrix3Xd ends(3, 2);
  ends << 1, -1, 0, 0, 0, 0;
  const NurbsSurface half_disc =
      ruledSurface(arc, NurbsCurve3::fromControlPoints(KnotVector::bezier(1), ends));
  EXPECT_FALSE(isClosed(half_disc, Direction::V, 0.1));
  EXPECT_TRUE(isDegenerate(half_disc, SurfaceBorder::UMin, 1e-15));
  EXPECT_TRUE(isDegenerate(half_disc, SurfaceBorder::UMax, 1e-15));
}

TEST(SurfaceBorders, bordersAreTheIsoCurves)
{
  RandomNurbs random(8);
  const NurbsSurface surface = random.surface(3, 2, true, test::KnotKind::Periodic);
  const KnotVector& u = surface.knotsU();
  const KnotVector& v = surface.knotsV();
  for (int n = 0; n < 20; ++n) {
    const double a = random.inDomain(u);
    const double b = random.inDomain(v);
    const auto gap = [&](SurfaceBorder border, double t, double at_u, double at_v) {
      return (borderCurve(surface, border).evaluate(t) - surface.evaluate(at_u, at_v))
          .norm();
    };
    EXPECT_LT(gap(SurfaceBorder::UMin, b, u.domainMin(), b), 1e-13);
    EXPECT_LT(gap(SurfaceBorder::UMax, b, u.domainMax(), b), 1e-13);
    EXPECT_LT(gap(SurfaceBorder::VMin, a, a, v.domainMin()), 1e-13);
    EXPECT_LT(gap(SurfaceBorder::VMax, a, a, v.domainMax()), 1e-13);
  }
}

} // namespace
